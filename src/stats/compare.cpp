#include "stats/compare.h"

#include "core/error.h"
#include "stats/distributions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::stats {
namespace {

constexpr std::array<const char*, 3> colors = {"R", "G", "B"};
constexpr std::array<const char*, 3> variances = {"variance.R", "variance.G", "variance.B"};
constexpr int block_size = 8;
constexpr double relmse_floor = 0.01;
constexpr double rounding = 1e-5; // Of the larger mean; as in test_agreement.

using Channels = std::array<std::size_t, 3>;

Channels color_channels(const Image& image) {
    Channels channels{};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::optional<std::size_t> index = image.channel_index(colors[c]);
        if (!index)
            throw Error(ExitStatus::bad_input,
                        std::string("cannot compare: an image has no channel ") + colors[c]);
        channels[c] = *index;
    }
    return channels;
}

std::optional<Channels> variance_channels(const Image& image) {
    Channels channels{};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::optional<std::size_t> index = image.channel_index(variances[c]);
        if (!index) return std::nullopt;
        channels[c] = *index;
    }
    return channels;
}

/// An image with the places of its channels.
struct View {
    explicit View(const Image& i)
        : image(i), color(color_channels(i)), variance(variance_channels(i)) {}

    double value(int x, int y, std::size_t c) const { return image.at(x, y, color[c]); }
    double variance_at(int x, int y, std::size_t c) const {
        return variance ? image.at(x, y, (*variance)[c]) : 0;
    }

    const Image& image;
    Channels color;
    std::optional<Channels> variance;
};

ErrorMeasures measure(const View& a, const View& b, std::size_t first, std::size_t last) {
    ErrorMeasures result;
    double n = 0;
    for (int y = 0; y < a.image.height; ++y) {
        for (int x = 0; x < a.image.width; ++x) {
            for (std::size_t c = first; c <= last; ++c, ++n) {
                const double va = a.value(x, y, c), vb = b.value(x, y, c);
                result.mse += (va - vb) * (va - vb);
                result.relmse += (va - vb) * (va - vb) / (vb * vb + relmse_floor);
                result.mean_a += va;
                result.mean_b += vb;
            }
        }
    }
    for (double* sum : {&result.mse, &result.relmse, &result.mean_a, &result.mean_b})
        *sum /= n;
    result.rmse = std::sqrt(result.mse);
    if (result.mean_a != result.mean_b) result.mean_ratio = result.mean_a / result.mean_b;
    return result;
}

/// Sums over a rectangle of pixels, and the z statistic of their difference.
struct Sums {
    double a = 0, b = 0, variance = 0;

    void add(const Sums& other) {
        a += other.a;
        b += other.b;
        variance += other.variance;
    }
    double z() const {
        const double excess = std::abs(a - b) - rounding * std::max(std::abs(a), std::abs(b));
        if (excess <= 0) return 0;
        if (!(variance > 0) || std::isnan(excess)) // No noise could explain it.
            return std::copysign(std::numeric_limits<double>::infinity(), a - b);
        return std::copysign(excess / std::sqrt(variance), a - b);
    }
};

Sums sum_block(const View& a, const View& b, int x0, int y0, std::size_t c) {
    Sums sums;
    for (int y = y0; y < std::min(y0 + block_size, a.image.height); ++y)
        for (int x = x0; x < std::min(x0 + block_size, a.image.width); ++x)
            sums.add({a.value(x, y, c), b.value(x, y, c),
                      a.variance_at(x, y, c) + b.variance_at(x, y, c)});
    return sums;
}

SignificanceTest test_significance(const View& a, const View& b) {
    SignificanceTest result;
    std::array<Sums, 3> whole;
    double tests = 0;
    for (int y = 0; y < a.image.height; y += block_size) {
        for (int x = 0; x < a.image.width; x += block_size) {
            for (std::size_t c = 0; c < 3; ++c, ++tests) {
                const Sums sums = sum_block(a, b, x, y, c);
                whole[c].add(sums);
                const double z = sums.z();
                result.blocks_beyond_3 += std::abs(z) > 3;
                if (std::abs(z) <= std::abs(result.worst_block_z)) continue;
                result.worst_block_z = z;
                result.worst_x = x;
                result.worst_y = y;
                result.worst_channel = static_cast<int>(c);
            }
        }
    }
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        result.mean_z[c] = whole[c].z();
        largest = std::max(largest, std::abs(result.mean_z[c]));
    }
    result.blocks_beyond_3 /= tests;
    result.p_means = least_of(normal_two_sided(largest), 3);
    result.p_blocks = least_of(normal_two_sided(result.worst_block_z), tests);
    return result;
}

Image subtract(const View& a, const View& b) {
    Image difference(a.image.width, a.image.height, {"R", "G", "B"});
    for (int y = 0; y < a.image.height; ++y)
        for (int x = 0; x < a.image.width; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                difference.at(x, y, c) = static_cast<float>(a.value(x, y, c) - b.value(x, y, c));
    return difference;
}

} // namespace

Comparison compare(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height)
        throw Error(ExitStatus::bad_input, "cannot compare images of " + std::to_string(a.width) +
                                               'x' + std::to_string(a.height) + " and " +
                                               std::to_string(b.width) + 'x' +
                                               std::to_string(b.height) + " pixels");
    const View view_a(a), view_b(b);
    Comparison result;
    result.all = measure(view_a, view_b, 0, 2);
    for (std::size_t c = 0; c < 3; ++c)
        result.channels[c] = measure(view_a, view_b, c, c);
    if (view_a.variance || view_b.variance) result.test = test_significance(view_a, view_b);
    result.difference = subtract(view_a, view_b);
    return result;
}

} // namespace tyndall::stats

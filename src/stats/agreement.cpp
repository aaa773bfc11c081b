#include "stats/agreement.h"

#include "core/error.h"
#include "stats/distributions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::stats {
namespace {

struct Rectangle {
    int x0, x1, y0, y1;
};

/// Two-sided t-test of "the mean of a - b is within the tolerance of zero".
struct PairedTest {
    double mean_a = 0, mean_b = 0; ///< Colours: sums over the rectangle and batches, over weights.
    double t = 0;
    double p = 1;
};

glm::dvec4 sum_over(const PixelSums& image, int width, const Rectangle& area) {
    glm::dvec4 sum(0);
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x)
            sum += image[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x)];
    return sum;
}

std::vector<glm::dvec4> batch_sums(std::span<const PixelSums> batches, int width,
                                   const Rectangle& area) {
    std::vector<glm::dvec4> sums;
    for (const PixelSums& batch : batches)
        sums.push_back(sum_over(batch, width, area));
    return sums;
}

double mean_weight(const std::vector<glm::dvec4>& sums) {
    double weight = 0;
    for (const glm::dvec4& sum : sums)
        weight += sum.w;
    return weight / static_cast<double>(sums.size());
}

PairedTest test_channel(const std::vector<glm::dvec4>& a, const std::vector<glm::dvec4>& b,
                        int channel, double tolerance) {
    const double n = static_cast<double>(a.size());
    // One weight for all batches: the difference stays linear in what was summed.
    const double weight_a = mean_weight(a), weight_b = mean_weight(b);
    PairedTest test;
    for (std::size_t i = 0; i < a.size(); ++i) {
        test.mean_a += a[i][channel] / weight_a / n;
        test.mean_b += b[i][channel] / weight_b / n;
    }
    double squares = 0;
    const double mean = test.mean_a - test.mean_b;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double deviation = a[i][channel] / weight_a - b[i][channel] / weight_b - mean;
        squares += deviation * deviation;
    }
    const double allowed = tolerance * std::max(std::abs(test.mean_a), std::abs(test.mean_b));
    const double excess = std::max(0.0, std::abs(mean) - allowed);
    // A difference that is not a number is a disagreement, too.
    if (excess == 0 && !std::isnan(mean)) return test;
    const double standard_error = std::sqrt(squares / (n - 1) / n);
    const double t = excess / standard_error;
    test.t = std::copysign(std::isnan(t) ? std::numeric_limits<double>::infinity() : t, mean);
    test.p = student_two_sided(test.t, n - 1);
    return test;
}

void check_sizes(std::span<const PixelSums> a, std::span<const PixelSums> b, int width) {
    const auto fits = [&](const PixelSums& image) {
        return image.size() == a[0].size() && image.size() % static_cast<std::size_t>(width) == 0;
    };
    if (a.size() < 2 || a.size() != b.size() || !std::all_of(a.begin(), a.end(), fits) ||
        !std::all_of(b.begin(), b.end(), fits))
        throw Error(ExitStatus::failed,
                    "cannot compare batches of different sizes or fewer than 2");
}

} // namespace

Agreement test_agreement(std::span<const PixelSums> a, std::span<const PixelSums> b, int width,
                         const AgreementOptions& options) {
    check_sizes(a, b, width);
    const int height = static_cast<int>(a[0].size() / static_cast<std::size_t>(width));
    Agreement result;
    double least_mean_p = 1;
    const Rectangle whole{0, width, 0, height};
    const auto whole_a = batch_sums(a, width, whole), whole_b = batch_sums(b, width, whole);
    for (int c = 0; c < 3; ++c) {
        const PairedTest test = test_channel(whole_a, whole_b, c, options.relative_tolerance);
        const auto i = static_cast<std::size_t>(c);
        result.mean_a[i] = test.mean_a;
        result.mean_b[i] = test.mean_b;
        result.mean_t[i] = test.t;
        least_mean_p = std::min(least_mean_p, test.p);
    }
    for (int y = 0; y < height; y += options.block_size) {
        for (int x = 0; x < width; x += options.block_size) {
            const Rectangle block{x, std::min(x + options.block_size, width), y,
                                  std::min(y + options.block_size, height)};
            const auto block_a = batch_sums(a, width, block), block_b = batch_sums(b, width, block);
            for (int c = 0; c < 3; ++c, ++result.tests) {
                const PairedTest test =
                    test_channel(block_a, block_b, c, options.relative_tolerance);
                if (test.p >= result.worst_p) continue;
                result.worst_x = x;
                result.worst_y = y;
                result.worst_channel = c;
                result.worst_t = test.t;
                result.worst_p = test.p;
            }
        }
    }
    result.p_means = least_of(least_mean_p, 3);
    result.p_blocks = least_of(result.worst_p, result.tests);
    result.p_value = least_of(std::min(result.p_means, result.p_blocks), 2);
    result.agrees = result.p_value >= options.false_alarm_rate;
    return result;
}

} // namespace tyndall::stats

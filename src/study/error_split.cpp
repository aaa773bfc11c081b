#include "study/error_split.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace tyndall::study {
namespace {

constexpr double K = kRuns;
constexpr double kQuadruples = K * (K - 1) * (K - 2) * (K - 3);

/// Values of a pixel and channel in each run.
using Values = std::array<double, kRuns>;

/// An estimate of a sum over pixels, and of its variance. That is unbiased, and so may come out too
/// small, even negative, where few pixels decide; but it is not below `least`, whatever the
/// distribution.
struct Sum {
    double value = 0, variance = 0, least = 0;
    void add(const Sum& term) {
        value += term.value;
        variance += term.variance;
        least += term.least;
    }
};

/// Sums of the channels, which may depend on each other in any way: deviations add.
Estimate combine(const std::array<Sum, 3>& channels, double power) {
    Estimate result;
    for (const Sum& sum : channels) {
        result.value += sum.value / power;
        result.sd += std::sqrt(std::max(sum.variance, sum.least)) / power;
    }
    return result;
}

/// Squares and fourth powers about the mean, summed.
struct Spread {
    explicit Spread(const Values& values) {
        const double mean = std::accumulate(values.begin(), values.end(), 0.0) / K;
        for (const double value : values) {
            const double square = (value - mean) * (value - mean);
            second += square;
            fourth += square * square;
        }
    }
    double variance() const { return second / (K - 1); }
    /// sigma^4, without bias; not negative.
    double square_variance() const {
        return std::max(0.0, (K * K - 3 * K + 3) * second * second - K * (K - 1) * fourth) /
               kQuadruples;
    }
    /// 2 sigma^4 / (K (K - 1)): the variance of the sample variance is least, and this, for values
    /// at two points; and it is that of the mean product of two values of mean 0.
    double least() const { return 2 * square_variance() / (K * (K - 1)); }
    double second = 0, fourth = 0;
};

/// Sample variance, and the variance of that: its square less the unbiased estimate of sigma^4.
Sum variance_term(const Values& values) {
    const Spread spread(values);
    return {spread.variance(), spread.variance() * spread.variance() - spread.square_variance(),
            spread.least()};
}

/// Square of the expectation mu of independent values: the mean product of two of them. Its
/// variance is 4 mu^2 sigma^2 / K + 2 sigma^4 / (K (K - 1)), for any distribution.
Sum square_term(const Values& values) {
    std::array<double, 5> e{1, 0, 0, 0, 0}; // elementary symmetric polynomials
    for (const double value : values)
        for (std::size_t j = 4; j > 0; --j)
            e[j] += value * e[j - 1];
    // mu^2 sigma^2: products x y z^2 of distinct values, less products of four.
    const double mixed =
        2 * (e[1] * e[3] - 4 * e[4]) / (K * (K - 1) * (K - 2)) - 24 * e[4] / kQuadruples;
    const double least = Spread(values).least();
    return {2 * e[2] / (K * (K - 1)), 4 * mixed / K + least, least};
}

/// What a reference without parts adds: the square of its own noise, to be taken off.
Sum reference_term(double square, double variance) {
    const double own = 2 * variance * variance + 4 * std::max(0.0, square - variance) * variance;
    return {-variance, own, own};
}

/// Sums term(values of a pixel and channel in each run, pixel, channel) over the picture.
template<typename Term>
std::array<Sum, 3> sum_pixels(std::span<const Picture> runs, const Term& term) {
    TYNDALL_ASSERT(runs.size() == kRuns);
    std::array<Sum, 3> sums;
    for (std::size_t pixel = 0; pixel < runs[0].size(); ++pixel)
        for (int c = 0; c < 3; ++c) {
            Values values;
            for (std::size_t run = 0; run < kRuns; ++run)
                values[run] = runs[run][pixel][c];
            sums[static_cast<std::size_t>(c)].add(term(values, pixel, c));
        }
    return sums;
}

} // namespace

Picture average(std::span<const Picture> pictures) {
    Picture result(pictures[0].size(), glm::dvec3(0));
    for (const Picture& picture : pictures)
        for (std::size_t i = 0; i < result.size(); ++i)
            result[i] += picture[i] / static_cast<double>(pictures.size());
    return result;
}

Reference make_reference(std::vector<Picture> parts) {
    Reference reference;
    reference.mean = average(parts);
    reference.variance.resize(reference.mean.size());
    sum_pixels(parts, [&](const Values& values, std::size_t pixel, int c) {
        const Spread spread(values);
        reference.variance[pixel][c] = spread.variance() / K;
        return Sum{};
    });
    reference.parts = std::move(parts);
    return reference;
}

double Reference::power() const {
    double sum = 0;
    for (std::size_t i = 0; i < mean.size(); ++i)
        sum += glm::dot(mean[i], mean[i]) - (variance[i].r + variance[i].g + variance[i].b);
    return sum;
}

Estimate Reference::error() const {
    if (!parts.empty()) {
        const Estimate part = measure_noise(parts, power());
        return {part.value / K, part.sd / K};
    }
    double sum = 0;
    for (const glm::dvec3& v : variance)
        sum += v.r + v.g + v.b;
    return {sum / power(), 0};
}

Estimate measure_noise(std::span<const Picture> runs, double power) {
    return combine(sum_pixels(runs, [](const Values& values, std::size_t,
                                       int) { return variance_term(values); }),
                   power);
}

ErrorSplit split_error(std::span<const Picture> runs, const Reference& reference) {
    const auto deviations = [&](Values values, std::size_t pixel, int c) {
        // Run by run against parts of the reference: then differences are independent.
        for (std::size_t run = 0; run < kRuns; ++run)
            values[run] -=
                reference.parts.empty() ? reference.mean[pixel][c] : reference.parts[run][pixel][c];
        Sum term = square_term(values);
        if (reference.parts.empty())
            term.add(reference_term(term.value, reference.variance[pixel][c]));
        return term;
    };
    ErrorSplit split;
    split.noise = measure_noise(runs, reference.power());
    split.bias = combine(sum_pixels(runs, deviations), reference.power());
    split.total = {split.bias.value + split.noise.value, std::hypot(split.bias.sd, split.noise.sd)};
    return split;
}

Estimate brightness_error(std::span<const Picture> runs, const Reference& reference) {
    double difference = 0, variance = 0, brightness = 0;
    const auto sum = [](const glm::dvec3& c) { return c.r + c.g + c.b; };
    for (std::size_t pixel = 0; pixel < reference.mean.size(); ++pixel) {
        Values values;
        for (std::size_t run = 0; run < kRuns; ++run)
            values[run] =
                sum(runs[run][pixel]) -
                sum(reference.parts.empty() ? reference.mean[pixel] : reference.parts[run][pixel]);
        difference += std::accumulate(values.begin(), values.end(), 0.0) / K;
        variance += Spread(values).variance() / K;
        if (reference.parts.empty()) variance += sum(reference.variance[pixel]);
        brightness += sum(reference.mean[pixel]);
    }
    return {difference / brightness, std::sqrt(variance) / brightness};
}

} // namespace tyndall::study

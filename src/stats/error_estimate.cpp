#include "stats/error_estimate.h"

#include "shared/schedule.h"
#include "stats/distributions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::stats {
namespace {

/// Sum over the pixels of the squared variance of a sample (tr(C)^2): products g_k g_l of disjoint
/// pairs of batches have this expectation. With fewer than two pairs, as if samples were normal.
double sum_squared_variances(const BatchContrasts& b, const ErrorSums& s, double correlation) {
    if (b.pairs < 2) return s.squares / (b.count * (1 + 2 * correlation));
    return (s.pair_residual_squares - s.pair_squares) / (b.pairs * (b.pairs - 1));
}

/// tr(C^2) / tr(C)^2 of the covariance of the channels: 1 if they vary together, 1/3 if each of the
/// three varies on its own.
double channel_correlation(const ErrorSums& s) {
    const double trace = s.variances.x + s.variances.y + s.variances.z;
    return (glm::dot(s.variances, s.variances) + 2 * glm::dot(s.covariances, s.covariances)) /
           (trace * trace);
}

/// Cube roots of the quantiles of F, of which numerator and denominator have relative variances 9 a
/// and 9 b, at -t and +t standard deviations. None if b is too large for that.
struct Bounds {
    double low, high; ///< high may be infinite.
};
std::optional<Bounds> paulson_bounds(double t, double a, double b) {
    if (b >= 1) return std::nullopt;
    // ((1 - b) y - (1 - a))^2 = t^2 (a + b y^2)
    const double square = (1 - b) * (1 - b) - t * t * b;
    const double half = (1 - a) * (1 - b);
    const double constant = (1 - a) * (1 - a) - t * t * a;
    const double root = std::sqrt(std::max(0.0, half * half - square * constant));
    const double high =
        square > 0 ? (half + root) / square : std::numeric_limits<double>::infinity();
    // = (half - root) / square, without cancellation
    return Bounds{std::max(0.0, constant / (half + root)), high};
}

} // namespace

double BatchContrasts::add(std::uint32_t batch, double m) {
    const double before = samples, all = before + m;
    const bool is_pair = batch % 2 == 1 && m == last;
    samples = all;
    last = m;
    if (before == 0) return 0;
    const double w = double{shared::contrast_weight(batch, static_cast<float>(m))};
    fourth += (before * before * before + m * m * m) / (m * before * all * all);
    ++count;
    pairs += is_pair ? 1 : 0;
    weight += w;
    weight_square += w * w;
    return w;
}

std::optional<ErrorEstimate> estimate_error(const BatchContrasts& b, const ErrorSums& s,
                                            double pixels) {
    if (b.count == 0) return std::nullopt;
    // Of a sample, summed over the image.
    const double variance = (s.variances.x + s.variances.y + s.variances.z) / b.weight;
    const double mean_variance = variance / b.samples;
    const double signal = s.mean_squares - mean_variance; // unbiased
    if (variance == 0) return ErrorEstimate{};            // black ones, too
    if (!(signal > 0) || !std::isfinite(signal)) return std::nullopt;
    const double correlation = channel_correlation(s);
    const double per_square = 1 / (variance * variance);
    const double variance_square =
        std::max(per_square * sum_squared_variances(b, s, correlation), 1 / pixels); // all alike
    // Relative variances: of c_0^2 without the squares that V shares, of V without and of these
    // squares, of the signal.
    const double normal = 2 * correlation * variance_square;
    const double spread = normal * b.weight_square / (b.weight * b.weight);
    const double fourth =
        (s.squares * per_square - b.count * (variance_square + normal)) / (b.fourth * b.samples);
    const double squares = std::max(fourth, 0.0);
    const double signal_variance =
        4 * std::max(0.0, s.mean_residuals - s.weighted_squares / (b.weight * b.samples)) /
        (b.weight * b.samples * signal * signal);
    const double degrees = std::max(2 / (squares + spread), 1.0);
    const auto bounds =
        paulson_bounds(student_quantile(0.05, degrees), normal / 9, (spread + signal_variance) / 9);
    if (!bounds) return std::nullopt;
    const double error = std::sqrt(mean_variance / signal);
    const ErrorEstimate estimate{error, error * std::pow(bounds->low, 1.5),
                                 error * std::pow(bounds->high, 1.5),
                                 std::sqrt(squares + spread + signal_variance)};
    if (!std::isfinite(estimate.low)) return std::nullopt;
    return estimate;
}

} // namespace tyndall::stats

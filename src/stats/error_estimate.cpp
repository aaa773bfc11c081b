#include "stats/error_estimate.h"

#include "stats/distributions.h"

#include <algorithm>
#include <cmath>

namespace tyndall::stats {
namespace {

/// Sums over the pixels of the squared variance per sample, and of the fourth cumulant.
struct Moments {
    double variance_square;
    double cumulant;
};

/// Two sums, two unknowns: the squares of D_bp and the products of D_bp and D_cp have the
/// expectations
///
///     count (1 + 2 correlation) v^2 + fourth k    and    count (count - 1) v^2 + shared k.
///
/// Solved, they are unbiased, but where tails are heavy mostly too small, because what is rare is
/// in few pictures. Products alone (k = 0) are too large by the tails. The geometric mean of both
/// gives intervals that cover as they should from normal to lognormal samples of sigma 2.5 and
/// rare bright ones (stats/error_estimate_test.cpp).
Moments compute_moments(const BatchContrasts& b, const ErrorSums& s, double variance,
                        double correlation, double pixels) {
    const double least = variance * variance / pixels; // if all pixels were alike
    const double normal = 1 + 2 * correlation;         // E D^2 / v^2
    const double pairs = b.count * (b.count - 1);
    const double products = std::max(0.0, s.residual_squares - s.squares);
    if (pairs == 0) return {std::max(s.squares, least), 0};
    const double plain = std::max(products / pairs, least);
    const double determinant = pairs * b.fourth - normal * b.count * b.shared;
    if (determinant < 0.2 * pairs * b.fourth) return {plain, 0}; // two contrasts: all but dependent
    const double solved = (products * b.fourth - s.squares * b.shared) / determinant;
    const double cumulant = (s.squares * pairs - normal * b.count * products) / determinant;
    return {std::sqrt(plain * std::max(solved, least)), std::max(cumulant, 0.0)};
}

/// tr(C^2) / tr(C)^2 of the covariance of the channels: 1 if they vary together, 1/3 if each of the
/// three varies on its own.
double channel_correlation(const ErrorSums& s) {
    const double trace = s.variances.x + s.variances.y + s.variances.z;
    return (glm::dot(s.variances, s.variances) + 2 * glm::dot(s.covariances, s.covariances)) /
           (trace * trace);
}

/// Cube roots of the quantiles of F, of which numerator and denominator have relative variances 9 a
/// and 9 b, at -t and +t standard deviations. None if there is no upper one.
struct Bounds {
    double low, high;
};
std::optional<Bounds> paulson_bounds(double t, double a, double b) {
    // ((1 - b) y - (1 - a))^2 = t^2 (a + b y^2)
    const double square = (1 - b) * (1 - b) - t * t * b;
    if (b >= 1 || square <= 0) return std::nullopt;
    const double half = (1 - a) * (1 - b);
    const double constant = (1 - a) * (1 - a) - t * t * a;
    const double root = std::sqrt(std::max(0.0, half * half - square * constant));
    return Bounds{std::max(0.0, (half - root) / square), (half + root) / square};
}

} // namespace

void BatchContrasts::add(double m) {
    const double before = samples, all = before + m;
    samples = all;
    if (before == 0) return;
    const double q = (before * before * before + m * m * m) / (m * before * all * all);
    const double r = m / (before * all); // with any earlier contrast
    fourth += q;
    shared += 2 * count * r;
    weighted_fourth += m * m * q;
    weighted_shared += 2 * weight * m * r;
    ++count;
    weight += m;
    weight_square += m * m;
}

std::optional<ErrorEstimate> estimate_error(const BatchContrasts& b, const ErrorSums& s,
                                            double pixels) {
    if (b.count == 0) return std::nullopt;
    // Of a sample, summed over the image.
    const double variance = (s.variances.x + s.variances.y + s.variances.z) / b.weight;
    const double mean_variance = variance / b.samples;
    const double signal = s.mean_squares - mean_variance; // unbiased
    if (!(signal > 0) || !std::isfinite(signal)) return std::nullopt;
    if (variance == 0) return ErrorEstimate{};
    const double correlation = channel_correlation(s);
    const Moments moments = compute_moments(b, s, variance, correlation, pixels);
    const double per_square = 1 / (variance * variance);
    const double normal = 2 * correlation * moments.variance_square * per_square;
    const double spread = b.weight_square / (b.weight * b.weight);
    const double tail =
        moments.cumulant * per_square *
        ((b.weighted_fourth + b.weighted_shared) / (b.weight * b.weight) - 1 / b.samples);
    const double total = normal + std::max(tail, 0.0) / (1 + spread);
    // The sum of squared means has an error of its own, in which the variance is not yet.
    const double signal_variance =
        4 * std::max(0.0, s.mean_residuals / b.count - moments.variance_square / b.samples) /
        (b.samples * signal * signal);
    const double degrees = b.count / (moments.variance_square * per_square);
    const auto bounds = paulson_bounds(student_quantile(0.05, degrees), total / 9,
                                       (total * spread + signal_variance) / 9);
    if (!bounds) return std::nullopt;
    const double error = std::sqrt(mean_variance / signal);
    const ErrorEstimate estimate{error, error * std::pow(bounds->low, 1.5),
                                 error * std::pow(bounds->high, 1.5)};
    if (!std::isfinite(estimate.high)) return std::nullopt;
    return estimate;
}

} // namespace tyndall::stats

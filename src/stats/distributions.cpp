#include "stats/distributions.h"

#include <cmath>
#include <limits>
#include <utility>

namespace tyndall::stats {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr int most_terms = 100000;

/// Evaluates b0 + a1 / (b1 + a2 / (b2 + ...)) by the method of Lentz, as modified by Thompson and
/// Barnett (1986). term(i) gives (a_i, b_i) for i = 1, 2, ...
template<class Term>
double continued_fraction(double b0, Term&& term) {
    constexpr double tiny = std::numeric_limits<double>::min() / epsilon;
    const auto nonzero = [](double x) { return x == 0 ? tiny : x; };
    double value = nonzero(b0), c = value, d = 0;
    for (int i = 1; i < most_terms; ++i) {
        const auto [a, b] = term(i);
        d = 1 / nonzero(b + a * d);
        c = nonzero(b + a / c);
        value *= c * d;
        if (std::abs(c * d - 1) < 2 * epsilon) break;
    }
    return value;
}

/// x^a (1-x)^b / (a B(a, b)) times the continued fraction of DLMF 8.17.22, which converges fast for
/// x < (a + 1) / (a + b + 2): the regularised incomplete beta function I_x(a, b).
double incomplete_beta(double log_x, double log_one_minus_x, double x, double a, double b) {
    const double front = std::exp(a * log_x + b * log_one_minus_x + std::lgamma(a + b) -
                                  std::lgamma(a) - std::lgamma(b)) /
                         a;
    const auto term = [&](int i) {
        const double m = i / 2;
        const double coefficient =
            i % 2 == 0 ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                       : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        return std::pair(coefficient, 1.0);
    };
    return front / continued_fraction(1, term);
}

} // namespace

double normal_two_sided(double z) {
    return std::erfc(std::abs(z) / std::sqrt(2.0));
}

double student_two_sided(double t, double dof) {
    // P = I_x(dof / 2, 1 / 2) with x = dof / (dof + t^2).
    const double odds = t * t / dof;
    if (odds == 0) return 1;
    if (std::isinf(odds)) return 0;
    const double log_x = -std::log1p(odds);
    const double log_one_minus_x = -std::log1p(1 / odds);
    const double a = dof / 2, b = 0.5;
    const double x = 1 / (1 + odds);
    if (x < (a + 1) / (a + b + 2)) return incomplete_beta(log_x, log_one_minus_x, x, a, b);
    return 1 - incomplete_beta(log_one_minus_x, log_x, odds / (1 + odds), b, a);
}

double student_quantile(double p, double dof) {
    double low = 0, high = 1;
    while (student_two_sided(high, dof) > p)
        high *= 2;
    while (high - low > 1e-12 * high) {
        const double middle = 0.5 * (low + high);
        (student_two_sided(middle, dof) > p ? low : high) = middle;
    }
    return high;
}

double chi_squared_tail(double x, double dof) {
    const double a = dof / 2, y = x / 2;
    if (y <= 0) return 1;
    const double front = std::exp(a * std::log(y) - y - std::lgamma(a));
    if (y >= a + 1) { // DLMF 8.9.2
        const auto term = [&](int i) { return std::pair(i * (a - i), y + 2 * i + 1 - a); };
        return front / continued_fraction(y + 1 - a, term);
    }
    double term = 1 / a, sum = term; // DLMF 8.7.1
    for (int i = 1; i < most_terms && term > epsilon * sum; ++i)
        sum += term *= y / (a + i);
    return 1 - front * sum;
}

double least_of(double p, double n) {
    return p >= 1 ? 1 : -std::expm1(n * std::log1p(-p));
}

} // namespace tyndall::stats

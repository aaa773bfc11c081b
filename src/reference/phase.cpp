#include "reference/phase.h"

namespace tyndall::reference {

bool is_delta(const PhaseFunction& phase) {
    return 1 - std::abs(phase.g) < 1e-6;
}

ScatteringAngle sample_angle(const PhaseFunction& phase, double xi) {
    const double g = phase.g;
    if (is_delta(phase)) return g > 0 ? ScatteringAngle{1, 0, 0} : ScatteringAngle{-1, 0, 2};
    // With D = 1 - g + 2 g xi: 1 - cos = 2 (1 - xi) (1 - g)^2 (1 + g xi) / D^2 and
    // 1 + cos = 2 xi (1 + g)^2 (1 - g (1 - xi)) / D^2. Each factor is a sum of positive terms.
    const double a = std::abs(g);
    const double d = g >= 0 ? (1 - a) + 2 * a * xi : (1 - a) + 2 * a * (1 - xi);
    const double forward = g >= 0 ? 1 + a * xi : (1 - a) + a * (1 - xi);  // 1 + g xi
    const double backward = g >= 0 ? (1 - a) + a * xi : 1 + a * (1 - xi); // 1 - g (1 - xi)
    const double minus = (1 - g) / d;
    const double plus = (1 + g) / d;
    const double one_minus = 2 * (1 - xi) * minus * minus * forward;
    const double one_plus = 2 * xi * plus * plus * backward;
    const double cosine = one_minus < one_plus ? 1 - one_minus : one_plus - 1;
    return {cosine, std::sqrt(one_minus * one_plus), one_minus};
}

double evaluate_phase(const PhaseFunction& phase, double one_minus_cosine) {
    const double g = phase.g;
    // 1 + g^2 - 2 g cos, from the end of the range where it is small.
    const double base = g >= 0 ? (1 - g) * (1 - g) + 2 * g * one_minus_cosine
                               : (1 + g) * (1 + g) - 2 * g * (2 - one_minus_cosine);
    return (1 - g) * (1 + g) / (4 * pi * base * std::sqrt(base));
}

double one_minus_cosine(const dvec3& a, const dvec3& b) {
    const dvec3 difference = a - b;
    return glm::dot(difference, difference) / 2;
}

} // namespace tyndall::reference

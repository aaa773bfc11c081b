#include "reference/phase.h"

#include <algorithm>

namespace tyndall::reference {
namespace {

using Kind = PhaseFunction::Kind;

/// The angle from 1 - cos and 1 + cos, each known to full precision.
ScatteringAngle from_complements(double one_minus, double one_plus) {
    const double cosine = one_minus < one_plus ? 1 - one_minus : one_plus - 1;
    return {cosine, std::sqrt(one_minus * one_plus), one_minus};
}

/// With D = 1 - g + 2 g xi: 1 - cos = 2 (1 - xi) (1 - g)^2 (1 + g xi) / D^2 and
/// 1 + cos = 2 xi (1 + g)^2 (1 - g (1 - xi)) / D^2. Each factor is a sum of positive terms.
ScatteringAngle sample_henyey_greenstein(double g, double xi) {
    const double a = std::abs(g);
    const double d = g >= 0 ? (1 - a) + 2 * a * xi : (1 - a) + 2 * a * (1 - xi);
    const double forward = g >= 0 ? 1 + a * xi : (1 - a) + a * (1 - xi);  // 1 + g xi
    const double backward = g >= 0 ? (1 - a) + a * xi : 1 + a * (1 - xi); // 1 - g (1 - xi)
    const double minus = (1 - g) / d;
    const double plus = (1 + g) / d;
    return from_complements(2 * (1 - xi) * minus * minus * forward,
                            2 * xi * plus * plus * backward);
}

/// cos = (s + k) / (1 + k s) with s = 2 xi - 1.
ScatteringAngle sample_schlick(double k, double xi) {
    const double a = std::abs(k);
    const double d = (1 - a) + 2 * a * (k >= 0 ? xi : 1 - xi); // 1 + k s
    return from_complements(2 * (1 - xi) * (1 - k) / d, 2 * xi * (1 + k) / d);
}

/// The CDF gives cos^3 + 3 cos = 8 xi - 4 = 2 z. Cardano's solution is w - 1 / w with
/// w^3 = z + sqrt(z^2 + 1); as 2 z / (w^2 + 1 + 1 / w^2) nothing cancels.
ScatteringAngle sample_rayleigh(double xi) {
    const double z = 4 * xi - 2;
    const double w = std::cbrt(std::abs(z) + std::sqrt(z * z + 1));
    const double cosine = std::clamp(2 * z / (w * w + 1 + 1 / (w * w)), -1.0, 1.0);
    return from_complements(1 - cosine, 1 + cosine);
}

/// The CDF of a table runs from forward to backward.
ScatteringAngle sample_table(const PhaseTable& table, std::size_t channel, double xi) {
    const std::vector<double>& cdf = table.cdf[channel];
    const std::vector<double>& value = table.value[channel];
    const double target = 1 - xi;
    const auto above = std::upper_bound(cdf.begin() + 1, cdf.end() - 1, target);
    const auto i = static_cast<std::size_t>(above - cdf.begin()) - 1;
    // 2 pi (v0 t + (v1 - v0) t^2 / (2 width)) = mass, by the root that does not cancel.
    const double width = table.complement[i + 1] - table.complement[i];
    const double mass = (target - cdf[i]) / (2 * pi);
    const double slope = (value[i + 1] - value[i]) / width;
    const double root = std::sqrt(std::max(0.0, value[i] * value[i] + 2 * mass * slope));
    const double t = mass > 0 ? std::min(2 * mass / (value[i] + root), width) : 0;
    const double one_minus = table.complement[i] + t;
    return from_complements(one_minus, 2 - one_minus);
}

Rgb evaluate_table(const PhaseTable& table, double one_minus_cosine) {
    const std::vector<double>& nodes = table.complement;
    const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, one_minus_cosine);
    const auto i = static_cast<std::size_t>(above - nodes.begin()) - 1;
    const double t = (one_minus_cosine - nodes[i]) / (nodes[i + 1] - nodes[i]);
    Rgb value;
    for (int c = 0; c < 3; ++c) {
        const std::vector<double>& v = table.value[static_cast<std::size_t>(c)];
        value[c] = v[i] + (v[i + 1] - v[i]) * t;
    }
    return value;
}

double evaluate_henyey_greenstein(double g, double one_minus_cosine) {
    // 1 + g^2 - 2 g cos, from the end of the range where it is small.
    const double base = g >= 0 ? (1 - g) * (1 - g) + 2 * g * one_minus_cosine
                               : (1 + g) * (1 + g) - 2 * g * (2 - one_minus_cosine);
    return (1 - g) * (1 + g) / (4 * pi * base * std::sqrt(base));
}

double evaluate_schlick(double k, double one_minus_cosine) {
    // 1 - k cos, likewise.
    const double base =
        k >= 0 ? (1 - k) + k * one_minus_cosine : (1 + k) - k * (2 - one_minus_cosine);
    return (1 - k) * (1 + k) / (4 * pi * base * base);
}

} // namespace

bool is_delta(const PhaseFunction& phase) {
    return (phase.kind == Kind::henyey_greenstein && 1 - std::abs(phase.g) < 1e-6) ||
           (phase.kind == Kind::schlick && 1 - std::abs(phase.k) < 1e-6);
}

bool is_delta(const std::vector<PhaseFunction>& mixture) {
    return std::any_of(mixture.begin(), mixture.end(),
                       [](const PhaseFunction& phase) { return is_delta(phase); });
}

bool is_chromatic(const std::vector<PhaseFunction>& mixture) {
    return std::any_of(mixture.begin(), mixture.end(), [](const PhaseFunction& phase) {
        return phase.kind == Kind::mie && phase.table->is_chromatic();
    });
}

ScatteringAngle sample_angle(const PhaseFunction& phase, double xi, int hero) {
    if (is_delta(phase)) {
        const double forward = phase.kind == Kind::schlick ? phase.k : phase.g;
        return forward > 0 ? ScatteringAngle{1, 0, 0} : ScatteringAngle{-1, 0, 2};
    }
    switch (phase.kind) {
    case Kind::schlick:
        return sample_schlick(phase.k, xi);
    case Kind::rayleigh:
        return sample_rayleigh(xi);
    case Kind::mie:
        return sample_table(*phase.table, static_cast<std::size_t>(hero), xi);
    default:
        return sample_henyey_greenstein(phase.g, xi);
    }
}

ScatteringAngle sample_angle(const std::vector<PhaseFunction>& mixture, double xi, int hero) {
    double rest = 1; // weight of this component and those after it
    for (std::size_t i = 0; i + 1 < mixture.size(); ++i) {
        const double share = mixture[i].weight / rest;
        if (xi < share) return sample_angle(mixture[i], xi / share, hero);
        xi = (xi - share) / (1 - share);
        rest -= mixture[i].weight;
    }
    return sample_angle(mixture.back(), xi, hero);
}

Rgb evaluate_phase(const PhaseFunction& phase, double one_minus_cosine) {
    switch (phase.kind) {
    case Kind::schlick:
        return Rgb(evaluate_schlick(phase.k, one_minus_cosine));
    case Kind::rayleigh: {
        const double cosine = 1 - one_minus_cosine;
        return Rgb(3 / (16 * pi) * (1 + cosine * cosine));
    }
    case Kind::mie:
        return evaluate_table(*phase.table, one_minus_cosine);
    default:
        return Rgb(evaluate_henyey_greenstein(phase.g, one_minus_cosine));
    }
}

Rgb evaluate_phase(const std::vector<PhaseFunction>& mixture, double one_minus_cosine) {
    if (mixture.size() == 1) return evaluate_phase(mixture.front(), one_minus_cosine);
    Rgb value(0);
    for (const PhaseFunction& phase : mixture)
        value += phase.weight * evaluate_phase(phase, one_minus_cosine);
    return value;
}

Rgb mean_cosine(const PhaseFunction& phase) {
    const double k = phase.k, k2 = k * k;
    switch (phase.kind) {
    case Kind::rayleigh:
        return Rgb(0);
    case Kind::mie:
        return {phase.table->mean_cosine[0], phase.table->mean_cosine[1],
                phase.table->mean_cosine[2]};
    case Kind::schlick: // its closed form cancels where k is small
        return Rgb(std::abs(k) < 0.01 ? k * (2.0 / 3 + k2 * (2.0 / 15 + k2 * 2 / 35))
                                      : 1 / k - (1 - k2) / k2 * std::atanh(k));
    default:
        return Rgb(phase.g);
    }
}

Rgb mean_cosine(const std::vector<PhaseFunction>& mixture) {
    Rgb sum(0);
    for (const PhaseFunction& phase : mixture)
        sum += phase.weight * mean_cosine(phase);
    return sum;
}

double one_minus_cosine(const dvec3& a, const dvec3& b) {
    const dvec3 difference = a - b;
    return glm::dot(difference, difference) / 2;
}

} // namespace tyndall::reference

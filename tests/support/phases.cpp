#include "support/phases.h"

#include "phase/mie.h"

#include <cmath>
#include <numbers>

namespace tyndall::support {

PhaseFunction henyey_greenstein(double g) {
    return {.kind = PhaseFunction::Kind::henyey_greenstein, .g = g};
}

PhaseFunction schlick(double k) {
    return {.kind = PhaseFunction::Kind::schlick, .k = k};
}

PhaseFunction rayleigh() {
    return {.kind = PhaseFunction::Kind::rayleigh};
}

PhaseFunction mie(const std::array<double, 3>& sizes, double eta, double sigma) {
    MieParameters p;
    p.radius_um = 1;
    p.radius_sigma = sigma;
    p.eta = {eta, eta, eta};
    for (std::size_t c = 0; c < 3; ++c)
        p.wavelength_um[c] = 2 * std::numbers::pi / sizes[c];
    return {.kind = PhaseFunction::Kind::mie,
            .table = std::make_shared<const PhaseTable>(compute_mie(p).table)};
}

PhaseFunction weighted(double weight, PhaseFunction phase) {
    phase.weight = weight;
    return phase;
}

PhaseFunction perturbed(const PhaseFunction& mie, double share) {
    auto value = mie.table->value;
    for (std::vector<double>& channel : value)
        for (std::size_t i = 0; i < channel.size(); ++i)
            channel[i] *= 1 + share * (1 - mie.table->complement[i]);
    PhaseFunction result = mie;
    result.table = std::make_shared<const PhaseTable>(make_phase_table(value));
    return result;
}

double mean_cosine(const PhaseFunction& phase) {
    const double k = phase.k;
    switch (phase.kind) {
    case PhaseFunction::Kind::henyey_greenstein:
        return phase.g;
    case PhaseFunction::Kind::rayleigh:
        return 0;
    case PhaseFunction::Kind::mie:
        return phase.table->mean_cosine[0];
    case PhaseFunction::Kind::schlick:
        break;
    }
    if (std::abs(k) < 1e-3) return 2 * k / 3;
    return 1 / k - (1 - k * k) / (2 * k * k) * std::log((1 + k) / (1 - k));
}

double mean_cosine(const std::vector<PhaseFunction>& mixture) {
    double sum = 0;
    for (const PhaseFunction& phase : mixture)
        sum += phase.weight * mean_cosine(phase);
    return sum;
}

} // namespace tyndall::support

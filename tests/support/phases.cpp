#include "support/phases.h"

#include "phase/mie.h"

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

} // namespace tyndall::support

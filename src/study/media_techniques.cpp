// Other ways to describe the same media: majorants of other cells, simpler phase functions.
#include "render/effects.h"
#include "study/techniques.h"
#include "volume/majorants.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace tyndall::study {
namespace {

/// What the majorants of a medium on voxels bound.
Grid bounded_field(const GridDensity& density) {
    return density.density ? *density.density : max_extinction(density.sigma_a, density.sigma_s);
}

void set_cells(Scene& scene, int size) {
    for (Medium& medium : scene.media)
        if (auto* grid = std::get_if<GridDensity>(&medium.density))
            grid->majorants = build_majorants(bounded_field(*grid), size);
}

/// Mean cosine of one function of a mixture, over the channels.
double mean_cosine(const PhaseFunction& phase) {
    switch (phase.kind) {
    case PhaseFunction::Kind::henyey_greenstein:
        return phase.g;
    case PhaseFunction::Kind::mie:
        return (phase.spheres[0].asymmetry + phase.spheres[1].asymmetry +
                phase.spheres[2].asymmetry) /
               3;
    default:
        return 0;
    }
}

/// Schlick's k for a mean cosine; the fit leaves [-1, 1] for |g| beyond 0.938.
double schlick_k(double g) {
    return 1.55 * g - 0.55 * g * g * g;
}

bool is_fitted(const PhaseFunction& phase, PhaseFunction::Kind as) {
    return phase.kind == PhaseFunction::Kind::mie ||
           (phase.kind == PhaseFunction::Kind::henyey_greenstein && phase.g != 0 &&
            as != phase.kind);
}

void fit_phases(Scene& scene, PhaseFunction::Kind as) {
    for (Medium& medium : scene.media)
        for (PhaseFunction& phase : medium.phases)
            if (is_fitted(phase, as)) {
                const double g = mean_cosine(phase);
                phase = {.kind = as, .weight = phase.weight, .g = g, .k = schlick_k(g)};
            }
}

} // namespace

void list_cells(const Scene& scene, std::vector<Technique>& list) {
    if (!(compute_effects(scene).features.densities & shared::DENSITY_BIT_GRID)) return;
    int chosen = 0, extent = 0;
    std::uint64_t voxels = 0;
    for (const Medium& medium : scene.media)
        if (const auto* grid = std::get_if<GridDensity>(&medium.density)) {
            const glm::ivec3 size = grid->majorants.size * grid->majorants.count;
            chosen = std::max(chosen, grid->majorants.size);
            extent = std::max({extent, size.x, size.y, size.z});
            voxels = std::max(voxels, std::uint64_t(size.x) * std::uint64_t(size.y) *
                                          std::uint64_t(size.z));
        }
    for (int size = 1; size < 2 * extent; size *= 4) {
        const std::uint64_t cube = std::uint64_t(size) * std::uint64_t(size) * std::uint64_t(size);
        if (size == chosen || voxels / cube > max_majorant_cells / 2) continue;
        list.push_back({.name = fmt::format("cells-{}", size),
                        .title = size >= extent ? "one majorant for all voxels"
                                                : fmt::format("majorant cells of {}³ voxels", size),
                        .family = Family::cells,
                        .series = "cells",
                        .parameter = double(size),
                        .is_unbiased = true,
                        .apply = [=](Scene& s) { set_cells(s, size); }});
    }
}

void list_phases(const Scene& scene, std::vector<Technique>& list) {
    if (!compute_effects(scene).features.has_scattering) return;
    const auto offer = [&](PhaseFunction::Kind as, const char* name, const char* title) {
        bool fits = false, is_in_range = true;
        for (const Medium& medium : scene.media)
            for (const PhaseFunction& phase : medium.phases)
                if (is_fitted(phase, as)) {
                    fits = true;
                    is_in_range &= std::abs(mean_cosine(phase)) <= 0.938;
                }
        if (!fits || (as == PhaseFunction::Kind::schlick && !is_in_range)) return;
        list.push_back(
            {.name = name, .title = title, .family = Family::phases, .apply = [=](Scene& s) {
                 fit_phases(s, as);
             }});
    };
    offer(PhaseFunction::Kind::henyey_greenstein, "phase-henyey-greenstein",
          "Henyey-Greenstein of the same mean cosine");
    offer(PhaseFunction::Kind::schlick, "phase-schlick", "Schlick's fit of the same mean cosine");
}

} // namespace tyndall::study

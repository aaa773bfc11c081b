#include "study/techniques.h"

#include "core/error.h"
#include "render/effects.h"
#include "shared/records.h"
#include "volume/majorants.h"

#include <algorithm>
#include <fmt/format.h>
#include <fnmatch.h>

namespace tyndall::study {
namespace {

using Kind = Integrator::Kind;

/// Lights that a path cannot run into.
bool has_points_of_light(const shared::Features& f) {
    return f.lights & (shared::LIGHTS_POINT | shared::LIGHTS_SPOT | shared::LIGHTS_DISTANT);
}

/// Lights that equiangular placement can aim at.
bool has_places_of_light(const shared::Features& f) {
    return f.lights & (shared::LIGHTS_POINT | shared::LIGHTS_SPOT | shared::LIGHTS_AREA);
}

/// The baseline, and what each of its parts is worth.
void list_estimators(const Scene& scene, const Effects& effects, std::vector<Technique>& list) {
    const shared::Features& f = effects.features;
    list.push_back({.name = kBaseline, .title = "volpath", .is_unbiased = true, .apply = {}});
    if (f.lights && !has_points_of_light(f))
        list.push_back({.name = "volpath-no-light-sampling",
                        .title = "volpath without light sampling",
                        .is_unbiased = true,
                        .apply = [](Scene& s) { s.integrator.samples_lights = false; }});
    const bool absorbs = std::any_of(scene.media.begin(), scene.media.end(), [](const Medium& m) {
        return m.sigma_a != Rgb(0) && m.sigma_s != Rgb(0);
    });
    if (f.has_scattering && absorbs)
        list.push_back(
            {.name = "volpath-analog",
             .title = "volpath, analog absorption",
             .is_unbiased = true,
             .apply = [](Scene& s) { s.integrator.absorption = Integrator::Absorption::analog; }});
    if (!f.lights || !(f.densities & shared::DENSITY_BITS_TRACKED)) return;
    for (const int steps : {4, 16, 64})
        list.push_back({.name = fmt::format("volpath-marched-{}", steps),
                        .title = fmt::format("volpath, shadows marched in {} steps", steps),
                        .series = "volpath-marched",
                        .parameter = double(steps),
                        .apply = [=](Scene& s) {
                            s.integrator.transmittance = Integrator::Transmittance::marched;
                            s.integrator.steps = steps;
                            s.integrator.step_size = 0;
                        }});
}

Technique marching(const char* word, Integrator::Placement placement, int steps) {
    // Uniform steps are the method without any random number in the medium: shadows march as well.
    const bool is_uniform = placement == Integrator::Placement::uniform;
    return {.name = fmt::format("march-{}-{}", word, steps),
            .title = fmt::format("marching, {} {} {}", steps, word, steps == 1 ? "step" : "steps"),
            .family = Family::marching,
            .series = fmt::format("march-{}", word),
            .parameter = double(steps),
            .apply = [=](Scene& s) {
                s.integrator.kind = Kind::singlescatter;
                s.integrator.placement = placement;
                s.integrator.steps = steps;
                s.integrator.step_size = 0;
                s.integrator.transmittance = is_uniform ? Integrator::Transmittance::marched
                                                        : Integrator::Transmittance::tracked;
            }};
}

void list_marching(const Effects& effects, std::vector<Technique>& list) {
    if (!effects.features.has_media) return;
    for (const int steps : {1, 4, 16, 64, 256, 1024})
        list.push_back(marching("uniform", Integrator::Placement::uniform, steps));
    if (!effects.features.has_scattering) return;
    for (const int steps : {1, 4, 16})
        list.push_back(marching("jittered", Integrator::Placement::jittered, steps));
    if (!has_places_of_light(effects.features)) return;
    for (const int steps : {1, 4, 16})
        list.push_back(marching("equiangular", Integrator::Placement::equiangular, steps));
}

void list_orders(const Scene& scene, const Effects& effects, std::vector<Technique>& list) {
    const bool has_surfaces = effects.features.surface_queues & ~(1u << shared::QUEUE_INTERFACE);
    if (!effects.features.has_scattering && !has_surfaces) return;
    for (int orders = 1; orders <= 64 && orders < scene.integrator.max_depth; orders *= 2)
        list.push_back({.name = fmt::format("orders-{}", orders),
                        .title = orders == 1 ? "one scattering event at most"
                                             : fmt::format("up to {} scattering events", orders),
                        .family = Family::orders,
                        .series = "orders",
                        .parameter = double(orders),
                        .apply = [=](Scene& s) { s.integrator.max_depth = orders; }});
}

/// What the majorants of a medium on voxels bound.
Grid bounded_field(const GridDensity& density) {
    return density.density ? *density.density : max_extinction(density.sigma_a, density.sigma_s);
}

void set_cells(Scene& scene, int size) {
    for (Medium& medium : scene.media)
        if (auto* grid = std::get_if<GridDensity>(&medium.density))
            grid->majorants = build_majorants(bounded_field(*grid), size);
}

void list_cells(const Scene& scene, const Effects& effects, std::vector<Technique>& list) {
    if (!(effects.features.densities & shared::DENSITY_BIT_GRID)) return;
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

void list_phases(const Scene& scene, const Effects& effects, std::vector<Technique>& list) {
    if (!effects.features.has_scattering) return;
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

} // namespace

std::vector<Technique> list_techniques(const Scene& scene) {
    Scene base = scene;
    base.integrator = {.max_depth = scene.integrator.max_depth};
    const Effects effects = compute_effects(base);
    std::vector<Technique> list;
    list_estimators(scene, effects, list);
    list_marching(effects, list);
    list_orders(scene, effects, list);
    list_cells(scene, effects, list);
    list_phases(scene, effects, list);
    list_left_out(base, list);
    // What the scene language knows and no renderer does yet.
    std::erase_if(list, [&](const Technique& technique) {
        try {
            compute_effects(changed_scene(scene, technique));
            return false;
        } catch (const Error&) {
            return true;
        }
    });
    return list;
}

std::vector<Technique> select_techniques(std::vector<Technique> all,
                                         std::span<const std::string> patterns) {
    if (patterns.empty()) return all;
    std::vector<bool> wanted(all.size());
    for (const std::string& pattern : patterns) {
        bool is_found = false;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (fnmatch(pattern.c_str(), all[i].name.c_str(), 0) == 0) wanted[i] = is_found = true;
        if (is_found) continue;
        std::string names;
        for (const Technique& technique : all)
            names += (names.empty() ? "" : ", ") + technique.name;
        throw Error(ExitStatus::bad_input,
                    fmt::format("no technique \"{}\" for this scene (expected one of {}; * stands "
                                "for any characters)",
                                pattern, names));
    }
    std::vector<Technique> selected;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (wanted[i]) selected.push_back(std::move(all[i]));
    return selected;
}

Scene changed_scene(const Scene& scene, const Technique& technique) {
    Scene changed = scene;
    changed.integrator = {.max_depth = scene.integrator.max_depth};
    if (technique.apply) technique.apply(changed);
    return changed;
}

} // namespace tyndall::study

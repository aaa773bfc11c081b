#include "study/techniques.h"

#include "core/error.h"
#include "render/effects.h"
#include "shared/records.h"

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

/// The sampler that the scene does not have.
Technique other_sampler(const Scene& scene) {
    if (scene.sampler == Sampler::independent)
        return {.name = "volpath-sobol",
                .title = "volpath on Sobol' points",
                .is_unbiased = true,
                .apply = [](Scene& s) { s.sampler = Sampler::sobol; }};
    return {.name = "volpath-independent",
            .title = "volpath on independent random numbers",
            .is_unbiased = true,
            .apply = [](Scene& s) { s.sampler = Sampler::independent; }};
}

/// The baseline, and what each of its parts is worth.
void list_estimators(const Scene& scene, const Effects& effects, std::vector<Technique>& list) {
    const shared::Features& f = effects.features;
    list.push_back({.name = kBaseline, .title = "volpath", .is_unbiased = true, .apply = {}});
    const bool has_surfaces = f.surface_queues & ~(1u << shared::QUEUE_INTERFACE);
    if (f.has_scattering || has_surfaces) list.push_back(other_sampler(scene));
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

/// That of the baseline: as the scene has it in what is simulated, and in nothing of how.
Integrator baseline_integrator(const Integrator& integrator) {
    return {.kind = integrator.kind == Kind::path ? Kind::path : Kind::volpath,
            .max_depth = integrator.max_depth};
}

} // namespace

std::vector<Technique> list_techniques(const Scene& scene) {
    Scene base = scene;
    base.integrator = baseline_integrator(scene.integrator);
    const Effects effects = compute_effects(base);
    std::vector<Technique> list;
    list_estimators(scene, effects, list);
    list_marching(effects, list);
    list_orders(scene, effects, list);
    list_cells(base, list);
    list_phases(base, list);
    list_left_out(base, list);
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
    changed.integrator = baseline_integrator(scene.integrator);
    if (technique.apply) technique.apply(changed);
    return changed;
}

} // namespace tyndall::study

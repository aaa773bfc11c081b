#include "render/effect_costs.h"

#include "render/stages.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string_view>

namespace tyndall {
namespace {

using namespace shared;

template<std::uint32_t queue>
void no_surface(Features& f) {
    f.surface_queues &= ~(1u << queue);
}
template<std::uint32_t kind>
void no_light(Features& f) {
    f.lights &= ~kind;
    if (!(f.lights & (LIGHTS_POINT | LIGHTS_SPOT))) f.has_equiangular = 0;
}
void no_hot_grids(Features& f) {
    f.has_temperature = 0;
    no_light<LIGHTS_VOXELS>(f);
}
void no_emission(Features& f) {
    f.has_emission = 0;
    no_hot_grids(f);
}
void no_chromatic_media(Features& f) {
    f.is_chromatic = f.has_dispersion;
    f.has_chromatic_phases = 0;
}
void no_scattering(Features& f) {
    f.has_scattering = f.phases = f.has_mixtures = f.has_delta_phases = f.has_equiangular = 0;
    no_chromatic_media(f);
}
void no_grids(Features& f) {
    f.densities &= ~DENSITY_BIT_GRID;
    f.has_rgb_grids = 0;
    no_hot_grids(f);
}
void no_media(Features& f) {
    f.has_media = f.has_closed_media = 0;
    f.densities = 0;
    no_scattering(f);
    no_grids(f);
    no_emission(f);
}

/// What an effect adds to features, and which tables are its own.
struct Entry {
    std::string_view effect;
    void (*take_away)(Features&);
    std::array<std::string_view, 4> tables{}; ///< Names in SceneTables::bytes, or "voxels".
};

const Entry kEntries[] = {
    {"interfaces",
     [](Features& f) {
         no_surface<QUEUE_INTERFACE>(f);
         f.has_interfaces = f.has_contacts = 0;
     }},
    {"boundaries in touch", [](Features& f) { f.has_contacts = 0; }},
    {"diffuse surfaces", no_surface<QUEUE_SURFACE>},
    {"smooth dielectrics", no_surface<QUEUE_DIELECTRIC>},
    {"rough dielectrics", no_surface<QUEUE_ROUGH_DIELECTRIC>},
    {"smooth metal", no_surface<QUEUE_CONDUCTOR>},
    {"rough metal", no_surface<QUEUE_ROUGH_CONDUCTOR>},
    {"dispersion", [](Features& f) { f.has_dispersion = 0; }},
    {"emitting surfaces",
     [](Features& f) { no_light<LIGHTS_AREA>(f), f.has_emitters = f.emitters = 0; }},
    {"shading normals", [](Features& f) { f.has_shading_normals = 0; }, {"vertex normals"}},
    {"instances", [](Features& f) { f.primitives &= ~PRIMITIVE_INSTANCES; }, {"instances"}},
    {"media", no_media, {"media"}},
    {"scattering", no_scattering},
    {"emission of media", no_emission, {"black body", "emitting voxels"}},
    {"mixtures of phases", [](Features& f) { f.has_mixtures = 0; }},
    {"chromatic phases", [](Features& f) { f.has_chromatic_phases = 0; }},
    {"delta phases", [](Features& f) { f.has_delta_phases = 0; }},
    {"spectral MIS", [](Features& f) { f.is_chromatic = f.has_dispersion = 0; }},
    {"media in closed form", [](Features& f) { f.has_closed_media = f.has_equiangular = 0; }},
    {"grids", no_grids, {"brick tables", "grids", "majorants", "voxels"}},
    {"black body emission", [](Features& f) { f.has_temperature = 0; }, {"black body"}},
    {"exponential atmospheres",
     [](Features& f) { f.densities &= ~(DENSITY_BIT_PLANE | DENSITY_BIT_SPHERE); },
     {"atmospheres"}},
    {"environment", [](Features& f) { f.has_environment = 0; }},
    {"area lights", no_light<LIGHTS_AREA>},
    {"grids as lights", no_light<LIGHTS_VOXELS>, {"emitting voxels"}},
    {"distant lights", no_light<LIGHTS_DISTANT>},
    {"point lights", no_light<LIGHTS_POINT>},
    {"spot lights", no_light<LIGHTS_SPOT>},
    {"choice among lights", [](Features& f) { f.light_candidates = 1; }},
    {"equiangular sampling", [](Features& f) { f.has_equiangular = 0; }},
    {"roulette by reach of light", [](Features& f) { f.has_lit_ball = 0; }, {"lit ball"}},
    {"depth of field", [](Features& f) { f.has_lens = 0; }},
    {"radiance limit", [](Features& f) { f.has_clamp = 0; }},
};

const Entry* find_entry(const std::string& effect) {
    const auto* found = std::find_if(std::begin(kEntries), std::end(kEntries),
                                     [&](const Entry& e) { return e.effect == effect; });
    return found == std::end(kEntries) ? nullptr : found;
}

using StageCounts = std::vector<std::pair<std::string, std::size_t>>;

std::int64_t sum_of(const StageCounts& counts) {
    return std::accumulate(
        counts.begin(), counts.end(), std::int64_t{0},
        [](std::int64_t sum, const auto& stage) { return sum + std::int64_t(stage.second); });
}

EffectCost price(const Entry& entry, const Features& all, const StageCounts& with,
                 const SceneTables& tables) {
    Features features = all;
    entry.take_away(features);
    const StageCounts counts = count_stage_instructions(features);
    EffectCost cost;
    for (const auto& [name, instructions] : with)
        if (std::none_of(counts.begin(), counts.end(),
                         [&, &stage = name](const auto& c) { return c.first == stage; }))
            cost.stages.push_back(name);
    cost.instructions = sum_of(with) - sum_of(counts);
    cost.path_bytes = 16 * (path_texels(all) - path_texels(features));
    const auto is_own = [&](const std::string& name) {
        return std::find(entry.tables.begin(), entry.tables.end(), name) != entry.tables.end();
    };
    for (const auto& [name, bytes] : tables.bytes)
        if (is_own(name)) cost.bytes += bytes;
    if (is_own("voxels")) cost.bytes += tables.voxels.bytes.size();
    return cost;
}

} // namespace

std::optional<Features> features_without(const std::string& effect, Features features) {
    const Entry* entry = find_entry(effect);
    if (!entry) return std::nullopt;
    entry->take_away(features);
    return features;
}

std::vector<std::optional<EffectCost>> price_effects(const Effects& effects,
                                                     const SceneTables& tables) {
    const Features features = tables.features(effects.features);
    const StageCounts with = count_stage_instructions(features);
    std::vector<std::optional<EffectCost>> costs;
    for (const Effect& effect : effects.list) {
        const Entry* entry = effect.value == "no" ? nullptr : find_entry(effect.name);
        costs.push_back(entry ? std::optional(price(*entry, features, with, tables))
                              : std::nullopt);
    }
    return costs;
}

} // namespace tyndall

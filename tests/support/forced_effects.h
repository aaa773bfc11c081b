/// Effects that a scene does not call for, forced on: the image stays, only time and code grow.
#pragma once

#include "shared/features.h"

#include <array>

namespace tyndall::support {

struct ForcedEffect {
    const char* name;
    void (*force)(shared::Features&);
};

/// For grey scenes with a hierarchy, a homogeneous medium, a diffuse surface and a point light.
inline constexpr std::array<ForcedEffect, 12> kForcedEffects{{
    {"three channels", [](shared::Features& f) { f.is_grey = 0; }},
    {"emission of media", [](shared::Features& f) { f.has_emission = 1; }},
    {"phase functions", [](shared::Features& f) { f.phases = 15, f.has_delta_phases = 1; }},
    {"mixtures of phases", [](shared::Features& f) { f.phases = 15, f.has_mixtures = 1; }},
    {"environment", [](shared::Features& f) { f.has_environment = 1; }},
    {"shading normals", [](shared::Features& f) { f.has_shading_normals = 1; }},
    {"emitting surfaces", [](shared::Features& f) { f.has_emitters = 1; }},
    {"all surfaces", [](shared::Features& f) { f.surface_queues = 1023, f.has_thin_panes = 1; }},
    {"grids and atmospheres",
     [](shared::Features& f) { f.densities = 14, f.has_temperature = f.has_rgb_grids = 1; }},
    {"lens and limit", [](shared::Features& f) { f.has_lens = f.has_clamp = 1; }},
    {"boundaries in touch", [](shared::Features& f) { f.has_contacts = 1; }},
    {"all lights", [](shared::Features& f) { f.lights = 31, f.light_candidates = 4; }},
}};

} // namespace tyndall::support

/// Measured coefficients of materials, by the names that pbrt has for them.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>
#include <string_view>

namespace tyndall {

/// Of a material without a direction of its own: sigma_s is the reduced coefficient (use g = 0)
/// [1/mm].
struct MediumPreset {
    Rgb sigma_a;
    Rgb sigma_s;
};

/// Sources: Jensen et al., A Practical Model for Subsurface Light Transport (SIGGRAPH 2001), figure
/// 5; Narasimhan et al., Acquiring Scattering Properties of Participating Media by Dilution
/// (SIGGRAPH 2006), table 2.
std::optional<MediumPreset> find_medium_preset(std::string_view name);

/// All names, for a message.
std::string medium_preset_names();

} // namespace tyndall

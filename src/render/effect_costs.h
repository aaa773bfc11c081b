/// What effects cost in a scene.
#pragma once

#include "render/effects.h"
#include "render/scene_tables.h"

#include <optional>
#include <string>
#include <vector>

namespace tyndall {

/// What would not be there if the scene did not call for an effect.
struct EffectCost {
    std::vector<std::string> stages;
    std::int64_t instructions = 0; ///< SPIR-V of all stages.
    std::uint64_t bytes = 0;       ///< Tables of the scene.
    std::uint32_t path_bytes = 0;  ///< State of each path in flight.
};

/// The features of a scene that does not have the effect, nor what cannot be without it.
/// @param effect  a name in Effects::list, whose value is "yes" or "no".
/// @return Nothing if there is no such effect.
std::optional<shared::Features> features_without(const std::string& effect,
                                                 shared::Features features);

/// The cost of each effect of the list, in its order; nothing for what is not simulated, and for
/// what is no effect but a choice ("geometry").
std::vector<std::optional<EffectCost>> price_effects(const Effects& effects,
                                                     const SceneTables& tables);

} // namespace tyndall

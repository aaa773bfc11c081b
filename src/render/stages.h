/// The stages of the wavefront: the order in which they run, what calls for each, and its code.
#pragma once

#include "shared/features.h"
#include "shared/records.h"

#include <cstdint>
#include <span>

namespace tyndall {

/// What a stage runs on.
enum class StageInput {
    slots, ///< All slots of paths.
    queue, ///< The slots in its queue.
    once,  ///< Nothing: one invocation.
    folds, ///< The pixels of batches that are complete.
};

struct StageKind {
    const char* name;
    std::span<const std::uint32_t> spirv;
    StageInput input;
    std::uint32_t queue; ///< QUEUE_*, where that is the input.
    bool (*is_called_for)(const shared::Features&);
    bool is_rough = true; ///< Features::is_rough is set by stage.

    /// The features of a scene, as this stage is specialized to them.
    shared::Features features(shared::Features scene) const {
        scene.is_rough = is_rough;
        return scene;
    }
};

/// All stages, in the order in which a round runs those that the scene calls for.
std::span<const StageKind> stage_kinds();

} // namespace tyndall

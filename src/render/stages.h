/// The stages of the wavefront: the order in which they run, what calls for each, and its code.
#pragma once

#include "shared/features.h"
#include "shared/records.h"

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tyndall {

/// What a stage runs on.
enum class StageInput {
    slots, ///< All slots of paths, if any has work.
    queue, ///< The slots in its queue.
    once,  ///< Nothing: one invocation.
    folds, ///< The pixels of pieces that are complete.
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

/// Those of a round of which all that paths go through is one kernel: for scenes with a hierarchy,
/// through which paths do not march.
std::span<const StageKind> fused_stage_kinds();

/// Texels of state that a path in flight needs: PATH_* below are used, those from it on are not.
std::uint32_t path_texels(const shared::Features& features);

/// Instructions of SPIR-V, by stage that is called for, in order.
std::vector<std::pair<std::string, std::size_t>>
count_stage_instructions(const shared::Features& features);

} // namespace tyndall

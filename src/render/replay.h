/// One path on the device, told event by event.
#pragma once

#include "gpu/context.h"
#include "scene/path_event.h"

namespace tyndall {

/// Traces the sample of the pixel (x, y) of the picture, by the kernels that render it, one for
/// each event. Keeps pointers into the scene.
/// @param capacity  Events that are kept; the rest are only counted.
/// @throws Error    if the device fails.
Replay replay_path(const gpu::Context& context, const Scene& scene, int x, int y,
                   std::uint32_t sample, std::uint32_t capacity = kMostEvents);

} // namespace tyndall

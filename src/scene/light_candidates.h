/// How many lights sampling looks at before it takes one.
#pragma once

#include "scene/scene.h"

#include <cstdint>

namespace tyndall {

/// Lights that are drawn by their power wherever one is sampled, to choose among them by what they
/// bring to that place: 1 to 16. 1, and power alone decides, if there is one light, if all are at
/// infinity, or if paths march.
std::uint32_t light_candidates(const Scene& scene);

} // namespace tyndall

/// Where light can come from in a scene whose medium has no end.
#pragma once

#include "scene/scene.h"

#include <optional>

namespace tyndall {

struct Ball {
    glm::dvec3 center; ///< In the world.
    double radius;     ///< > 0
};

/// A ball that holds every surface and every light, where the camera's medium goes on around it:
/// paths that stray from it bring back little, and the less the farther they are (roulette). None
/// if light comes from infinity, if a medium emits, or if the camera is in a vacuum.
std::optional<Ball> find_lit_ball(const Scene& scene);

} // namespace tyndall

/// Boxes around shapes, in the world.
#pragma once

#include "scene/scene.h"

#include <limits>

namespace tyndall {

struct WorldBox {
    glm::dvec3 lower{std::numeric_limits<double>::infinity()}; ///< Above `upper`: empty.
    glm::dvec3 upper{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& point) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    /// The shape of the world (identity), or of a definition that is placed in it.
    void add(const Shape& shape, const glm::dmat4& world_from_definition);
};

} // namespace tyndall

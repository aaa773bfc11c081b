/// Meshes that are boxes: the usual container of a medium, and far cheaper to hit than twelve
/// triangles.
#pragma once

#include "scene/scene.h"

#include <optional>

namespace tyndall {

/// lower < upper on every axis.
struct AxisBox {
    glm::dvec3 lower{0}, upper{0};
    bool is_inward = false; ///< The normals point inward.
};

/// The box whose closed surface the mesh is after the transform, if it is one: each face two
/// triangles (or a patch) with exactly the corners of an axis-aligned box, all oriented alike. Not
/// so if the mesh has vertex normals.
std::optional<AxisBox> find_box(const Shape& shape, const Mesh& mesh, const glm::dmat4& transform);

} // namespace tyndall

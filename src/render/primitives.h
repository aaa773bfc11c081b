/// Shapes as primitives: triangles, patches, quadrics, in render space or in the space of an
/// object.
#pragma once

#include "render/box.h"
#include "render/bvh.h"
#include "scene/scene.h"
#include "shared/features.h"

#include <vector>

namespace tyndall {

/// Primitives and what they refer to, growing shape by shape.
struct PrimitiveSet {
    std::vector<shared::PrimitiveRecord> primitives;
    std::vector<Bounds> bounds; ///< Of each primitive.
    std::vector<double> areas;  ///< Of each primitive that emits, else 0.
    std::uint32_t kinds = 0;    ///< PRIMITIVE_* bits.
    std::vector<std::uint64_t>
        source_order; ///< Of each primitive, in the order of shapes and their parts.
    std::vector<glm::vec4> vertex_normals;
    std::vector<shared::QuadricRecord> quadrics;
};

/// Shapes as two sets, as the device walks them.
struct ShapeSet {
    PrimitiveSet triangles;
    PrimitiveSet others;     ///< Patches, quadrics and boxes.
    std::uint64_t count = 0; ///< Primitives so far.
};

/// Appends the primitives of a shape. Triangles without area are left out.
/// @param to_target    from the space that shape.world_from_object leads to, to the one of the
/// hierarchy
/// @param shape_index  of the shape's record
/// Vertex normals and quadrics are numbered from the beginning of `set`.
void append_shape(const Shape& shape, const glm::dmat4& to_target, std::uint32_t shape_index,
                  ShapeSet& set);

/// The box that the mesh is rendered as, if it is one (render/box.h) and does not emit.
std::optional<AxisBox> find_plain_box(const Shape& shape, const Mesh& mesh,
                                      const glm::dmat4& transform);

/// Whether the patches of the mesh are flat and convex, and so are rendered as two triangles each:
/// then nothing depends on their parameters. Not so for those that emit or have vertex normals.
bool are_patches_flat(const Shape& shape, const Mesh& mesh);

shared::AffineRecord make_affine(const glm::dmat4& m);

} // namespace tyndall

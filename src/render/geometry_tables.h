/// Hierarchies of what rays can meet, as the device walks them (shaders/wavefront/geometry.glsl).
#pragma once

#include "render/bvh.h"
#include "scene/scene.h"
#include "shared/records.h"

#include <functional>
#include <vector>

namespace tyndall {

/// Where the walks start: child words of NodeRecord, or NONE.
struct HierarchyRoots {
    std::uint32_t triangles = shared::NONE;
    std::uint32_t others = shared::NONE;
    bool is_empty() const { return triangles == shared::NONE && others == shared::NONE; }
};

struct GeometryTables {
    std::vector<shared::PrimitiveRecord> primitives; ///< In leaf order, hierarchy after hierarchy.
    std::vector<double> areas;                       ///< Of each primitive.
    std::vector<std::uint64_t> source_order; ///< Of each primitive, in the order of the scene.
    std::vector<shared::NodeRecord> nodes;
    std::vector<glm::vec4> vertex_normals;
    std::vector<shared::QuadricRecord> quadrics;
    std::vector<shared::InstanceRecord> instances;
    HierarchyRoots world; ///< Of shapes outside of object definitions.
    std::uint32_t instance_root = shared::NONE;
    std::uint32_t kinds = 0; ///< PRIMITIVE_* bits that occur.
    Bounds bounds;           ///< Of everything, in render space.
};

/// InstanceRecord::medium_shift of an instance, from its world_from_definition.
using MediumShift = std::function<std::uint32_t(const glm::dmat4&)>;

/// @param render_from_world  a translation
/// Shape records count the shapes of the scene, then those of its object definitions. Throws Error
/// if there are more primitives than the device can address.
GeometryTables make_geometry_tables(const Scene& scene, const glm::dmat4& render_from_world,
                                    const MediumShift& medium_shift);

} // namespace tyndall

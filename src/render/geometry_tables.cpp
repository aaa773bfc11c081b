#include "render/geometry_tables.h"

#include "core/error.h"
#include "render/bvh.h"
#include "render/primitives.h"

#include <cmath>
#include <fmt/format.h>

namespace tyndall {
namespace {

using namespace shared;

constexpr std::uint32_t kLeafSize = 4;
/// Testing so many triangles one after the other, in step, costs less than a walk that lanes take
/// differently.
constexpr std::uint32_t kOneLeafSize = 24;

static_assert(sizeof(PrimitiveRecord) == PRIMITIVE_TEXELS * 16);
static_assert(sizeof(QuadricRecord) == QUADRIC_TEXELS * 16);
static_assert(sizeof(InstanceRecord) == INSTANCE_TEXELS * 16);
static_assert(sizeof(NodeRecord) == NODE_TEXELS * 16);

class GeometryPacker {
  public:
    GeometryPacker(const Scene& scene, const glm::dmat4& render_from_world,
                   const MediumShift& medium_shift)
        : scene_(scene), render_from_world_(render_from_world), medium_shift_(medium_shift) {}
    GeometryTables build();

  private:
    HierarchyRoots build_hierarchies(ShapeSet& set, Bounds& bounds);
    std::uint32_t build_hierarchy(PrimitiveSet& set, std::uint32_t leaf_size,
                                  std::uint32_t one_leaf_size, Bounds& bounds);

    const Scene& scene_;
    const glm::dmat4& render_from_world_;
    const MediumShift& medium_shift_;
    GeometryTables tables_;
};

/// Appends primitives in leaf order with their nodes; returns the root's child word.
std::uint32_t GeometryPacker::build_hierarchy(PrimitiveSet& set, std::uint32_t leaf_size,
                                              std::uint32_t one_leaf_size, Bounds& bounds) {
    tables_.kinds |= set.kinds;
    const Bvh bvh = build_bvh(set.bounds, leaf_size, one_leaf_size);
    bounds = bvh.bounds;
    if (!bvh.nodes.empty()) tables_.kinds |= PRIMITIVE_TREES;
    const auto first_node = static_cast<std::uint32_t>(tables_.nodes.size());
    const auto first_primitive = static_cast<std::uint32_t>(tables_.primitives.size());
    const auto first_normal = static_cast<std::uint32_t>(tables_.vertex_normals.size());
    const auto first_quadric = static_cast<std::uint32_t>(tables_.quadrics.size());
    if (first_primitive + set.primitives.size() > LEAF_FIRST_MASK)
        throw Error(ExitStatus::failed, fmt::format("more than {} primitives", LEAF_FIRST_MASK));
    const auto rebase = [&](std::uint32_t child) {
        return child + (child & LEAF ? first_primitive : first_node);
    };
    for (NodeRecord node : bvh.nodes) {
        node.child0 = rebase(node.child0);
        node.child1 = rebase(node.child1);
        tables_.nodes.push_back(node);
    }
    for (std::uint32_t index : bvh.order) {
        PrimitiveRecord p = set.primitives[index];
        const std::uint32_t kind = p.kind_and_shape >> KIND_SHIFT;
        if (kind == KIND_SPHERE || kind == KIND_DISK)
            p.extra += first_quadric;
        else if (kind != KIND_INSTANCE && p.extra != NONE)
            p.extra += first_normal;
        tables_.primitives.push_back(p);
        tables_.areas.push_back(set.areas[index]);
        tables_.source_order.push_back(set.source_order[index]);
    }
    tables_.vertex_normals.insert(tables_.vertex_normals.end(), set.vertex_normals.begin(),
                                  set.vertex_normals.end());
    tables_.quadrics.insert(tables_.quadrics.end(), set.quadrics.begin(), set.quadrics.end());
    return rebase(bvh.root);
}

Bounds unite(const Bounds& a, const Bounds& b) {
    return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)};
}

/// Box of the image of a box.
Bounds transform_bounds(const glm::dmat4& m, const Bounds& b) {
    glm::dvec3 lower(INFINITY), upper(-INFINITY);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p =
            m * glm::dvec4(corner & 1 ? b.upper.x : b.lower.x, corner & 2 ? b.upper.y : b.lower.y,
                           corner & 4 ? b.upper.z : b.lower.z, 1);
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    // What is found inside with the error of float32 transforms must not be cut off outside.
    const glm::dvec3 margin = 2e-6 * glm::max(glm::abs(lower), glm::abs(upper));
    return round_outward(lower - margin, upper + margin);
}

HierarchyRoots GeometryPacker::build_hierarchies(ShapeSet& set, Bounds& bounds) {
    HierarchyRoots roots;
    Bounds triangle_bounds, other_bounds;
    if (!set.triangles.primitives.empty())
        roots.triangles = build_hierarchy(set.triangles, kLeafSize, kOneLeafSize, triangle_bounds);
    if (!set.others.primitives.empty())
        roots.others = build_hierarchy(set.others, 1, 4, other_bounds);
    bounds = roots.triangles == NONE ? other_bounds
             : roots.others == NONE  ? triangle_bounds
                                     : unite(triangle_bounds, other_bounds);
    return roots;
}

GeometryTables GeometryPacker::build() {
    const auto world_shape_count = static_cast<std::uint32_t>(scene_.shapes.size());
    std::vector<HierarchyRoots> object_roots;
    std::vector<Bounds> object_bounds;
    std::uint32_t shape_index = world_shape_count;
    for (const ObjectDefinition& object : scene_.objects) {
        ShapeSet set;
        for (const Shape& shape : object.shapes)
            append_shape(shape, glm::dmat4(1), shape_index++, set);
        object_roots.push_back(build_hierarchies(set, object_bounds.emplace_back()));
    }
    ShapeSet world;
    for (std::uint32_t i = 0; i < world_shape_count; ++i)
        append_shape(scene_.shapes[i], render_from_world_, i, world);
    Bounds bounds;
    const HierarchyRoots roots = build_hierarchies(world, bounds);
    tables_.world = roots;
    if (!roots.is_empty()) tables_.bounds = bounds;

    PrimitiveSet instances;
    for (const ObjectInstance& instance : scene_.instances) {
        const HierarchyRoots& object = object_roots[instance.object];
        if (object.is_empty()) continue;
        const glm::dmat4 m = render_from_world_ * instance.world_from_definition;
        const std::vector<Shape>& shapes = scene_.objects[instance.object].shapes;
        const bool bounds_media = std::any_of(
            shapes.begin(), shapes.end(), [](const Shape& s) { return s.media.is_transition(); });
        instances.primitives.push_back(
            {.kind_and_shape = KIND_INSTANCE << KIND_SHIFT,
             .light = NONE,
             .extra = static_cast<std::uint32_t>(tables_.instances.size())});
        instances.bounds.push_back(transform_bounds(m, object_bounds[instance.object]));
        instances.areas.push_back(0);
        instances.source_order.push_back(0);
        tables_.instances.push_back(
            {.object_from_world = make_affine(glm::inverse(m)),
             .world_from_object = make_affine(m),
             .triangle_root = object.triangles,
             .other_root = object.others,
             .medium_shift = bounds_media ? medium_shift_(instance.world_from_definition) : 0});
    }
    if (instances.primitives.empty()) return std::move(tables_);
    instances.kinds = PRIMITIVE_INSTANCES;
    tables_.instance_root = build_hierarchy(instances, 1, 1, bounds); // one to a leaf
    tables_.bounds = roots.is_empty() ? bounds : unite(tables_.bounds, bounds);
    return std::move(tables_);
}

} // namespace

GeometryTables make_geometry_tables(const Scene& scene, const glm::dmat4& render_from_world,
                                    const MediumShift& medium_shift) {
    return GeometryPacker(scene, render_from_world, medium_shift).build();
}

} // namespace tyndall

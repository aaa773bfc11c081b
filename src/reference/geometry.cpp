#include "reference/geometry.h"

#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::reference {
namespace {

Bounds transform(const Bounds& box, const Placement& placement) {
    Bounds result;
    for (int corner = 0; corner < 8 && !box.empty(); ++corner)
        result.extend(placement.point({corner & 1 ? box.upper.x : box.lower.x,
                                       corner & 2 ? box.upper.y : box.lower.y,
                                       corner & 4 ? box.upper.z : box.lower.z}));
    return result;
}

} // namespace

/// Keeps the nearest hit; goes down into instances with the ray in their own space, where t is the
/// same because its direction is not normalised.
class Geometry::NearestHit final : public BoxTree::Visitor {
  public:
    /// Within the instance of that placement, or in the world (nullptr).
    NearestHit(const Geometry& geometry, const Group& group, const Ray& ray,
               const SurfaceHit* other_than, const Placement* placement)
        : geometry_(geometry), group_(group), ray_(ray), other_than_(other_than),
          placement_(placement) {}

    double visit(std::uint32_t item, double t_max) override {
        if (item >= group_.items.size()) return visit_instance(item - group_.items.size(), t_max);
        const PrimitiveId id = group_.items[item];
        if (other_than_ && other_than_->space == space() && other_than_->id == id) return t_max;
        const auto hit = group_.surfaces[id.surface].intersect(id.primitive, ray_, t_max);
        if (!hit) return t_max;
        hit_ = {{*hit, id, &group_.surfaces[id.surface], placement_}};
        return hit->t;
    }

    std::optional<SurfaceHit> result() const {
        if (!hit_) return std::nullopt;
        SurfacePoint point = hit_->surface->point(hit_->id.primitive, hit_->where.parameters);
        if (const Placement* placement = hit_->placement) {
            // In an instance: lengths grow by at most the norm of the map.
            const double scale = glm::length(placement->linear[0]) +
                                 glm::length(placement->linear[1]) +
                                 glm::length(placement->linear[2]);
            point.error = point.error * scale + placement->error(point.position);
            point.position = placement->point(point.position);
            point.normal = placement->normal(point.normal);
            point.shading_normal = placement->normal(point.shading_normal);
        }
        const Placement* space = hit_->placement ? hit_->placement : &geometry_.world_space_;
        return SurfaceHit{hit_->where.t, point, &hit_->surface->shape(), hit_->id, space};
    }

  private:
    struct Found {
        PrimitiveHit where;
        PrimitiveId id;
        const Surface* surface;
        const Placement* placement;
    };

    const Placement* space() const { return placement_ ? placement_ : &geometry_.world_space_; }

    double visit_instance(std::size_t index, double t_max) {
        const Instance& instance = geometry_.instances_[index];
        const Group& definition = geometry_.definitions_[static_cast<std::size_t>(instance.object)];
        const Ray local = instance.placement.inverse_ray(ray_);
        NearestHit inside(geometry_, definition, local, other_than_, &instance.placement);
        definition.tree.traverse(local, t_max, inside);
        if (!inside.hit_) return t_max;
        hit_ = inside.hit_;
        return hit_->where.t;
    }

    const Geometry& geometry_;
    const Group& group_;
    const Ray& ray_;
    const SurfaceHit* other_than_;
    const Placement* placement_;
    std::optional<Found> hit_;
};

Geometry::Group Geometry::make_group(const std::vector<Shape>& shapes,
                                     const dmat4& space_from_world,
                                     const std::vector<Bounds>& more_boxes) {
    std::vector<Surface> surfaces;
    std::vector<PrimitiveId> items;
    std::vector<Bounds> boxes;
    for (std::uint32_t s = 0; s < shapes.size(); ++s) {
        surfaces.emplace_back(shapes[s], space_from_world * shapes[s].world_from_object);
        for (std::uint32_t p = 0; p < surfaces[s].primitive_count(); ++p) {
            items.push_back({s, p});
            boxes.push_back(surfaces[s].bounds(p));
        }
    }
    boxes.insert(boxes.end(), more_boxes.begin(), more_boxes.end());
    return {std::move(surfaces), std::move(items), BoxTree(boxes)};
}

Geometry::Geometry(const Scene& scene, const dvec3& camera_position)
    : world_space_(glm::translate(dmat4(1), -camera_position)), world_{{}, {}, BoxTree({})} {
    const dmat4 render_from_world = glm::translate(dmat4(1), -camera_position);
    for (const ObjectDefinition& object : scene.objects)
        definitions_.push_back(make_group(object.shapes, dmat4(1), {}));
    std::vector<Bounds> instance_boxes;
    for (const ObjectInstance& instance : scene.instances) {
        const Bounds& box = definitions_[static_cast<std::size_t>(instance.object)].tree.bounds();
        if (box.empty()) continue;
        const Placement placement(render_from_world * instance.world_from_definition);
        instances_.push_back({instance.object, placement});
        instance_boxes.push_back(transform(box, placement));
    }
    world_ = make_group(scene.shapes, render_from_world, instance_boxes);
}

std::optional<SurfaceHit> Geometry::intersect(const Ray& ray, double t_max,
                                              const SurfaceHit* other_than) const {
    NearestHit nearest(*this, world_, ray, other_than, nullptr);
    world_.tree.traverse(ray, t_max, nearest);
    return nearest.result();
}

} // namespace tyndall::reference

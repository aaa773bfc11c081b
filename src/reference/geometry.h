/// All surfaces of a scene, in render space: the world, moved so that the camera is at the origin.
#pragma once

#include "reference/box_tree.h"
#include "reference/surface.h"

namespace tyndall::reference {

/// Names a primitive of the world, or of the definition of an instance.
struct PrimitiveId {
    std::uint32_t surface; ///< Index into Scene::shapes, or those of the definition.
    std::uint32_t primitive;

    bool operator==(const PrimitiveId&) const = default;
};

struct SurfaceHit {
    double t;
    SurfacePoint point;
    const Shape* shape;
    PrimitiveId id;
    const Placement*
        space; ///< Render space from the world, or from the definition of the instance.
};

class Geometry {
  public:
    /// Keeps a reference to the scene.
    Geometry(const Scene& scene, const dvec3& camera_position);

    /// The nearest surface with 0 < t < t_max, but for the primitive of `other_than`; interfaces
    /// are surfaces, too.
    std::optional<SurfaceHit> intersect(const Ray& ray, double t_max,
                                        const SurfaceHit* other_than = nullptr) const;

    /// Render space from the world.
    const Placement& world_space() const { return world_space_; }
    /// One for each of Scene::shapes.
    const std::vector<Surface>& surfaces() const { return world_.surfaces; }
    /// Of all surfaces; empty without any.
    const Bounds& bounds() const { return world_.tree.bounds(); }

  private:
    struct Instance {
        int object;
        Placement placement; ///< Render space from the space of the definition.
    };
    /// The surfaces of a definition, or of the world with its instances.
    struct Group {
        std::vector<Surface> surfaces;
        std::vector<PrimitiveId> items; ///< What the boxes are; instances follow in their order.
        BoxTree tree;
    };
    class NearestHit;

    static Group make_group(const std::vector<Shape>& shapes, const dmat4& space_from_world,
                            const std::vector<Bounds>& more_boxes);

    Placement world_space_;
    std::vector<Group> definitions_;
    std::vector<Instance> instances_;
    Group world_;
};

} // namespace tyndall::reference

/// One Shape in double precision: intersection, points, normals and areas of its primitives.
///
/// "Space" is the one that the surface is traced in: render space, or the space of a definition for
/// the shapes of an instanced object. Primitives of a mesh are its triangles, then its patches;
/// spheres and disks have one.
#pragma once

#include "reference/sampling.h"
#include "scene/scene.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace tyndall::reference {

struct Bounds {
    dvec3 lower{std::numeric_limits<double>::infinity()};
    dvec3 upper{-std::numeric_limits<double>::infinity()};

    bool empty() const { return lower.x > upper.x; }
    void extend(const dvec3& p) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    void extend(const Bounds& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
    }
};

/// Where on a primitive: (weight of p1, weight of p2) of a triangle, (u, v) of a patch, the point
/// in object space of a sphere or disk.
using Parameters = dvec3;

struct PrimitiveHit {
    double t; ///< In lengths of the ray's direction, > 0.
    Parameters parameters;
};

struct SurfacePoint {
    dvec3 position;
    dvec3 normal;         ///< Unit, oriented by the rule in scene.h.
    dvec3 shading_normal; ///< Unit; the interpolated one where the mesh has vertex normals.
    double jacobian; ///< Area per unit of the square that Surface::sample maps to the primitive.
    double error;    ///< Bound on the distance to the exact surface; see leave().
};

/// Affine map between two spaces, with its inverse.
struct Placement {
    explicit Placement(const dmat4& matrix);

    dvec3 point(const dvec3& p) const { return linear * p + offset; }
    dvec3 inverse_point(const dvec3& p) const { return inverse * (p - offset); }
    dvec3 normal(const dvec3& n) const { return glm::normalize(glm::transpose(inverse) * n); }
    Ray inverse_ray(const Ray& ray) const {
        return {inverse_point(ray.origin), inverse * ray.direction};
    }
    bool mirrors() const { return glm::determinant(linear) < 0; }
    /// Bound on the rounding error of mapping p, and of mapping it there and back.
    double error(const dvec3& p) const;

    dmat3 linear, inverse;
    dvec3 offset;
};

/// Where a ray starts that leaves a surface in this direction: on the side it goes to, as far from
/// the surface as rounding could have put the point on the other side.
dvec3 leave(const SurfacePoint& point, const dvec3& direction);

class Surface {
  public:
    /// Keeps a reference to the shape.
    Surface(const Shape& shape, const dmat4& space_from_object);

    const Shape& shape() const { return *shape_; }
    std::uint32_t primitive_count() const;
    Bounds bounds(std::uint32_t primitive) const;

    /// The first hit with 0 < t < t_max.
    std::optional<PrimitiveHit> intersect(std::uint32_t primitive, const Ray& ray,
                                          double t_max) const;
    SurfacePoint point(std::uint32_t primitive, const Parameters& parameters) const;

    /// Maps the unit square onto the primitive. Uniform in area on triangles, disks and spheres
    /// that are not distorted; on others uniform in (u, v) or (phi, z).
    Parameters sample(std::uint32_t primitive, double u1, double u2) const;
    /// Area of a primitive: the integral of the jacobian.
    double area(std::uint32_t primitive) const;

    bool is_sphere() const { return std::holds_alternative<Sphere>(shape_->geometry); }
    bool is_patch(std::uint32_t primitive) const;
    /// The middle of a primitive; of a sphere its centre, where the normal means nothing.
    SurfacePoint middle(std::uint32_t primitive) const;

    /// The sphere as a ball in space, if it is one: uncut, and scaled by the same in all
    /// directions.
    struct Ball {
        dvec3 center;
        double radius;
    };
    const std::optional<Ball>& ball() const { return ball_; }
    Parameters parameters_of_point(const dvec3& point_on_sphere) const;

  private:
    bool is_triangle(std::uint32_t primitive) const;
    std::array<dvec3, 3> triangle(std::uint32_t primitive) const;
    std::array<dvec3, 4> patch(std::uint32_t primitive) const;
    SurfacePoint triangle_point(std::uint32_t primitive, const Parameters& parameters) const;
    SurfacePoint patch_point(std::uint32_t primitive, const Parameters& parameters) const;
    SurfacePoint quadric_point(const Parameters& parameters) const;
    std::optional<Ball> find_ball() const;
    void orient(SurfacePoint& point, const dvec3& vertex_normal) const;

    const Shape* shape_;
    Placement placement_; ///< Space from object.
    bool flips_;          ///< Of a normal carried to space as a cross product or from a quadric.
    dmat3 cofactors_;     ///< Of the placement, up to the sign: they carry cross products.
    std::optional<Ball> ball_;
    std::vector<dvec3> positions_, normals_; ///< Of a mesh, in space.
};

} // namespace tyndall::reference

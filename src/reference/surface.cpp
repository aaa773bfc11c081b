#include "reference/surface.h"

#include "reference/primitives.h"
#include "reference/quadrature.h"

#include <algorithm>

namespace tyndall::reference {
namespace {

/// Rounding errors of a few operations on coordinates of magnitude 1, with a wide margin.
constexpr double rounding = 64 * 0x1p-52;

double largest(const dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

dmat3 magnitudes(const dmat3& m) {
    return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

} // namespace

Placement::Placement(const dmat4& matrix)
    : linear(matrix), inverse(glm::inverse(dmat3(matrix))), offset(matrix[3]) {}

double Placement::error(const dvec3& p) const {
    const dvec3 there = magnitudes(linear) * glm::abs(p) + glm::abs(offset);
    const dvec3 and_back = magnitudes(linear) * (magnitudes(inverse) * there);
    return rounding * std::max(largest(there), largest(and_back));
}

dvec3 leave(const SurfacePoint& point, const dvec3& direction) {
    const double side = glm::dot(point.normal, direction) > 0 ? 1 : -1;
    return point.position + side * point.error * point.normal;
}

Surface::Surface(const Shape& shape, const dmat4& space_from_object)
    : shape_(&shape), placement_(space_from_object),
      flips_(shape.reverse_orientation != placement_.mirrors()),
      cofactors_(std::abs(glm::determinant(placement_.linear)) *
                 glm::transpose(placement_.inverse)),
      ball_(find_ball()) {
    const auto* mesh = std::get_if<Mesh>(&shape.geometry);
    if (!mesh) return;
    for (const glm::vec3& p : mesh->positions)
        positions_.push_back(placement_.point(p));
    const double sign = shape.reverse_orientation ? -1 : 1;
    for (const glm::vec3& n : mesh->normals)
        normals_.push_back(sign * (glm::transpose(placement_.inverse) * dvec3(n)));
}

std::uint32_t Surface::primitive_count() const {
    const auto* mesh = std::get_if<Mesh>(&shape_->geometry);
    return mesh ? static_cast<std::uint32_t>(mesh->triangles.size() + mesh->patches.size()) : 1;
}

bool Surface::is_triangle(std::uint32_t primitive) const {
    const auto* mesh = std::get_if<Mesh>(&shape_->geometry);
    return mesh && primitive < mesh->triangles.size();
}

std::array<dvec3, 3> Surface::triangle(std::uint32_t primitive) const {
    const auto& [a, b, c] = std::get<Mesh>(shape_->geometry).triangles[primitive];
    return {positions_[a], positions_[b], positions_[c]};
}

std::array<dvec3, 4> Surface::patch(std::uint32_t primitive) const {
    const Mesh& mesh = std::get<Mesh>(shape_->geometry);
    const auto& [a, b, c, d] = mesh.patches[primitive - mesh.triangles.size()];
    return {positions_[a], positions_[b], positions_[c], positions_[d]};
}

Bounds Surface::bounds(std::uint32_t primitive) const {
    Bounds bounds;
    if (std::holds_alternative<Mesh>(shape_->geometry)) {
        if (is_triangle(primitive)) {
            for (const dvec3& p : triangle(primitive))
                bounds.extend(p);
        } else {
            for (const dvec3& p : patch(primitive))
                bounds.extend(p);
        }
        return bounds;
    }
    // Those of the whole ellipsoid or ellipse: cuts are left to the intersection.
    const dmat3 rows = glm::transpose(placement_.linear);
    dvec3 center = placement_.offset, extent;
    if (const auto* sphere = std::get_if<Sphere>(&shape_->geometry)) {
        for (int i = 0; i < 3; ++i)
            extent[i] = sphere->radius * glm::length(rows[i]);
    } else {
        const Disk& disk = std::get<Disk>(shape_->geometry);
        center = placement_.point({0, 0, disk.height});
        for (int i = 0; i < 3; ++i)
            extent[i] = disk.radius * glm::length(dvec2(rows[i]));
    }
    bounds.extend(center - extent);
    bounds.extend(center + extent);
    return bounds;
}

std::optional<PrimitiveHit> Surface::intersect(std::uint32_t primitive, const Ray& ray,
                                               double t_max) const {
    if (const auto* sphere = std::get_if<Sphere>(&shape_->geometry))
        return intersect_sphere(*sphere, placement_.inverse_ray(ray), t_max);
    if (const auto* disk = std::get_if<Disk>(&shape_->geometry))
        return intersect_disk(*disk, placement_.inverse_ray(ray), t_max);
    if (is_triangle(primitive)) return intersect_triangle(triangle(primitive), ray, t_max);
    return intersect_patch(patch(primitive), ray, t_max);
}

SurfacePoint Surface::point(std::uint32_t primitive, const Parameters& parameters) const {
    if (!std::holds_alternative<Mesh>(shape_->geometry)) return quadric_point(parameters);
    return is_triangle(primitive) ? triangle_point(primitive, parameters)
                                  : patch_point(primitive, parameters);
}

/// pbrt's rule: the normal is turned to the side of the vertex normals, where there are any.
void Surface::orient(SurfacePoint& point, const dvec3& vertex_normal) const {
    point.normal = glm::normalize(flips_ ? -point.normal : point.normal);
    point.shading_normal = point.normal;
    if (vertex_normal == dvec3(0)) return;
    point.shading_normal = glm::normalize(vertex_normal);
    if (glm::dot(point.normal, point.shading_normal) < 0) point.normal = -point.normal;
}

SurfacePoint Surface::triangle_point(std::uint32_t primitive, const Parameters& b) const {
    const auto [p0, p1, p2] = triangle(primitive);
    SurfacePoint point;
    point.position = p0 + b.x * (p1 - p0) + b.y * (p2 - p0);
    point.normal = glm::cross(p1 - p0, p2 - p0);
    point.jacobian = glm::length(point.normal) / 2;
    point.error = rounding * std::max({largest(p0), largest(p1), largest(p2)});
    dvec3 vertex_normal(0);
    if (!normals_.empty()) {
        const auto& [i, j, k] = std::get<Mesh>(shape_->geometry).triangles[primitive];
        vertex_normal = (1 - b.x - b.y) * normals_[i] + b.x * normals_[j] + b.y * normals_[k];
    }
    orient(point, vertex_normal);
    return point;
}

SurfacePoint Surface::patch_point(std::uint32_t primitive, const Parameters& uv) const {
    const auto [p00, p10, p01, p11] = patch(primitive);
    const auto bilinear = [&](const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
        return glm::mix(glm::mix(a, b, uv.x), glm::mix(c, d, uv.x), uv.y);
    };
    SurfacePoint point;
    point.position = bilinear(p00, p10, p01, p11);
    point.normal = glm::cross(glm::mix(p10 - p00, p11 - p01, uv.y),  // dp/du
                              glm::mix(p01 - p00, p11 - p10, uv.x)); // dp/dv
    point.jacobian = glm::length(point.normal);
    point.error = rounding * std::max({largest(p00), largest(p10), largest(p01), largest(p11)});
    dvec3 vertex_normal(0);
    if (!normals_.empty()) {
        const Mesh& mesh = std::get<Mesh>(shape_->geometry);
        const auto& [i, j, k, l] = mesh.patches[primitive - mesh.triangles.size()];
        vertex_normal = bilinear(normals_[i], normals_[j], normals_[k], normals_[l]);
    }
    orient(point, vertex_normal);
    return point;
}

SurfacePoint Surface::quadric_point(const Parameters& p) const {
    SurfacePoint point;
    point.position = placement_.point(p);
    point.error = placement_.error(p);
    if (const auto* sphere = std::get_if<Sphere>(&shape_->geometry)) {
        point.normal = cofactors_ * p;
        // |dp/dphi x dp/dz| is |p| = radius on the sphere itself.
        point.jacobian =
            sphere->phi_max * (sphere->z_max - sphere->z_min) * glm::length(point.normal);
    } else {
        const Disk& disk = std::get<Disk>(shape_->geometry);
        point.normal = cofactors_ * dvec3(0, 0, 1);
        point.jacobian = disk.phi_max / 2 *
                         (disk.radius * disk.radius - disk.inner_radius * disk.inner_radius) *
                         glm::length(point.normal);
    }
    orient(point, dvec3(0));
    return point;
}

Parameters Surface::sample(std::uint32_t primitive, double u1, double u2) const {
    if (const auto* sphere = std::get_if<Sphere>(&shape_->geometry)) {
        const double z = glm::mix(sphere->z_min, sphere->z_max, u1);
        const double r = std::sqrt(std::max(0.0, (sphere->radius - z) * (sphere->radius + z)));
        const double phi = sphere->phi_max * u2;
        return {r * std::cos(phi), r * std::sin(phi), z};
    }
    if (const auto* disk = std::get_if<Disk>(&shape_->geometry)) {
        const double inner = disk->inner_radius * disk->inner_radius;
        const double r = std::sqrt(glm::mix(inner, disk->radius * disk->radius, u1));
        const double phi = disk->phi_max * u2;
        return {r * std::cos(phi), r * std::sin(phi), disk->height};
    }
    if (!is_triangle(primitive)) return {u1, u2, 0};
    const double root = std::sqrt(u1); // p0 has the weight 1 - root.
    return {u2 * root, (1 - u2) * root, 0};
}

bool Surface::is_patch(std::uint32_t primitive) const {
    return std::holds_alternative<Mesh>(shape_->geometry) && !is_triangle(primitive);
}

SurfacePoint Surface::middle(std::uint32_t primitive) const {
    if (const auto* disk = std::get_if<Disk>(&shape_->geometry))
        return point(primitive, {0, 0, disk->height});
    if (is_sphere()) return point(primitive, dvec3(0));
    return point(primitive, dvec3(is_patch(primitive) ? 0.5 : 1.0 / 3));
}

double Surface::area(std::uint32_t primitive) const {
    const auto jacobian = [&](double u1, double u2) {
        return point(primitive, sample(primitive, u1, u2)).jacobian;
    };
    return integrate16(
        [&](double u1) { return integrate16([&](double u2) { return jacobian(u1, u2); }, 0, 1); },
        0, 1);
}

std::optional<Surface::Ball> Surface::find_ball() const {
    const auto* sphere = std::get_if<Sphere>(&shape_->geometry);
    if (!sphere || !sphere->is_full()) return std::nullopt;
    const dmat3& m = placement_.linear;
    const double squared = glm::dot(m[0], m[0]);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double expected = i == j ? squared : 0;
            if (std::abs(glm::dot(m[i], m[j]) - expected) > 1e-9 * squared) return std::nullopt;
        }
    }
    return Ball{placement_.offset, sphere->radius * std::sqrt(squared)};
}

Parameters Surface::parameters_of_point(const dvec3& point_on_sphere) const {
    return placement_.inverse_point(point_on_sphere);
}

} // namespace tyndall::reference

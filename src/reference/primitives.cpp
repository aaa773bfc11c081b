#include "reference/primitives.h"

#include <utility>

namespace tyndall::reference {
namespace {

/// Azimuth about +z in [0, 2 pi).
double azimuth(const dvec3& p) {
    const double phi = std::atan2(p.y, p.x);
    return phi < 0 ? phi + 2 * pi : phi;
}

/// Real roots of a + b x + c x^2, without cancellation.
struct Roots {
    int count = 0;
    std::array<double, 2> values{};
};

Roots solve_quadratic(double a, double b, double c) {
    if (c == 0) return b == 0 ? Roots{} : Roots{1, {-a / b}};
    const double discriminant = b * b - 4 * a * c;
    if (discriminant < 0) return {};
    const double q = -(b + std::copysign(std::sqrt(discriminant), b)) / 2;
    if (q == 0) return {1, {0}};
    return {2, {q / c, a / q}};
}

/// A point of a surface with its derivatives.
struct Tangent {
    dvec3 position, along_u, along_v;
};

Tangent tangent(const std::array<dvec3, 3>& p, double u, double v) {
    const dvec3 along_u = p[1] - p[0], along_v = p[2] - p[0];
    return {p[0] + u * along_u + v * along_v, along_u, along_v};
}

Tangent tangent(const std::array<dvec3, 4>& p, double u, double v) {
    const dvec3 low = glm::mix(p[0], p[1], u), high = glm::mix(p[2], p[3], u);
    return {glm::mix(low, high, v), glm::mix(p[1] - p[0], p[3] - p[2], v), high - low};
}

/// One step of Newton's method for position(u, v) = o + t d. It makes the residual as small as
/// rounding of the coordinates allows, whatever the shape of the primitive and the angle of the
/// ray.
template<class Corners>
PrimitiveHit polish(const Corners& corners, const Ray& ray, double u, double v, double t) {
    const Tangent at = tangent(corners, u, v);
    const dvec3 miss = at.position - ray.origin - t * ray.direction;
    const dvec3 normal = glm::cross(at.along_u, at.along_v);
    const double determinant = glm::dot(normal, ray.direction);
    if (determinant == 0) return {t, {u, v, 0}};
    const dvec3 across = glm::cross(miss, ray.direction) / determinant;
    return {t + glm::dot(normal, miss) / determinant,
            {u + glm::dot(across, at.along_v), v - glm::dot(across, at.along_u), 0}};
}

} // namespace

std::optional<PrimitiveHit> intersect_triangle(const std::array<dvec3, 3>& p, const Ray& ray,
                                               double t_max) {
    const dvec3& d = ray.direction;
    const dvec3 size = glm::abs(d);
    const int z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    const int x = (z + 1) % 3, y = (z + 2) % 3;
    // Shear and translate so that the ray is the z axis.
    std::array<dvec3, 3> q;
    for (std::size_t i = 0; i < 3; ++i) {
        const dvec3 r = p[i] - ray.origin;
        q[i] = {r[x] - d[x] / d[z] * r[z], r[y] - d[y] / d[z] * r[z], r[z] / d[z]};
    }
    const double w0 = q[2].x * q[1].y - q[2].y * q[1].x;
    const double w1 = q[0].x * q[2].y - q[0].y * q[2].x;
    const double w2 = q[1].x * q[0].y - q[1].y * q[0].x;
    if ((w0 < 0 || w1 < 0 || w2 < 0) && (w0 > 0 || w1 > 0 || w2 > 0)) return std::nullopt;
    const double sum = w0 + w1 + w2;
    if (sum == 0) return std::nullopt;
    const double t = (w0 * q[0].z + w1 * q[1].z + w2 * q[2].z) / sum;
    const PrimitiveHit hit = polish(p, ray, w1 / sum, w2 / sum, t);
    if (!(hit.t > 0 && hit.t < t_max)) return std::nullopt;
    return hit;
}

std::optional<PrimitiveHit> intersect_patch(const std::array<dvec3, 4>& p, const Ray& ray,
                                            double t_max) {
    // Lines u = const are lines; the one that meets the ray satisfies a quadratic equation in u.
    const dvec3& d = ray.direction;
    const double a = glm::dot(glm::cross(p[0] - ray.origin, d), p[2] - p[0]);
    const double c = glm::dot(glm::cross(p[1] - p[0], p[2] - p[3]), d);
    const double b = glm::dot(glm::cross(p[1] - ray.origin, d), p[3] - p[1]) - (a + c);
    const Roots roots = solve_quadratic(a, b, c);
    std::optional<PrimitiveHit> nearest;
    for (int i = 0; i < roots.count; ++i) {
        const double u = roots.values[static_cast<std::size_t>(i)];
        if (!(u >= 0 && u <= 1)) continue;
        const dvec3 start = glm::mix(p[0], p[1], u);
        const dvec3 line = glm::mix(p[2], p[3], u) - start;
        const dvec3 normal = glm::cross(d, line);
        const double scale = glm::dot(normal, normal);
        const dvec3 turned = glm::cross(normal, start - ray.origin);
        const double v = glm::dot(turned, d) / scale;
        if (!(v >= 0 && v <= 1)) continue;
        const PrimitiveHit hit = polish(p, ray, u, v, glm::dot(turned, line) / scale);
        if (!(hit.t > 0 && hit.t < t_max)) continue;
        t_max = hit.t;
        nearest = hit;
    }
    return nearest;
}

std::optional<PrimitiveHit> intersect_sphere(const Sphere& sphere, const Ray& ray, double t_max) {
    const dvec3& o = ray.origin;
    const dvec3& d = ray.direction;
    const double dd = glm::dot(d, d);
    const double od = glm::dot(o, d);
    // The discriminant from the point of the ray nearest to the centre: |o|^2 would cancel.
    const dvec3 nearest = o - od / dd * d;
    const double inside = sphere.radius - glm::length(nearest);
    if (inside < 0) return std::nullopt;
    const double root = std::sqrt(dd * inside * (sphere.radius + glm::length(nearest)));
    const double q = -(od + std::copysign(root, od));
    const double length = glm::length(o);
    const double c = (length - sphere.radius) * (length + sphere.radius);
    double t0 = q / dd, t1 = q == 0 ? 0 : c / q;
    if (t0 > t1) std::swap(t0, t1);
    for (double t : {t0, t1}) {
        if (!(t > 0 && t < t_max)) continue;
        const dvec3 p = (o + t * d) * (sphere.radius / glm::length(o + t * d));
        const bool cut = !sphere.is_full() &&
                         (p.z < sphere.z_min || p.z > sphere.z_max || azimuth(p) > sphere.phi_max);
        if (!cut) return PrimitiveHit{t, p};
    }
    return std::nullopt;
}

std::optional<PrimitiveHit> intersect_disk(const Disk& disk, const Ray& ray, double t_max) {
    if (ray.direction.z == 0) return std::nullopt;
    const double t = (disk.height - ray.origin.z) / ray.direction.z;
    if (!(t > 0 && t < t_max)) return std::nullopt;
    const dvec3 p(ray.origin.x + t * ray.direction.x, ray.origin.y + t * ray.direction.y,
                  disk.height);
    const double squared = p.x * p.x + p.y * p.y;
    if (squared > disk.radius * disk.radius || squared < disk.inner_radius * disk.inner_radius)
        return std::nullopt;
    if (azimuth(p) > disk.phi_max) return std::nullopt;
    return PrimitiveHit{t, p};
}

} // namespace tyndall::reference

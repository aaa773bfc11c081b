// Rays against boxes, triangles, quadrics and patches. Pure functions.
//
// Distances are in units of the direction's length, which need not be 1. There is no epsilon: a ray
// starts off its surface by the error of its origin (geometry.glsl), so "t > 0" is the whole test.
#ifndef TYNDALL_INTERSECT_GLSL
#define TYNDALL_INTERSECT_GLSL

#include "lib/sampling.glsl"
#include "shared/features.h"
#include "shared/records.h"

/// A ray with what every primitive test needs of it.
struct Ray {
    vec3 origin;
    vec3 direction;
    vec3 inverse;   ///< 1 / direction; so small that no infinity arises
    uvec3 backward; ///< 8 along axes down which the ray goes, else 0 (intersect_node)
    vec3 u, v;      ///< span the plane perpendicular to the direction
};

Ray make_ray(vec3 origin, vec3 direction) {
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    const bvec3 is_negative = lessThan(direction, vec3(0));
    const vec3 tiny = mix(vec3(1e-20), vec3(-1e-20), is_negative);
    ray.inverse = 1.0 / mix(direction, tiny, lessThan(abs(direction), vec3(1e-20)));
    ray.backward = mix(uvec3(0), uvec3(8), is_negative);
    make_frame(normalize(direction), ray.u, ray.v);
    return ray;
}

/// Whether the ray is in a box within [0, t_max], given the bits of where it enters and leaves the
/// slabs; `near` is where. Ints have the order of positive floats, and cost a third: on a CPU,
/// float minima look for NaN first. Far distances are widened by the error of five roundings of
/// each (Ize 2013, "Robust BVH Ray Traversal").
bool is_in_slabs(ivec3 entry, ivec3 exit, float t_max, out float near) {
    near = intBitsToFloat(max(max(entry.x, entry.y), max(entry.z, 0)));
    const int far = min(min(exit.x, exit.y), min(exit.z, floatBitsToInt(t_max)));
    return near <= intBitsToFloat(far) * (1.0 + 16.0 * EPSILON);
}

/// Distances to the planes that are bits 15 ... 22 of the words away from the origin.
ivec3 plane_distances(uvec3 words, vec3 start, vec3 stride) {
    const vec3 count = uintBitsToFloat((words & 0x7F8000u) | 0x3F800000u); // 1 + bits / 256
    return floatBitsToInt(count * stride + start);
}

/// Which boxes of the children of a node (NodeRecord, its texels) the ray meets within [0, t_max],
/// and where. Never misses a box that it enters or touches.
bvec2 intersect_node(Ray ray, uvec4 a, uvec4 b, float t_max, out vec2 near) {
    const uvec3 origin = uvec3(a.zw, b.x), boxes = b.yzw;
    const vec3 width = uintBitsToFloat(origin << NODE_WIDTH_SHIFT & NODE_WIDTH_MASK);
    const vec3 stride = width * ray.inverse;
    const vec3 start = (uintBitsToFloat(origin) - ray.origin) * ray.inverse - stride;
    const uvec3 back = ray.backward; // which byte is the near one
    const ivec3 entry0 = plane_distances(boxes << (15u - back), start, stride);
    const ivec3 exit0 = plane_distances(boxes << (7u + back), start, stride);
    const ivec3 entry1 = plane_distances(boxes >> (1u + back), start, stride);
    const ivec3 exit1 = plane_distances(boxes >> (9u - back), start, stride);
    const bool hit0 = is_in_slabs(entry0, exit0, t_max, near.x);
    const bool hit1 = is_in_slabs(entry1, exit1, t_max, near.y);
    return bvec2(hit0, hit1);
}

/// The surface of a box: where the ray enters, or from inside where it leaves.
bool intersect_box_surface(Ray ray, vec3 lower, vec3 upper, float t_max, out float t) {
    const vec3 a = (lower - ray.origin) * ray.inverse;
    const vec3 b = (upper - ray.origin) * ray.inverse;
    const vec3 entry = min(a, b);
    const vec3 exit = max(a, b);
    const float near = max(max(entry.x, entry.y), entry.z);
    const float far = min(min(exit.x, exit.y), exit.z);
    t = near > 0.0 ? near : far;
    return near <= far && t > 0.0 && t < t_max;
}

/// A vertex as seen along the ray. It depends on nothing but the ray and the vertex, so triangles
/// that share an edge see the same edge.
vec2 project_vertex(Ray ray, vec3 vertex) {
    precise vec3 p = vertex - ray.origin;
    precise float x = p.x * ray.u.x + p.y * ray.u.y + p.z * ray.u.z;
    precise float y = p.x * ray.v.x + p.y * ray.v.y + p.z * ray.v.z;
    return vec2(x, y);
}

/// Twice the signed area of the triangle (origin, p, q); exactly antisymmetric.
float edge(vec2 p, vec2 q) {
    precise float area = p.x * q.y - p.y * q.x;
    return area;
}

/// Watertight: of the triangles around an edge or a vertex, a ray hits at least one (Woop et al.
/// 2013, with a projection along the ray in place of the shear). The distance is that of the plane,
/// not of the vertices: far-away vertices do not spoil it.
bool intersect_triangle(Ray ray, vec3 a, vec3 b, vec3 c, vec3 normal, float offset, float t_max,
                        out float t) {
    const vec2 pa = project_vertex(ray, a);
    const vec2 pb = project_vertex(ray, b);
    const vec2 pc = project_vertex(ray, c);
    const float u = edge(pb, pc);
    const float v = edge(pc, pa);
    const float w = edge(pa, pb);
    const bool inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
    t = (offset - dot(normal, ray.origin)) / dot(normal, ray.direction);
    return inside && t > 0.0 && t < t_max; // a ray in the plane gives inf or NaN: no hit
}

/// Azimuth of a point about z, in [0, 2 pi).
float azimuth(vec3 p) {
    const float phi = atan(p.y, p.x);
    return phi < 0.0 ? phi + 2.0 * PI : phi;
}

/// Both distances to the sphere of the given radius about the origin, near before far.
/// Source: Haines et al. 2019, "Precision Improvements for Ray/Sphere Intersection".
bool intersect_sphere(vec3 origin, vec3 direction, float radius, out float near, out float far) {
    const float a = dot(direction, direction);
    const float b = -dot(origin, direction);
    const vec3 closest = origin + (b / a) * direction;
    const float discriminant = (radius - length(closest)) * (radius + length(closest));
    if (!(discriminant >= 0.0)) return false;
    const float distance_to_center = length(origin);
    const float c = (distance_to_center - radius) * (distance_to_center + radius);
    const float q = b + (b < 0.0 ? -1.0 : 1.0) * sqrt(a * discriminant);
    near = q == 0.0 ? 0.0 : c / q;
    far = q / a;
    if (near > far) {
        const float swap = near;
        near = far;
        far = swap;
    }
    return true;
}

/// A sphere cut to [z_min, z_max] and [0, phi_max].
bool intersect_cut_sphere(vec3 origin, vec3 direction, QuadricRecord q, float t_max, out float t) {
    float near, far;
    t = 0.0;
    if (!intersect_sphere(origin, direction, q.radius, near, far)) return false;
    for (int i = 0; i < 2; ++i) {
        t = i == 0 ? near : far;
        if (!(t > 0.0 && t < t_max)) continue;
        if ((primitives & PRIMITIVE_CUTS) == 0u || (q.flags & QUADRIC_FULL) != 0u) return true;
        const vec3 p = origin + t * direction;
        if (p.z >= q.z_min && p.z <= q.z_max && azimuth(p) <= q.phi_max) return true;
    }
    return false;
}

/// The annulus in the plane z = z_min.
bool intersect_disk(vec3 origin, vec3 direction, QuadricRecord q, float t_max, out float t) {
    t = (q.z_min - origin.z) / direction.z;
    if (!(t > 0.0 && t < t_max)) return false;
    const vec3 p = origin + t * direction;
    const float r = length(p.xy);
    if ((primitives & PRIMITIVE_CUTS) == 0u) return r <= q.radius;
    return r <= q.radius && r >= q.inner_radius && azimuth(p) <= q.phi_max;
}

/// A bilinear patch; uv of the hit. Source: Reshetov 2019, "Cool Patches" (Ray Tracing Gems, ch.
/// 8): for each root u of a quadratic, the ray is intersected with the line at u.
bool intersect_patch(Ray ray, vec3 p00, vec3 p10, vec3 p01, vec3 p11, float t_max, out float t,
                     out vec2 uv) {
    const vec3 q00 = p00 - ray.origin, q10 = p10 - ray.origin;
    const vec3 q01 = p01 - ray.origin, q11 = p11 - ray.origin;
    const vec3 d = ray.direction;
    const vec3 e10 = q10 - q00, e11 = q11 - q10, e00 = q01 - q00;
    const vec3 qn = cross(e10, q01 - q11);
    float a = dot(cross(q00, d), e00);
    const float c = dot(qn, d);
    float b = dot(cross(q10, d), e11) - (a + c);
    const float discriminant = b * b - 4.0 * a * c;
    t = t_max;
    if (!(discriminant >= 0.0)) return false;
    const float root = sqrt(discriminant);
    float u1, u2;
    if (c == 0.0) {
        u1 = -a / b;
        u2 = -1.0;
    } else {
        const float h = -0.5 * (b + (b < 0.0 ? -root : root));
        u1 = h / c;
        u2 = a / h;
    }
    bool hit = false;
    for (int i = 0; i < 2; ++i) {
        const float u = i == 0 ? u1 : u2;
        if (!(u >= 0.0 && u <= 1.0)) continue;
        const vec3 pa = mix(q00, q10, u);
        const vec3 pb = mix(e00, e11, u);
        const vec3 n = cross(d, pb);
        const float det = dot(n, n);
        const vec3 m = cross(n, pa);
        const float candidate = dot(m, pb) / det;
        const float v = dot(m, d) / det;
        if (candidate > 0.0 && candidate < t && v >= 0.0 && v <= 1.0) {
            t = candidate;
            uv = vec2(u, v);
            hit = true;
        }
    }
    return hit;
}

#endif

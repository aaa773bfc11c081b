#version 460
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "lib/intersect.glsl"

// Rays against primitives. Each invocation reads a ray (two texels: origin and direction) and the
// numbers of the primitive behind it. Variant 1 is the textbook's form.

/// Moeller and Trumbore 1997.
bool textbook_triangle(vec3 o, vec3 d, vec3 a, vec3 b, vec3 c, float t_max, out float t) {
    const vec3 e1 = b - a, e2 = c - a, p = cross(d, e2);
    const float inverse = 1.0 / dot(e1, p);
    const vec3 s = o - a, q = cross(s, e1);
    const float u = dot(s, p) * inverse, v = dot(d, q) * inverse;
    t = dot(e2, q) * inverse;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < t_max;
}

/// Woop et al. 2013 as printed: the distance is blended from those of the vertices.
bool blended_triangle(vec3 o, vec3 d, Ray ray, PrimitiveRecord p, float t_max, out float t) {
    const vec2 a = project_vertex(ray, p.a), b = project_vertex(ray, p.b),
               c = project_vertex(ray, p.c);
    const float u = edge(b, c), v = edge(c, a), w = edge(a, b);
    const vec3 depths = vec3(dot(p.a - o, d), dot(p.b - o, d), dot(p.c - o, d)) / dot(d, d);
    t = dot(vec3(u, v, w), depths) / (u + v + w);
    return ((u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0)) && t > 0.0;
}

bool any_triangle(vec3 o, vec3 d, Ray ray, PrimitiveRecord p, float t_max, out float t) {
    if (variant() == 2u) return blended_triangle(o, d, ray, p, t_max, t);
    if (variant() != 0u) return textbook_triangle(o, d, p.a, p.b, p.c, t_max, t);
    return intersect_triangle(ray, p.a, p.b, p.c, p.normal, p.offset, t_max, t);
}

/// A ray against all push.shapes triangles from texel push.primitives on: nearest distance, hits.
vec4 mesh(uint i) {
    const vec3 o = input_texel(push.media + 2u * i).xyz,
               d = input_texel(push.media + 2u * i + 1u).xyz;
    const Ray ray = make_ray(o, d);
    float nearest = FLOAT_MAX, hits = 0.0;
    for (uint k = 0u; k < push.shapes; ++k) {
        float t;
        if (!any_triangle(o, d, ray, load_primitive(k), FLOAT_MAX, t)) continue;
        nearest = min(nearest, t);
        ++hits;
    }
    return vec4(nearest, hits, 0, 0);
}

/// The textbook's slabs: 0 * inf on a face gives NaN.
bool textbook_box(vec3 o, vec3 d, vec3 lower, vec3 upper, float t_max, out float near) {
    const vec3 inverse = 1.0 / d;
    const vec3 a = (lower - o) * inverse, b = (upper - o) * inverse;
    const vec3 entry = min(a, b), exit = max(a, b);
    near = max(max(entry.x, entry.y), max(entry.z, 0.0));
    return near <= min(min(exit.x, exit.y), min(exit.z, t_max));
}

bool textbook_sphere(vec3 o, vec3 d, float r, out float near, out float far) {
    const float a = dot(d, d), b = dot(o, d), c = dot(o, o) - r * r;
    const float discriminant = b * b - a * c;
    if (!(discriminant >= 0.0)) return false;
    near = (-b - sqrt(discriminant)) / a;
    far = (-b + sqrt(discriminant)) / a;
    return true;
}

vec4 one_of(uint i, uint stride) {
    const uint at = i * stride;
    const vec3 o = input_texel(at).xyz, d = input_texel(at + 1u).xyz;
    const vec4 a = input_texel(at + 2u), b = input_texel(at + 3u);
    float near = 0.0, far = 0.0;
    bool hit = false;
    vec2 uv = vec2(0);
    if (wanted() == 1u) { // box a .. b, up to a.w; it is child b.w of a node
        vec2 t;
        const bvec2 hits =
            intersect_node(make_ray(o, d), fetch_scene(at + 4u), fetch_scene(at + 5u), a.w, t);
        near = b.w != 0.0 ? t.y : t.x;
        hit = variant() != 0u ? textbook_box(o, d, a.xyz, b.xyz, a.w, near)
              : b.w != 0.0    ? hits.y
                              : hits.x;
    } else if (wanted() == 2u) { // sphere of radius a.x
        hit = variant() != 0u ? textbook_sphere(o, d, a.x, near, far)
                              : intersect_sphere(o, d, a.x, near, far);
    } else if (wanted() == 3u || wanted() == 4u) { // cut sphere or disk
        QuadricRecord q;
        q.radius = a.x;
        q.inner_radius = a.y;
        q.z_min = a.z;
        q.z_max = a.w;
        q.phi_max = b.x;
        q.flags = floatBitsToUint(b.y);
        hit = wanted() == 3u ? intersect_cut_sphere(o, d, q, FLOAT_MAX, near)
                             : intersect_disk(o, d, q, FLOAT_MAX, near);
    } else if (wanted() == 6u) { // surface of the box a .. b
        hit = intersect_box_surface(make_ray(o, d), a.xyz, b.xyz, a.w, near);
    } else { // patch
        hit = intersect_patch(make_ray(o, d), a.xyz, b.xyz, input_texel(at + 4u).xyz,
                              input_texel(at + 5u).xyz, FLOAT_MAX, near, uv);
        return vec4(near, hit, uv);
    }
    return vec4(near, hit, far, 0);
}

void main() {
    if (is_idle()) return;
    const uint i = local_index();
    if (wanted() == 0u)
        emit(i, mesh(i));
    else
        emit(i, one_of(i, wanted() == 1u || wanted() >= 5u ? 6u : 4u));
}

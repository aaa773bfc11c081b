#version 460
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "wavefront/geometry.glsl"

// A ray against all push.shapes triangles: through their hierarchy, and one after the other.

bool intersect_primitive(Ray ray, uint primitive, float t_max, out float t) {
    const PrimitiveRecord p = load_primitive(primitive);
    return intersect_triangle(ray, p.a, p.b, p.c, p.normal, p.offset, t_max, t);
}

vec4 one_by_one(Ray ray) {
    Hit hit = Hit(INFINITY, NONE, NONE);
    for (uint i = 0u; i < push.shapes; ++i) {
        float t;
        take_hit(intersect_primitive(ray, i, hit.t, t), t, i, NONE, hit);
    }
    return vec4(hit.t, 0, 0, 0);
}

/// A walk that never starts anew at the root.
vec4 forgetful(Ray ray) {
    Hit hit = Hit(INFINITY, NONE, NONE);
    Walk w = start_walk(push.triangle_root);
    w.root = NONE;
    while (!is_over(w)) {
        step_down(ray, hit.t, w);
        const uint i = w.leaf & LEAF_FIRST_MASK;
        float t;
        if (w.leaf != NONE) take_hit(intersect_primitive(ray, i, hit.t, t), t, i, NONE, hit);
        leave_primitive(false, w);
    }
    return vec4(hit.t, 0, 0, 0);
}

void main() {
    if (is_idle()) return;
    const uint i = local_index();
    const vec3 origin = input_texel(push.media + 2u * i).xyz;
    const vec3 direction = input_texel(push.media + 2u * i + 1u).xyz;
    const Ray ray = make_ray(origin, direction);
    if (wanted() == 0u)
        emit(i, vec4(trace(origin, direction, INFINITY, false, NO_SKIP).t, 0, 0, 0));
    else
        emit(i, wanted() == 1u ? one_by_one(ray) : forgetful(ray));
}

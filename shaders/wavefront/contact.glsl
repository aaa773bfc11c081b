// Boundaries that touch other surfaces. Rounding alone says which of them a ray meets first; once
// past that one, it would miss the other.
#ifndef TYNDALL_CONTACT_GLSL
#define TYNDALL_CONTACT_GLSL

#include "wavefront/interact.glsl"

/// Of two boundaries in one place, whether the ray crosses `a` before `b`: as the media say, which
/// are a chain, or else what it leaves before what it enters.
bool is_crossed_first(SurfacePoint a, SurfacePoint b, vec3 direction, uint medium) {
    const ShapeRecord shape_a = load_shape(a.shape), shape_b = load_shape(b.shape);
    const uint before_a = medium_beyond(shape_a, a, -direction, medium);
    const uint before_b = medium_beyond(shape_b, b, -direction, medium);
    const uint behind_a = medium_beyond(shape_a, a, direction, medium);
    const uint behind_b = medium_beyond(shape_b, b, direction, medium);
    if (before_a == medium && behind_a == before_b) return true;
    if (before_b == medium && behind_b == before_a) return false;
    return dot(direction, b.normal) < 0.0;
}

bool is_boundary(uint shape) {
    return (load_shape(shape).flags & SHAPE_INTERFACE) != 0u;
}

/// What the ray meets: the nearest hit within (0, t_max), or with `any` some hit. Where that is a
/// boundary that touches other surfaces, the one that decides: any that is more than a boundary,
/// which lies in the medium that the ray is in; else the boundary that is crossed last. The rest
/// are passed along with it.
Hit meet(vec3 origin, vec3 direction, float t_max, bool any, Skip skip, uint medium) {
    if (has_contacts == 0u) return trace(origin, direction, t_max, any, skip);
    Hit hit;
    SurfacePoint s;
    float start = 0.0;
    // A loop, though it is only two looks: drivers inline what it calls, which is large.
    for (uint look = 0u; look < 2u; ++look) {
        const vec3 from = origin + start * direction;
        Hit found = trace(from, direction, t_max - start, any && look == 0u, skip);
        if (look == 0u) hit = found;
        if (found.primitive == NONE) return hit;
        const SurfacePoint r = surface_point(from, direction, found);
        if (look == 0u) {
            if (!is_boundary(r.shape)) return hit;
            s = r;
            const float reach = CONTACT_ERRORS * s.error / max(abs(dot(direction, s.normal)), 0.01);
            start = max(hit.t - reach, 0.0);
            t_max = hit.t + reach;
            skip = Skip(hit.primitive, hit.instance, -1.0);
        } else if (!is_boundary(r.shape) || is_crossed_first(s, r, direction, medium)) {
            found.t += start;
            hit = found;
        }
    }
    return hit;
}

#endif

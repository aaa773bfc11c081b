// What reaches a path from a light, through any number of interfaces.
#ifndef TYNDALL_SHADOW_GLSL
#define TYNDALL_SHADOW_GLSL

#include "wavefront/contact.glsl"
#include "wavefront/march.glsl"

struct ShadowRay {
    vec3 origin;
    vec3 direction;
    float distance; ///< To the light, whose
    uint target;    ///< primitive it is (LightSample).
    uint medium;
    bool arrives;
};

/// A part of a ray in one medium, which no surface interrupts.
struct Part {
    vec3 origin;
    float t;
    uint medium;
};

bool is_tracked(uint medium) {
    return (densities & DENSITY_BITS_TRACKED) != 0u && medium != VACUUM &&
           is_tracked(load_medium(medium));
}

/// Takes the ray to the light, or past the next interface. False if a surface is in the way.
bool advance(inout ShadowRay ray, out Part part) {
    // It does not hit the point that it goes to.
    const Skip skip = Skip(ray.target, NONE, 0.999 * ray.distance);
    const bool any = has_interfaces == 0u;
    const Hit hit = meet(ray.origin, ray.direction, ray.distance, any, skip, ray.medium);
    // In touch with a boundary, it does.
    ray.arrives = hit.primitive == NONE ||
                  (has_contacts != 0u && is_skipped(skip, hit.primitive, hit.instance, hit.t));
    part = Part(ray.origin, ray.arrives ? ray.distance : hit.t, ray.medium);
    // A voxel shines only where its medium is.
    if (ray.arrives)
        return (lights & LIGHTS_VOXELS) == 0u || ray.target >> 30 != 1u ||
               ray.medium == (ray.target & 0xFFFFu);
    const ShapeRecord shape = load_shape(shape_of(hit.primitive));
    if (has_interfaces == 0u || (shape.flags & SHAPE_INTERFACE) == 0u) return false;
    const SurfacePoint s = surface_point(ray.origin, ray.direction, hit);
    ray.medium = medium_beyond(shape, s, ray.direction, ray.medium);
    const vec3 beyond = leave_surface(s, ray.direction);
    // Not hit.t: what is close behind the light would be in the way.
    ray.distance -= dot(beyond - ray.origin, ray.direction);
    ray.origin = beyond;
    return true;
}

/// Transmittance of a part in a medium that is tracked.
vec3 tracked_transmittance(Part part, vec3 direction, Path p, inout uint step,
                           inout float worst_ratio) {
    const Medium medium = load_medium(part.medium);
    if (marches_shadows != 0u) return march_transmittance(medium, part.origin, direction, part.t);
    return track_transmittance(medium, part.origin, direction, part.t, p, step, worst_ratio);
}

/// Transmittance to the light, through any number of interfaces; 0 behind a surface.
///
/// What is tracked waits until the ray arrives, or comes to the next such part: a CPU driver goes
/// round a loop for all lanes while one wants it, and they come to their medium after different
/// numbers of interfaces.
vec3 visibility(ShadowRay ray, Path p, inout float worst_ratio) {
    vec3 result = vec3(1);
    uint step = 0u, crossings = 0u;
    do {
        Part tracked = Part(ray.origin, 0.0, VACUUM), part;
        bool waits;
        do {
            const bool is_free = advance(ray, part);
            const bool is_pending = is_tracked(part.medium);
            if (is_pending) tracked = part;
            if (!is_free)
                result = vec3(0);
            else if (has_media != 0u && part.medium != VACUUM && !is_pending) {
                const Medium medium = load_medium(part.medium);
                result *= transmittance(medium,
                                        column_length(medium, part.origin, ray.direction, part.t));
            }
            waits = tracked.medium != VACUUM && is_tracked(ray.medium);
            ++crossings;
        } while (!waits && !ray.arrives && !is_black(result) && crossings < SHADOW_CROSSINGS_MAX);
        if (tracked.medium != VACUUM && !is_black(result))
            result *= tracked_transmittance(tracked, ray.direction, p, step, worst_ratio);
    } while (!ray.arrives && !is_black(result) && crossings < SHADOW_CROSSINGS_MAX);
    const bool is_lost = !ray.arrives && !is_black(result);
    note_mishap(HEALTH_EVENT_LIMIT, is_lost);
    return is_lost ? vec3(0) : result;
}

#endif

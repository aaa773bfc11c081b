#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/contact.glsl"
#include "wavefront/march.glsl"

// Traces shadow rays: what reaches a path from the light it chose.   SHADOW queue -> radiance

/// Transmittance along a part of the ray that no surface interrupts.
vec3 medium_transmittance(uint index, vec3 origin, vec3 direction, float t, Path p, inout uint step,
                          inout float worst_ratio) {
    const Medium medium = load_medium(index);
    if (marches_shadows != 0u) {
        if (is_tracked(medium)) return march_transmittance(medium, origin, direction, t);
    }
    if (is_tracked(medium))
        return track_transmittance(medium, origin, direction, t, p, step, worst_ratio);
    return transmittance(medium, column_length(medium, origin, direction, t));
}

/// Transmittance to the light, through any number of interfaces; 0 behind a surface.
vec3 visibility(vec3 origin, vec3 direction, float distance, uint medium, uint target, Path p,
                inout float worst_ratio) {
    vec3 result = vec3(1);
    uint step = 0u;
    for (uint crossings = 0u; crossings < SHADOW_CROSSINGS_MAX; ++crossings) {
        const bool any = has_interfaces == 0u;
        // It does not hit the point that it goes to.
        const Skip skip = Skip(target, NONE, 0.999 * distance);
        const Hit hit = meet(origin, direction, distance, any, skip, medium);
        // In touch with a boundary, it does.
        const bool is_free =
            hit.primitive == NONE ||
            (has_contacts != 0u && is_skipped(skip, hit.primitive, hit.instance, hit.t));
        const ShapeRecord shape = load_shape(is_free ? 0u : shape_of(hit.primitive));
        if (!is_free && (has_interfaces == 0u || (shape.flags & SHAPE_INTERFACE) == 0u))
            return vec3(0);
        if (has_media != 0u && medium != VACUUM)
            result *= medium_transmittance(medium, origin, direction, is_free ? distance : hit.t, p,
                                           step, worst_ratio);
        // A voxel shines only where its medium is.
        if (is_free && (lights & LIGHTS_VOXELS) != 0u && target >> 30 == 1u &&
            medium != (target & 0xFFFFu))
            return vec3(0);
        if (is_free || is_black(result)) return result;
        const SurfacePoint s = surface_point(origin, direction, hit);
        medium = medium_beyond(shape, s, direction, medium);
        const vec3 beyond = leave_surface(s, direction);
        distance -= dot(beyond - origin, direction); // not hit.t: what is close behind the light
        origin = beyond;                             // would be in the way
    }
    note_mishap(HEALTH_EVENT_LIMIT, true);
    return vec3(0);
}

void main() {
    const uint slot = dequeue(QUEUE_SHADOW);
    if (slot == NONE) return;
    const uvec4 a = load_path(PATH_SHADOW, slot);
    const uvec4 b = load_path(PATH_SHADOW + 1u, slot);
    const uvec4 c = load_path(PATH_SHADOW + 2u, slot);
    Path p;
    load_radiance(slot, p);
    if (densities != 0u || has_interfaces != 0u || log_capacity != 0u) {
        load_ray(slot, p);
        load_sample(slot, p);
        --p.event;    // the one that cast the shadow ray
        mishaps = 0u; // those of the path are its own
    }
    float worst_ratio = 0.0;
    const vec3 seen =
        visibility(floats(a), floats(b), uintBitsToFloat(b.w), a.w, c.w, p, worst_ratio);
    const vec3 added = colour(floats(c)) * seen;
    contribute(p, added);
    store_radiance(slot, p);
    log_light(p, floats(a), floats(b), a.w, added);
    if (densities != 0u) report_majorant_ratio(worst_ratio);
    if (densities != 0u || has_interfaces != 0u) report_mishaps(p.xy, p.path_sample, floats(c));
}

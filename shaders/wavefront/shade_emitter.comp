#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/surface.glsl"

// Adds what paths see of the surface that their segment leads to, if that emits. Few do, and all
// lanes of a CPU driver would pay for them in trace_segment.
//
//   EMITTER queue -> radiance

/// Emission of the surface that the segment leads to, times the chance of getting there: a path
/// that collides on the way has seen it as well. Where transmittance has no closed form, the paths
/// that get there count instead (arrive).
vec3 expected_emission(Path p, Hit hit, float distance_before) {
    const SurfacePoint s = surface_point(p.origin, p.direction, hit);
    vec3 seen = emitted(p, s, load_shape(s.shape), distance_before + hit.t);
    if (has_media != 0u && p.medium != VACUUM) {
        const Medium medium = load_medium(p.medium);
        if (is_tracked(medium)) return vec3(0);
        seen *= transmittance(medium, column_length(medium, p.origin, p.direction, hit.t));
    }
    return p.throughput * seen;
}

void main() {
    const uint slot = dequeue(QUEUE_EMITTER);
    if (slot == NONE) return;
    Path p;
    load_ray(slot, p);
    load_throughput(slot, p);
    load_radiance(slot, p);
    const uvec4 texel = load_path(PATH_HIT, slot);
    const float t = uintBitsToFloat(load_path(PATH_TICKET, slot).w);
    contribute(p, expected_emission(p, Hit(t, texel.y, texel.z), distance_travelled(slot, 0.0)));
    store_radiance(slot, p);
}

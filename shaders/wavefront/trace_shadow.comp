#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/shadow.glsl"

// Traces shadow rays: what reaches a path from the light it chose.   SHADOW queue -> radiance

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
    const ShadowRay ray = ShadowRay(floats(a), floats(b), uintBitsToFloat(b.w), c.w, a.w, false);
    const vec3 seen = visibility(ray, p, worst_ratio);
    const vec3 added = colour(floats(c)) * seen;
    contribute(p, added);
    store_radiance(slot, p);
    log_light(p, floats(a), floats(b), a.w, added);
    if (densities != 0u) report_majorant_ratio(worst_ratio);
    if (densities != 0u || has_interfaces != 0u)
        report_mishaps(p.xy, p.path_sample, colour(floats(c)));
}

#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/shadow.glsl"

// Looks for light on segments that paths pass without a collision (passing.glsl). It traces its
// shadow rays itself: those of trace_shadow start where segments end.
//
//   PASSING queue -> radiance

void main() {
    const uint slot = dequeue(QUEUE_PASSING);
    if (slot == NONE) return;
    Path p;
    load_ray(slot, p);
    load_throughput(slot, p);
    load_radiance(slot, p);
    load_sample(slot, p);
    mishaps = 0u; // those of the path are its own
    const LightSample light =
        light_in_passing(p, load_medium(p.medium), uintBitsToFloat(load_path(PATH_HIT, slot).x));
    if (is_black(light.radiance)) return;
    const ShadowRay ray =
        ShadowRay(p.origin, light.direction, light.distance, light.target, p.medium, false);
    float worst_ratio = 0.0;
    p.event |= EVENT_PASSING; // for the way of the ray, and the log
    const vec3 added = light.radiance * visibility(ray, p, worst_ratio);
    contribute(p, added);
    store_radiance(slot, p);
    log_light(p, p.origin, light.direction, p.medium, added);
    if (densities != 0u) report_majorant_ratio(worst_ratio);
    report_mishaps(p.xy, p.path_sample, light.radiance);
}

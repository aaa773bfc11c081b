#version 460
#extension GL_GOOGLE_include_directive : require
#include "fused_slots.glsl"
#include "fused_stages/cross_interface.glsl"
#include "fused_stages/next_sample.glsl"
#include "fused_stages/shade_emitter.glsl"
#include "fused_stages/shade_surface.glsl"
#include "fused_stages/shade_volume.glsl"
#include "fused_stages/trace_segment.glsl"
#include "fused_stages/trace_shadow.glsl"
#include "fused_stages/track_medium.glsl"

// The bar for the wavefront in scenes with a hierarchy, surfaces that are diffuse, and lights: its
// own stages in one kernel, which keeps paths in registers. A turn of the loop does what a round of
// the wavefront does, and the image is the same to the last bit.
//
//   ray -> ray, batches

void main() {
    const uint slot = gl_GlobalInvocationID.x;
    if (slot >= push.slot_count) return;
    load_slot(slot);
    for (uint turn = 0u; turn < push.run_length; ++turn) {
        steps_walked = 0u;
        trace_segment();
        if (has_emitters != 0u) shade_emitter();
        if ((densities & DENSITY_BITS_TRACKED) != 0u) track_medium();
        if (has_scattering != 0u) shade_volume();
        shade_surface();
        if (has_interfaces != 0u) cross_interface();
        trace_shadow();
        next_sample();
    }
    store_slot(slot);
}

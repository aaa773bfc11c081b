#version 460
#extension GL_GOOGLE_include_directive : require
// First, in place of slots.glsl:
#include "wavefront/fused_slots.glsl"

#include "fused_stages/cross_interface.glsl"
#include "fused_stages/next_sample.glsl"
#include "fused_stages/shade_conductor.glsl"
#include "fused_stages/shade_dielectric.glsl"
#include "fused_stages/shade_emitter.glsl"
#include "fused_stages/shade_rough_conductor.glsl"
#include "fused_stages/shade_rough_dielectric.glsl"
#include "fused_stages/shade_segment.glsl"
#include "fused_stages/shade_surface.glsl"
#include "fused_stages/shade_volume.glsl"
#include "fused_stages/trace_segment.glsl"
#include "fused_stages/trace_shadow.glsl"
#include "fused_stages/track_medium.glsl"

// The stages of scenes with a hierarchy in one kernel, which keeps paths in registers
// (Tuning::stages). A turn of the loop does what a round of them does, and the image is the same to
// the last bit. Faster where paths are alike, slower where they wait for each other.
//
//   ray -> ray, pieces

bool is_met(uint queue) {
    return (surface_queues >> queue & 1u) != 0u;
}

/// Steps through cells before those of this stage: each has its own count. Together they end a run,
/// for a driver may break off long loops (volume.glsl).
uint steps_before = 0u;
void begin_walks() {
    steps_before += steps_walked;
    steps_walked = 0u;
}

void main() {
    const uint slot = gl_GlobalInvocationID.x;
    if (slot >= push.slot_count) return;
    load_slot(slot);
    for (uint turn = 0u; turn < push.run_length && steps_before < STEPS_MAX; ++turn) {
        trace_segment();
        if (has_emitters != 0u) shade_emitter();
        begin_walks();
        if (has_equiangular != 0u) shade_segment();
        begin_walks();
        if ((densities & DENSITY_BITS_TRACKED) != 0u) track_medium();
        if (has_collisions) shade_volume();
        if (is_met(QUEUE_SURFACE)) shade_surface();
        if (is_met(QUEUE_DIELECTRIC)) shade_dielectric();
        if (is_met(QUEUE_ROUGH_DIELECTRIC)) shade_rough_dielectric();
        if (is_met(QUEUE_CONDUCTOR)) shade_conductor();
        if (is_met(QUEUE_ROUGH_CONDUCTOR)) shade_rough_conductor();
        if (is_met(QUEUE_INTERFACE)) cross_interface();
        begin_walks();
        if (lights != 0u) trace_shadow();
        next_sample();
    }
    store_slot(slot);
}

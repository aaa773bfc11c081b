// What goes wrong with paths is noted as bits in the state of the path, and counted when the path
// ends: once a path, and with no atomics where nothing happened. See shared/health.h for the kinds.
#ifndef TYNDALL_HEALTH_GLSL
#define TYNDALL_HEALTH_GLSL

#include "wavefront/buffers.glsl"

uint mishaps = 0u; ///< Bits by kind, of the path that this invocation works on.

void note_mishap(int kind, bool happens) {
    mishaps |= happens ? 1u << kind : 0u;
}

/// A direction with which a path can go on: unit length, up to far more than rounding. False for
/// NaN.
bool is_unit(vec3 direction) {
    return abs(dot(direction, direction) - 1.0) < LENGTH_ERROR_MAX;
}

/// Sum of what lost paths carried, in units of 2^-16. A path cannot count for more than 2^15.
void add_lost_throughput(vec3 throughput) {
    const float carried = clamp((throughput.x + throughput.y + throughput.z) / 3.0, 0.0, 32768.0);
    const uint amount = uint(carried * 65536.0);
    const uint before = atomicAdd(control.lost_throughput_low, amount);
    if (before + amount < before) atomicAdd(control.lost_throughput_high, 1u);
}

/// Counts what was noted of a path (or a shadow ray), which carried `throughput` when it ended.
void report_mishaps(uvec2 xy, uint path_sample, vec3 throughput) {
    while (mishaps != 0u) {
        const int kind = findLSB(mishaps);
        mishaps &= mishaps - 1u;
        if (atomicAdd(control.health[kind], 1u) == 0u) {
            control.health_pixel[kind] = xy.x | xy.y << 16;
            control.health_sample[kind] = path_sample;
        }
        if (kind == HEALTH_EVENT_LIMIT) add_lost_throughput(throughput);
    }
}

/// Notes the largest of the ratios of extinction to majorant that an invocation came upon.
void report_majorant_ratio(float ratio) {
    note_mishap(HEALTH_MAJORANT, ratio > MAJORANT_RATIO_MAX);
    if (ratio > MAJORANT_RATIO_MAX) atomicMax(control.worst_majorant_ratio, floatBitsToUint(ratio));
}

#endif

#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/interact.glsl"

// Flies paths through media on voxels and spherical atmospheres: delta tracking against local
// majorants. Absorption is a weight at null collisions, emission is collected at every tentative
// one.
//
//   TRACK queue -> VOLUME | SURFACE | INTERFACE | ENDED queue, or tracking goes on in the next
//   round

/// Weight of a tentative collision that was taken for real or null, over the density of that
/// choice, and the spectral ratios after it (lib/medium.glsl).
void weigh_collision(inout Path p, vec3 absorbed, vec3 scattered, bool is_real) {
    // Where the majorant is tight, rounding must not make a weight negative.
    const vec3 f = is_real ? scattered : max(1.0 - scattered - absorbed, 0.0);
    const vec3 density = is_real ? scattered : max(1.0 - scattered, 0.0);
    const float m = is_chromatic != 0u ? mean(p.r * density) : density.x;
    p.throughput *= f / m;
    if (is_chromatic != 0u) p.r *= density / m;
}

/// MIS weight of emission that a path comes upon `distance` after its last vertex.
float emission_weight(Path p, Field f, vec3 emission, vec3 extinction, float distance) {
    if ((lights & LIGHTS_VOXELS) == 0u || p.pdf == 0.0 || is_black(emission)) return 1.0;
    return power_heuristic(
        p.pdf, voxel_light_pdf(f.grid.light_density, emission, extinction, distance * distance));
}

void main() {
    const uint slot = dequeue(QUEUE_TRACK);
    if (slot == NONE) return;
    Path p;
    load_ray(slot, p);
    load_throughput(slot, p);
    load_radiance(slot, p);
    load_sample(slot, p);
    const uvec4 hit = load_path(PATH_HIT, slot);
    const Medium medium = load_medium(p.medium);
    float t;
    const Field f = begin_field(medium, p.origin, p.direction, uintBitsToFloat(hit.x), t);
    if (p.status == STATUS_TRACKING) t = uintBitsToFloat(load_path(PATH_TRACK, slot).x);

    bool goes_on = t < f.t_end, is_real = false;
    uint steps = 0u;
    float worst_ratio = 0.0;
    do {
        const uvec4 words = draw(p, BLOCK_PATH);
        float bound;
        goes_on = goes_on && next_collision(f, exponential_variate(words.x), t, bound);
        if (goes_on) {
            const Tap tap = tap_field(medium, f, t, unit_float(words.y));
            const vec3 absorbed = tap.sigma_a / bound, scattered = tap.sigma_s / bound;
            if (has_emission != 0u) {
                const vec3 emission = absorbed * tap.emission;
                p.radiance += p.throughput * emission *
                              emission_weight(p, f, emission, absorbed + scattered,
                                              uintBitsToFloat(hit.w) + t);
            }
            is_real = unit_float(words.z) < scattered[is_chromatic != 0u ? p.hero : 0u];
            weigh_collision(p, absorbed, scattered, is_real);
            if (!is_real) log_path(EVENT_NULL_COLLISION, p, p.origin + t * p.direction, NONE);
            const vec3 extinction = absorbed + scattered;
            worst_ratio = max(worst_ratio, max(extinction.x, max(extinction.y, extinction.z)));
            ++p.event;
            goes_on = !is_real && t < f.t_end && !is_black(p.throughput) && p.event < event_limit;
        }
    } while (goes_on && ++steps < push.run_length);

    p.status = goes_on ? STATUS_TRACKING : is_black(p.throughput) ? STATUS_ENDED : STATUS_RAY;
    if (goes_on) store_path(PATH_TRACK, slot, uvec4(floatBitsToUint(t), 0u, 0u, 0u));
    if (is_real) store_path(PATH_HIT, slot, uvec4(floatBitsToUint(t), COLLISION, NONE, hit.w));
    if (p.status == STATUS_ENDED) log_path(EVENT_ABSORBED, p);
    report_majorant_ratio(worst_ratio);
    store_origin(slot, p);
    store_direction(slot, p);
    store_throughput(slot, p);
    if (has_emission != 0u) store_radiance(slot, p);
    if (!goes_on)
        enqueue(p.status == STATUS_ENDED || p.event >= event_limit ? QUEUE_ENDED
                : is_real                                          ? QUEUE_VOLUME
                                                                   : queue_of_surface(hit.y),
                slot);
}

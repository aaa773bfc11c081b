#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/interact.glsl"

// Flies paths through media on voxels and spherical atmospheres: delta tracking against local
// majorants. Absorption is a weight at null collisions, emission is collected at every tentative
// one; or both are what ends a path (is_analog).
//
//   TRACK queue -> VOLUME | SURFACE | INTERFACE | ENDED queue, or tracking goes on in the next
//   round

/// Takes a null collision for what it is: the weight over the density of that choice, and the
/// spectral ratios after it (lib/medium.glsl). Both as differences from 1: where the majorant is
/// 1e6 times the extinction, 1 - 1e-6 in floats is off by 1 % of what is absorbed, each time.
void pass_null_collision(inout Path p, vec3 absorbed, vec3 scattered) {
    const vec3 extinction = absorbed + scattered;
    const vec3 taken = is_analog != 0u ? extinction : scattered; // probability of anything else
    // 1 - mean(r) is the rounding that r has gathered, which the sum must not pass on.
    const float m_taken = is_chromatic != 0u ? (1.0 - mean(p.r)) + mean(p.r * taken) : taken.x;
    const float m = 1.0 - m_taken;
    // Where the majorant is tight, rounding must not make a weight negative.
    p.throughput += p.throughput * max((m_taken - extinction) / m, -1.0);
    if (is_chromatic != 0u) p.r += p.r * max((m_taken - taken) / m, -1.0);
}

/// Takes a tentative collision for a real one, of coefficient f over the majorant.
void take_collision(inout Path p, vec3 f) {
    const float m = is_chromatic != 0u ? mean(p.r * f) : f.x;
    p.throughput *= f / m;
    if (is_chromatic != 0u) p.r *= f / m;
}

/// What a tentative collision is, by a uniform number.
uint choose_end(Path p, vec3 absorbed, vec3 scattered, float u) {
    const uint channel = is_chromatic != 0u ? p.hero : 0u;
    if (u < scattered[channel]) return END_SCATTERED;
    return is_analog != 0u && u < scattered[channel] + absorbed[channel] ? END_ABSORBED
                                                                         : END_PASSED;
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
    float tau = 0.0; // what is left of a flight, if any
    if (p.status == STATUS_TRACKING) {
        const vec2 track = uintBitsToFloat(load_path(PATH_TRACK, slot).xy);
        t = track.x;
        tau = track.y;
    }

    const uint run_length = push.run_length;
    bool goes_on = t < f.t_end;
    uint end = END_PASSED;
    uint steps = 0u;
    float worst_ratio = 0.0;
    do {
        const uvec4 words = draw(p, BLOCK_PATH);
        float bound;
        if (tau == 0.0) tau = exponential_variate(words.x);
        const bool collides = goes_on && next_collision(f, tau, t, bound);
        goes_on = goes_on && t < f.t_end;
        if (collides) {
            tau = 0.0;
            const Tap tap = tap_field(medium, f, t, unit_float(words.y));
            const vec3 absorbed = tap.sigma_a / bound, scattered = tap.sigma_s / bound;
            const vec3 extinction = absorbed + scattered;
            vec3 seen = vec3(0); // emission of an absorption, weighed
            if (has_emission != 0u) {
                const vec3 emission = absorbed * tap.emission;
                const float mis =
                    emission_weight(p, f, emission, extinction, uintBitsToFloat(hit.w) + t);
                if (is_analog == 0u) contribute(p, p.throughput * emission * mis);
                seen = tap.emission * mis;
            }
            end = choose_end(p, absorbed, scattered, unit_float(words.z));
            if (end == END_PASSED)
                pass_null_collision(p, absorbed, scattered);
            else
                take_collision(p, end == END_SCATTERED ? scattered : absorbed);
            if (has_emission != 0u && end == END_ABSORBED) contribute(p, p.throughput * seen);
            if (end == END_PASSED)
                log_path(EVENT_NULL_COLLISION, p, p.origin + t * p.direction, NONE);
            worst_ratio = max(worst_ratio, max(extinction.x, max(extinction.y, extinction.z)));
            ++p.event;
            goes_on = end == END_PASSED && t < f.t_end && !is_black(p.throughput) &&
                      p.event < event_limit;
        }
    } while (goes_on && ++steps < run_length && steps_walked < STEPS_MAX);

    const bool is_real = end == END_SCATTERED;
    p.status = goes_on                                         ? STATUS_TRACKING
               : end == END_ABSORBED || is_black(p.throughput) ? STATUS_ENDED
                                                               : STATUS_RAY;
    if (goes_on) {
        store_path_word(PATH_TRACK, 0u, slot, floatBitsToUint(t));
        store_path_word(PATH_TRACK, 1u, slot, floatBitsToUint(tau));
    } else if (is_real) {
        store_path_word(PATH_HIT, 0u, slot, floatBitsToUint(t));
    }
    if (p.status == STATUS_ENDED) log_path(EVENT_ABSORBED, p);
    report_majorant_ratio(worst_ratio);
    store_progress(slot, p);
    store_throughput(slot, p);
    if (has_emission != 0u) store_radiance(slot, p);
    if (!goes_on)
        enqueue(p.status == STATUS_ENDED || p.event >= event_limit ? QUEUE_ENDED
                : is_real                                          ? QUEUE_VOLUME
                                                                   : queue_of_surface(hit.y),
                slot);
}

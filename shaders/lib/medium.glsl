// Light along one segment of a path through a homogeneous medium. Pure functions.
//
// Flights are sampled with the scattering coefficient alone; absorption is the closed-form weight
// exp(-sigma_a s) of the segment. So a purely absorbing medium has no noise at all, and with albedo
// 0.8 variance times work is about half of that of flights by extinction. Those are there to
// compare (is_analog): a flight then ends in a collision that scatters or absorbs by a random
// choice, and what is absorbed has met the emission of the medium.
//
// Where sigma_s differs between channels, one of them (the hero) samples the flight, and weights
// follow the balance heuristic over the three ways in which the path could have been made
// (one-sample spectral MIS: Wilkie et al. 2014). r holds the probability densities of the path so
// far under each channel, divided by their mean: no weight exceeds 3 times what one channel alone
// would have.
#ifndef TYNDALL_MEDIUM_GLSL
#define TYNDALL_MEDIUM_GLSL

#include "lib/sampling.glsl"
#include "shared/features.h"

struct Medium {
    vec3 sigma_a;
    vec3 sigma_s;
    vec3 emission;
    float phase_parameter;
    uint phase;
    uint density_kind;
    uint density_record;
};

bool is_black(vec3 c) {
    return max(c.x, max(c.y, c.z)) <= 0.0;
}

float mean(vec3 v) {
    return (v.x + v.y + v.z) * (1.0 / 3.0);
}

/// sigma * s, where 0 times infinity is 0.
vec3 optical_depth(vec3 sigma, float s) {
    return mix(sigma * s, vec3(0), equal(sigma, vec3(0)));
}

/// exp(-sigma s), and exactly 1 where sigma is 0: a driver's exp(0) need not be, and a path through
/// a medium that does not absorb may have a hundred thousand segments.
vec3 attenuation(vec3 sigma, float s) {
    return mix(exp(-sigma * s), vec3(1), equal(sigma, vec3(0)));
}

vec3 transmittance(Medium medium, float s) {
    return attenuation(medium.sigma_a + medium.sigma_s, s);
}

/// Flights can end within a medium.
const bool has_collisions = has_scattering != 0u || is_analog != 0u;

/// The coefficient that flights are sampled with.
vec3 collision_coefficient(Medium medium) {
    return is_analog != 0u ? medium.sigma_a + medium.sigma_s : medium.sigma_s;
}

/// Free flight for the exponential variate tau; infinite where the channel does not collide.
float flight_distance(Medium medium, uint hero, float tau) {
    const vec3 coefficient = collision_coefficient(medium);
    const float sigma = is_chromatic != 0u ? coefficient[hero] : coefficient.x;
    return sigma > 0.0 ? tau / sigma : INFINITY;
}

/// Radiance that the medium adds along [0, s] of a flight: the expectation, given that flight.
vec3 segment_emission(Medium medium, vec3 throughput, vec3 r, float s) {
    if (is_chromatic == 0u)
        return throughput * medium.emission * one_minus_exp(optical_depth(medium.sigma_a, s));
    // Weight at x, if the flight got there: exp(-(sigma_a + sigma_s) x) / mean(r exp(-sigma_s x)).
    // Relative to the least sigma_s it falls at least as exp(-lambda x); x = end v^2 puts the 16
    // Gauss-Legendre nodes where it is steep, and past exp(-20) there is nothing left.
    const float nodes[8] = float[](0.0950125098, 0.2816035508, 0.4580167777, 0.6178762444,
                                   0.7554044084, 0.8656312024, 0.9445750231, 0.9894009350);
    const float weights[8] = float[](0.1894506105, 0.1826034150, 0.1691565194, 0.1495959888,
                                     0.1246289713, 0.0951585117, 0.0622535239, 0.0271524594);
    const float least = min(min(medium.sigma_s.x, medium.sigma_s.y), medium.sigma_s.z);
    const vec3 excess = medium.sigma_s - least;
    vec3 sum = vec3(0);
    for (int c = 0; c < 3; ++c) {
        const float lambda = medium.sigma_a[c] + excess[c];
        const float end = min(s, 20.0 / lambda); // lambda = 0: no emission either
        if (!(medium.sigma_a[c] > 0.0)) continue;
        for (int i = 0; i < 16; ++i) {
            const float v = i < 8 ? 0.5 - 0.5 * nodes[i] : 0.5 + 0.5 * nodes[i - 8];
            const float x = end * v * v;
            sum[c] += weights[i & 7] * v * exp(-lambda * x) / mean(r * exp(-excess * x));
        }
        sum[c] *= end * medium.sigma_a[c];
    }
    return throughput * medium.emission * sum;
}

// How a segment ends.
#define END_PASSED 0u    // not in the medium
#define END_SCATTERED 1u // in a collision that scatters
#define END_ABSORBED 2u  // in one that absorbs (is_analog)

/// Carries throughput and r over a segment of length s.
void pass_segment(Medium medium, uint hero, float s, uint end, inout vec3 throughput,
                  inout vec3 r) {
    const vec3 weight = is_analog != 0u ? vec3(1) : attenuation(medium.sigma_a, s);
    if (is_chromatic == 0u) {
        throughput *= weight;
        return;
    }
    // Densities relative to that of the hero, whose exponential is at least e^-23: nothing
    // overflows.
    const vec3 sigma = collision_coefficient(medium);
    vec3 density = attenuation(sigma - sigma[hero], s);
    const vec3 ending = end == END_ABSORBED ? medium.sigma_a : medium.sigma_s;
    if (end != END_PASSED) density *= ending / ending[hero];
    const float m = mean(r * density);
    throughput *= density * weight / m;
    r *= density / m;
}

#endif

// Phase functions: where a medium scatters light. Pure functions.
//
// Angles are between the directions of travel before and after: mu = 1 is forward, g > 0 scatters
// forward. Densities are per steradian and integrate to 1, so value and pdf are the same number.
#ifndef TYNDALL_PHASE_GLSL
#define TYNDALL_PHASE_GLSL

#include "lib/sampling.glsl"
#include "shared/features.h"

/// 1 - mu and 1 + mu of a Henyey-Greenstein deflection. Products of sums of positive numbers, so
/// that nothing cancels and nothing is divided by g: error below 5e-7 for every |g| < 1, and the
/// ends are exact. Source: ORACLES 5.1 (the inversion of Henyey and Greenstein 1941, factored).
vec2 sample_hg_complements(float g, float xi) {
    const float a = abs(g);
    const float x = g < 0.0 ? 1.0 - xi : xi;
    const float d = (1.0 - a) + 2.0 * a * x;
    const float minus = (1.0 - a) / d;
    const float plus = (1.0 + a) / d;
    const float om = 2.0 * (1.0 - x) * minus * minus * (1.0 + a * x);
    const float op = 2.0 * x * plus * plus * ((1.0 - a) + a * x);
    return g < 0.0 ? vec2(op, om) : vec2(om, op);
}

/// Whether light goes straight on (or straight back) as far as float32 can tell: such a function
/// has no density.
bool is_delta(float g) {
    return 1.0 - abs(g) < 1e-6;
}

/// Density of scattering from direction of travel `from` to `to`; 0 for a delta.
float evaluate_phase(float g, vec3 from, vec3 to) {
    if (is_anisotropic == 0u) return 0.25 / PI;
    if (is_delta(g)) return 0.0;
    // 1 + g^2 - 2 g mu, from the complement of mu that is small where the lobe is high. |from -
    // to|^2 / 2 is 1 - mu without its cancellation.
    const float a = abs(g);
    const vec3 difference = g < 0.0 ? from + to : from - to;
    const float denominator = (1.0 - a) * (1.0 - a) + a * dot(difference, difference);
    return 0.25 / PI * (1.0 - a) * (1.0 + a) / (denominator * sqrt(denominator));
}

/// Draws the direction after scattering. Its density is evaluate_phase.
vec3 sample_phase(float g, vec3 from, float xi, float azimuth) {
    if (is_anisotropic == 0u) {
        const float mu = 2.0 * xi - 1.0;
        return deflect(from, mu, 2.0 * sqrt(xi * (1.0 - xi)), azimuth);
    }
    if (is_delta(g)) return g > 0.0 ? from : -from;
    const vec2 complements = sample_hg_complements(g, xi);
    const float mu = complements.x < complements.y ? 1.0 - complements.x : complements.y - 1.0;
    return deflect(from, mu, sqrt(complements.x * complements.y), azimuth);
}

#endif

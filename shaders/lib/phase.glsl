// Phase functions in closed form: where a medium scatters light. Pure functions.
//
// Angles are between the directions of travel before and after: mu = 1 is forward, g > 0 scatters
// forward. Densities are per steradian and integrate to 1, so value and pdf are the same number.
// A deflection is given by its complements 1 - mu and 1 + mu: the one that is small has all its
// digits.
#ifndef TYNDALL_PHASE_GLSL
#define TYNDALL_PHASE_GLSL

#include "lib/sampling.glsl"
#include "shared/features.h"
#include "shared/phase_records.h"

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

/// Likewise of Schlick's function: mu = (s + k) / (1 + k s) with s = 2 xi - 1 (Blasi, Le Saec and
/// Schlick 1993).
vec2 sample_schlick_complements(float k, float xi) {
    const float a = abs(k);
    const float x = k < 0.0 ? 1.0 - xi : xi;
    const float d = (1.0 - a) + 2.0 * a * x;
    const float om = 2.0 * (1.0 - x) * ((1.0 - a) / d);
    const float op = 2.0 * x * ((1.0 + a) / d);
    return k < 0.0 ? vec2(op, om) : vec2(om, op);
}

/// Likewise of Rayleigh's: the CDF gives mu^3 + 3 mu = 8 xi - 4 = 2 z; Cardano's solution is
/// w - 1 / w with w^3 = z + sqrt(z^2 + 1), here without its cancellation. Relative error of mu
/// below 1e-6, also near 0.
vec2 sample_rayleigh_complements(float xi) {
    const float z = 4.0 * xi - 2.0;
    const float cube = abs(z) + sqrt(z * z + 1.0); // in [1, 2 + sqrt(5)]
    const float guess = pow(cube, 1.0 / 3.0); // good to 2^-11 at worst: Newton's step squares that
    const float w = guess - (guess - cube / (guess * guess)) * (1.0 / 3.0);
    const float mu = clamp(2.0 * z / (w * w + 1.0 + 1.0 / (w * w)), -1.0, 1.0);
    return vec2(1.0 - mu, 1.0 + mu);
}

/// Whether light goes straight on (or straight back) as far as float32 can tell: such a function
/// has no density. For g and for k.
bool is_delta(float parameter) {
    return 1.0 - abs(parameter) < 1e-6;
}

/// Densities of scattering from direction of travel `from` to `to`. |from - to|^2 / 2 is 1 - mu
/// without its cancellation, and |from + to|^2 / 2 is 1 + mu: they are formed from the one that is
/// small where the lobe is high.
float evaluate_hg(float g, vec3 from, vec3 to) {
    // 1 + g^2 - 2 g mu
    const float a = abs(g);
    const vec3 difference = g < 0.0 ? from + to : from - to;
    const float denominator = (1.0 - a) * (1.0 - a) + a * dot(difference, difference);
    return 0.25 / PI * (1.0 - a) * (1.0 + a) / (denominator * sqrt(denominator));
}
float evaluate_schlick(float k, vec3 from, vec3 to) {
    // 1 - k mu
    const float a = abs(k);
    const vec3 difference = k < 0.0 ? from + to : from - to;
    const float denominator = (1.0 - a) + 0.5 * a * dot(difference, difference);
    return 0.25 / PI * ((1.0 - a) / denominator) * ((1.0 + a) / denominator);
}
float evaluate_rayleigh(vec3 from, vec3 to) {
    const float mu = dot(from, to);
    return 3.0 / (16.0 * PI) * (1.0 + mu * mu);
}

/// 1 - mu and 1 + mu between unit vectors.
vec2 complements_between(vec3 from, vec3 to) {
    const vec3 difference = from - to, sum = from + to;
    return 0.5 * vec2(dot(difference, difference), dot(sum, sum));
}

/// The direction at these complements to `from`.
vec3 deflect_by(vec3 from, vec2 complements, float azimuth) {
    const float mu = complements.x < complements.y ? 1.0 - complements.x : complements.y - 1.0;
    return deflect(from, mu, sqrt(complements.x * complements.y), azimuth);
}

/// Whether a phase function is of the kind; known when the pipeline is built if the scene has only
/// one.
bool is_phase(uint kind, uint wanted) {
    return phases == 1u << wanted || ((phases >> wanted & 1u) != 0u && kind == wanted);
}

/// Density of a phase function in closed form; 0 for a delta.
float evaluate_closed_phase(uint kind, float parameter, vec3 from, vec3 to) {
    if (is_phase(kind, PHASE_RAYLEIGH)) return evaluate_rayleigh(from, to);
    if (has_delta_phases != 0u && is_delta(parameter)) return 0.0;
    if (is_phase(kind, PHASE_SCHLICK)) return evaluate_schlick(parameter, from, to);
    return evaluate_hg(parameter, from, to);
}

/// Its deflection. Not for a delta.
vec2 sample_closed_phase(uint kind, float parameter, float xi) {
    if (is_phase(kind, PHASE_RAYLEIGH)) return sample_rayleigh_complements(xi);
    if (is_phase(kind, PHASE_SCHLICK)) return sample_schlick_complements(parameter, xi);
    return sample_hg_complements(parameter, xi);
}

/// Whether a function of this kind is a delta.
bool is_delta_phase(uint kind, float parameter) {
    if (has_delta_phases == 0u) return false;
    const bool has_others = (phases & (PHASE_BIT_RAYLEIGH | PHASE_BIT_TABLE)) != 0u;
    const bool has_parameter = (phases & (PHASE_BIT_HENYEY_GREENSTEIN | PHASE_BIT_SCHLICK)) != 0u;
    return has_parameter && (!has_others || kind < PHASE_RAYLEIGH) && is_delta(parameter);
}

#endif

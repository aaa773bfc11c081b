#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/fresnel.glsl"
#include "lib/phase.glsl"
#include "lib/tracking.glsl"
#include "shared/selftest_functions.h"
#include "wavefront/scene.glsl"

// Evaluates functions of shaders/lib where they are hard, for `tyndall selftest`, which compares
// them with double precision. Texel i of the scene holds arguments, texel i of the film gets the
// values; push.shapes is the function, push.slot_count how many there are.

vec4 evaluate(uvec4 words) {
    const vec4 a = uintBitsToFloat(words);
    switch (push.shapes) {
    case FUNCTION_PHILOX:
        return uintBitsToFloat(philox(words, uvec2(0), 10));
    case FUNCTION_EXPONENTIAL:
        return vec4(exponential_variate(uint(a.x) << 16 | uint(a.y)));
    case FUNCTION_SINES:
        return vec4(sin_cos_turns(a.x), 0, 0);
    case FUNCTION_ONE_MINUS_EXP:
        return vec4(one_minus_exp(a.x));
    case FUNCTION_ATTENUATION:
        return vec4(attenuation(vec3(a.x), a.y), 0);
    case FUNCTION_HG_DRAW:
        return vec4(sample_hg_complements(a.x, a.y), 0, 0);
    case FUNCTION_SCHLICK_DRAW:
        return vec4(sample_schlick_complements(a.x, a.y), 0, 0);
    case FUNCTION_RAYLEIGH_DRAW:
        return vec4(sample_rayleigh_complements(a.y), 0, 0);
    case FUNCTION_HG_VALUE:
        return vec4(evaluate_hg(a.w, vec3(0, 0, 1), a.xyz));
    case FUNCTION_SCHLICK_VALUE:
        return vec4(evaluate_schlick(a.w, vec3(0, 0, 1), a.xyz));
    case FUNCTION_FRESNEL:
        return vec4(fresnel_dielectric(make_boundary(a.x, a.z != 0.0), a.y));
    case FUNCTION_HEURISTIC:
        return vec4(power_heuristic(a.x, a.y));
    case FUNCTION_COLUMN:
        return vec4(exponential_column(a.x, a.y, a.z, a.w));
    default:
        return vec4(0);
    }
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < push.slot_count) store_film(i, evaluate(fetch_scene(i)));
}

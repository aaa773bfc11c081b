#version 460
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "lib/microfacet.glsl"

// Fresnel's equations and rough boundaries. Variant 1 is the textbook's form, or wrong on purpose.

float textbook_dielectric(float eta, float c) {
    const float sine2 = (1.0 - c * c) / (eta * eta);
    if (sine2 >= 1.0) return 1.0;
    const float t = sqrt(1.0 - sine2);
    const float s = (c - eta * t) / (c + eta * t), p = (eta * c - t) / (eta * c + t);
    return 0.5 * (s * s + p * p);
}

float textbook_density(vec3 m, float alpha) {
    const float cos2 = m.z * m.z, tan2 = (1.0 - cos2) / cos2;
    const float e = 1.0 + tan2 / (alpha * alpha);
    return 1.0 / (PI * alpha * alpha * cos2 * cos2 * e * e);
}

float textbook_weight(vec3 wo, vec3 wi, float alpha) {
    const float to = (1.0 - wo.z * wo.z) / (wo.z * wo.z), ti = (1.0 - wi.z * wi.z) / (wi.z * wi.z);
    const float lo = 0.5 * (sqrt(1.0 + alpha * alpha * to) - 1.0);
    const float li = 0.5 * (sqrt(1.0 + alpha * alpha * ti) - 1.0);
    return (1.0 + lo) / (1.0 + lo + li);
}

/// Texel 0: wo, alpha. Texel 1: inside over outside; 1 from outside.
Boundary lit_boundary() {
    const vec4 a = input_texel(1u);
    return make_boundary(a.x, a.y != 0.0);
}

void main() {
    if (is_idle()) return;
    const uint i = local_index();
    const vec4 a = input_texel(2u * i), b = input_texel(2u * i + 1u);
    if (wanted() == 0u) { // a: inside over outside, cosine, 1 from outside
        const Boundary boundary = make_boundary(a.x, a.z != 0.0);
        const float f = variant() == 0u ? fresnel_dielectric(boundary, a.y)
                                        : textbook_dielectric(a.z != 0.0 ? a.x : 1.0 / a.x, a.y);
        emit(i, vec4(f, fresnel_pane(boundary, a.y), wave_beyond(boundary, a.y), boundary.eta));
    } else if (wanted() == 1u) { // a: eta, cosine; b: k
        emit(i, vec4(fresnel_conductor(a.xyz, variant() == 0u ? b.xyz : 1.01 * b.xyz, a.w), 0));
    } else if (wanted() == 2u) { // a: wo, alpha; b: m, or wi
        const bool is_naive = variant() != 0u;
        emit(i, vec4(is_naive ? textbook_density(b.xyz, a.w) : ggx_density(b.xyz, a.w),
                     is_naive ? textbook_weight(a.xyz, b.xyz, a.w) : ggx_weight(a.xyz, b.xyz, a.w),
                     ggx_visible(a.xyz, b.xyz, a.w), 0));
    } else if (wanted() == 3u) { // a: direction from where light comes, eta; b: 1 from outside
        const Boundary boundary = make_boundary(a.w, (b.x != 0.0) == (variant() == 0u));
        emit(i, vec4(refract_through(boundary, a.xyz, vec3(0, 0, 1), a.z), 0));
    } else if (wanted() == 4u) { // a visible normal
        const vec4 wo = input_texel(0u);
        const uvec4 words = random_block(push.seed, 0u, global_index(), 0u, 0u);
        const vec3 m =
            sample_visible_normal(wo.xyz, wo.w, unit_float(words.x), unit_float(words.y));
        emit(i, vec4(m, 0));
    } else if (wanted() == 5u) { // a direction, and what it says of itself; two texels
        const vec4 wo = input_texel(0u);
        const uvec4 words = random_block(push.seed, 0u, global_index(), 0u, 0u);
        vec3 wi;
        float pdf, weight;
        const bool goes_on = sample_rough_dielectric(lit_boundary(), wo.w, wo.xyz,
                                                     vec2(unit_float(words.x), unit_float(words.y)),
                                                     unit_float(words.w), wi, pdf, weight);
        emit(2u * i, vec4(wi, goes_on ? 1 : 0));
        float same_pdf, same_weight;
        evaluate_rough_dielectric(lit_boundary(), wo.w, wo.xyz, wi, same_pdf, same_weight);
        emit(2u * i + 1u, vec4(pdf, weight, same_pdf, same_weight));
    } else if (wanted() == 6u) { // texels from 2 on: directions
        const vec4 wo = input_texel(0u);
        float pdf, weight;
        evaluate_rough_dielectric(lit_boundary(), wo.w, wo.xyz, input_texel(2u + i).xyz, pdf,
                                  weight);
        emit(i, vec4(pdf, weight, 0, 0));
    } else { // metal: texel 1: eta, texel 2: k; as 5
        const vec4 wo = input_texel(0u);
        const vec3 eta = input_texel(1u).xyz, k = input_texel(2u).xyz;
        const uvec4 words = random_block(push.seed, 0u, global_index(), 0u, 0u);
        vec3 wi, weight, same_weight;
        float pdf, same_pdf;
        const bool goes_on = sample_rough_conductor(
            eta, k, wo.w, wo.xyz, vec2(unit_float(words.x), unit_float(words.y)), wi, pdf, weight);
        emit(2u * i, vec4(wi, goes_on ? 1 : 0));
        evaluate_rough_conductor(eta, k, wo.w, wo.xyz, wi, same_pdf, same_weight);
        emit(2u * i + 1u, vec4(pdf, weight.x, same_pdf, same_weight.x));
    }
}

#version 460
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "wavefront/phases.glsl"

// Phase functions: push.media is the word of a MediumRecord, number() its parameter, push.shapes
// the hero; their own input starts at texel push.lights. Variant 1 is the textbook's form of Henyey
// and Greenstein's.

float textbook_cosine(float g, float xi) {
    const float s = (1.0 - g * g) / (1.0 - g + 2.0 * g * xi);
    return (1.0 + g * g - s * s) / (2.0 * g);
}

float textbook_phase(float g, vec3 from, vec3 to) {
    const float d = 1.0 + g * g - 2.0 * g * dot(from, to);
    return 0.25 / PI * (1.0 - g * g) / (d * sqrt(d));
}

Medium medium() {
    Medium m;
    m.phase = push.media;
    m.phase_parameter = number();
    return m;
}

/// 1 - cos, 1 + cos, and cos, sin of the direction drawn, seen from +z.
vec4 inversion(float g, float xi) {
    if (variant() != 0u) {
        const float mu = textbook_cosine(g, xi);
        return vec4(1.0 - mu, 1.0 + mu, mu, sqrt(max(0.0, 1.0 - mu * mu)));
    }
    const Medium m = medium();
    const vec3 d = sample_phase(m, push.shapes, vec3(0, 0, 1), xi, 0.0);
    return vec4(sample_single_phase(m.phase, g, push.shapes, xi), d.z, d.x);
}

void main() {
    if (is_idle()) return;
    const uint i = local_index();
    const float g = number();
    if (wanted() == 0u) { // every xi on the grid of 2^-24
        emit(i, inversion(g, float(global_index()) * (1.0 / 16777216.0)));
    } else if (wanted() == 1u) { // value for a pair of directions
        const vec3 from = input_texel(push.lights + 2u * i).xyz;
        const vec3 to = input_texel(push.lights + 2u * i + 1u).xyz;
        emit(i, vec4(variant() != 0u ? vec3(textbook_phase(g, from, to))
                                     : evaluate_phase(medium(), from, to),
                     0));
    } else { // a random direction, from texel 0, with its density
        const uvec4 words = random_block(push.seed, 0u, global_index(), 0u, 0u);
        const vec3 from = input_texel(push.lights).xyz;
        const vec3 to =
            sample_phase(medium(), push.shapes, from, unit_float(words.x), unit_float(words.y));
        emit(i, vec4(to, evaluate_phase(medium(), from, to)[push.shapes]));
    }
}

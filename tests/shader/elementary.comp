#version 460
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "lib/camera.glsl"
#include "lib/light.glsl"

// Elementary functions of one or two numbers, each with a naive form as its control.

/// Frisvad 2012 without the later repair: singular at z = -1.
void naive_frame(vec3 n, out vec3 s, out vec3 t) {
    const float a = 1.0 / (1.0 + n.z);
    const float b = -n.x * n.y * a;
    s = vec3(1.0 - n.x * n.x * a, b, -n.x);
    t = vec3(b, 1.0 - n.y * n.y * a, -n.y);
}

vec4 exponential(uint word) {
    if (variant() == 0u) return vec4(exponential_variate(word));
    return vec4(-log(1.0 - unit_float(word)));
}

vec4 sines(float u) {
    if (variant() == 0u) return vec4(sin_cos_turns(u), 0, 0);
    return vec4(sin(2.0 * PI * u), cos(2.0 * PI * u), 0, 0);
}

void frames(uint i, vec3 n) {
    vec3 s, t;
    if (variant() == 0u)
        make_frame(n, s, t);
    else
        naive_frame(n, s, t);
    emit(2u * i, vec4(s, 0));
    emit(2u * i + 1u, vec4(t, 0));
}

/// The greatest and the last deviation from unit length over number() deflections.
vec4 walk(uint i) {
    vec3 d = normalize(vec3(1, 2, 3));
    float worst = 0.0;
    for (uint step = 0u; step < uint(number()); ++step) {
        const uvec4 words = random_block(push.seed, i, 0u, step, 0u);
        const float mu = 2.0 * unit_float(words.x) - 1.0;
        const float sine = sqrt((1.0 - mu) * (1.0 + mu));
        if (variant() == 0u) {
            d = deflect(d, mu, sine, unit_float(words.y));
        } else { // as accurate as Vulkan asks of sin and cos, and not normalised
            vec3 s, t;
            make_frame(d, s, t);
            const vec2 sc = floor(sin_cos_turns(unit_float(words.y)) * 2048.0) / 2048.0 * sine;
            d = d * mu + s * sc.y + t * sc.x;
        }
        worst = max(worst, abs(dot(d, d) - 1.0));
    }
    return vec4(d, worst);
}

void main() {
    if (is_idle()) return;
    const uint i = local_index();
    const vec4 a = input_texel(i);
    const bool naive = variant() != 0u;
    switch (wanted()) {
    case 0u:
        emit(i, exponential(fetch_scene(i).x));
        break;
    case 1u:
        emit(i, sines(float(global_index()) * (1.0 / 16777216.0)));
        break;
    case 2u:
        emit(i, vec4(naive ? 1.0 - exp(-a.x) : one_minus_exp(a.x)));
        break;
    case 3u:
        frames(i, a.xyz);
        break;
    case 4u:
        emit(i, walk(i));
        break;
    case 5u:
        emit(i, vec4(sample_disk(a.x, a.y), 0, 0));
        break;
    case 6u:
        emit(i, vec4(sample_triangle(a.x, a.y), 0));
        break;
    case 7u:
        emit(i, vec4(naive ? a.x * a.x / (a.x * a.x + a.y * a.y) : power_heuristic(a.x, a.y)));
        break;
    case 8u:
        emit(i, vec4(naive ? 1.0 - sqrt(1.0 - a.x) : cone_complement(a.x)));
        break;
    case 9u:
        emit(i, vec4(spot_falloff(a.x, a.y, a.z)));
        break;
    case 10u:
        emit(i, vec4(sample_triangle_filter(number(), a.x)));
        break;
    }
}

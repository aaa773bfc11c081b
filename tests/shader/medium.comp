#version 460
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

// Segments through one medium, which is record 0 of push.media. Flights are those of words at the
// middle of equal strata, so that a mean over them is a quadrature. Variant 1 samples by the hero
// alone.

struct Segment {
    vec3 throughput, r;
    float s;
    bool collided;
};

/// A segment of at most `end` by the given word.
Segment fly(Medium medium, uint hero, uint word, float end, vec3 throughput, vec3 r) {
    Segment result;
    const float flight = flight_distance(medium, hero, exponential_variate(word));
    result.collided = flight < end;
    result.s = min(flight, end);
    if (variant() != 0u) {
        const float sigma = medium.sigma_s[hero];
        result.throughput = throughput * exp((sigma - medium.sigma_s - medium.sigma_a) * result.s);
        if (result.collided) result.throughput *= medium.sigma_s / sigma;
        result.r = r;
    } else {
        result.throughput = throughput;
        result.r = r;
        pass_segment(medium, hero, result.s, result.collided ? END_SCATTERED : END_PASSED,
                     result.throughput, result.r);
    }
    return result;
}

vec3 emission(Medium medium, vec3 throughput, vec3 r, float s) {
    return has_emission != 0u ? segment_emission(medium, throughput, r, s) : vec3(0);
}

void main() {
    if (is_idle()) return;
    const uint i = local_index();
    const Medium medium = load_medium(0u);
    const uint hero = push.shapes;
    const float end = number();
    if (wanted() == 0u) { // one segment; push.nodes invocations
        const uint word = global_index() * push.nodes + push.nodes / 2u;
        const Segment s = fly(medium, hero, word, end, vec3(1), vec3(1));
        emit(2u * i, vec4(s.throughput, s.collided ? 1 : 0));
        emit(2u * i + 1u, vec4(emission(medium, vec3(1), vec3(1), s.s), s.s));
    } else if (wanted() == 1u) { // two collisions, push.nodes strata along each axis
        const uint n = push.nodes, step = 0xFFFFFFFFu / n + 1u;
        const uint at = global_index();
        const uint first = at / n * step + step / 2u, second = at % n * step + step / 2u;
        const Segment a = fly(medium, hero, first, INFINITY, vec3(1), vec3(1));
        Segment b = fly(medium, hero, second, end, a.throughput, a.r);
        emit(2u * i, vec4(b.throughput, b.collided ? 1 : 0));
        emit(2u * i + 1u, vec4(emission(medium, a.throughput, a.r, b.s), b.s));
    } else { // transmittance over number()
        emit(2u * i, vec4(transmittance(medium, end), 0));
        emit(2u * i + 1u, vec4(flight_distance(medium, hero, 1.0)));
    }
}

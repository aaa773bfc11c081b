// Sampling of points on light sources that have an area. Pure functions.
#ifndef TYNDALL_LIGHT_GLSL
#define TYNDALL_LIGHT_GLSL

#include "lib/sampling.glsl"

/// Barycentric coordinates of a uniform point of a triangle.
vec3 sample_triangle(float u, float v) {
    const float s = sqrt(u);
    const float b1 = v * s;
    return vec3(1.0 - s, b1, s - b1);
}

/// Intensity of a spot light, relative to that along its axis: smoothstep of the cosine between
/// both cones. All in complements 1 - cos, which keep their digits for narrow cones.
float spot_falloff(float complement, float complement_width, float complement_start) {
    const float x =
        clamp((complement_width - complement) / (complement_width - complement_start), 0.0, 1.0);
    return complement >= complement_width   ? 0.0
           : complement <= complement_start ? 1.0
                                            : x * x * (3.0 - 2.0 * x);
}

/// 1 - cos of the half angle of the cone that a sphere subtends from outside, without cancellation
/// when it is small: sin^2 = (radius / distance)^2.
float cone_complement(float sin2) {
    return sin2 / (1.0 + sqrt(max(0.0, 1.0 - sin2)));
}

#endif

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

/// Cuts [t0, t1] of a line to where it is in a cone; empty (t0 >= t1) if nowhere. t = nearest is
/// where the line is nearest to the apex: `offset` away, and `height` along the axis, by which it
/// gains `rise` per unit of length. The half angle is below 90 degrees, 1 over its cosine secant.
void clip_to_cone(float nearest, float offset, float height, float rise, float secant,
                  inout float t0, inout float t1) {
    // (t^2 + offset^2) <= secant^2 (height + t rise)^2, as seen from there: a t^2 + 2 b t + c <= 0
    const float sec2 = secant * secant;
    const float a = 1.0 - sec2 * rise * rise, b = -sec2 * height * rise;
    const float root = sqrt(max(0.0, sec2 * (height * height + rise * rise * offset * offset) -
                                         offset * offset)); // b^2 - a c
    if (a > 1e-4) {                                         // across the cone, or its mirror image
        t0 = max(t0, nearest - (b + root) / a);
        t1 = height > 0.0 ? min(t1, nearest - (b - root) / a) : t0;
    } else if (a < -1e-4) { // in at the surface, and never out, or the other way round
        if (rise > 0.0)
            t0 = max(t0, nearest - (b + root) / a);
        else
            t1 = min(t1, nearest - (b - root) / a);
    }
}

/// 1 - cos of the half angle of the cone that a sphere subtends from outside, without cancellation
/// when it is small: sin^2 = (radius / distance)^2.
float cone_complement(float sin2) {
    return sin2 / (1.0 + sqrt(max(0.0, 1.0 - sin2)));
}

#endif

// Steps along a line that subtend equal angles at a point beside it, so that they are dense where
// light from there is strong: Kulla and Fajardo 2012, "Importance Sampling Techniques for Path
// Tracing in Participating Media". Pure functions.
#ifndef TYNDALL_EQUIANGULAR_GLSL
#define TYNDALL_EQUIANGULAR_GLSL

#include "lib/sampling.glsl"

/// atan(x), to 2e-7. Vulkan asks no more than 4096 ULP of a driver's.
float arctangent(float x) {
    const float a = abs(x);
    const float inner = a > 1.0 ? 1.0 / a : a;
    const float half_angle = inner / (1.0 + sqrt(1.0 + inner * inner)); // tan(atan / 2) < 0.415
    const float s = half_angle * half_angle;
    const float series =
        1.0 + s * (-1.0 / 3.0 +
                   s * (0.2 + s * (-1.0 / 7.0 +
                                   s * (1.0 / 9.0 +
                                        s * (-1.0 / 11.0 + s * (1.0 / 13.0 - s * (1.0 / 15.0)))))));
    const float angle = 2.0 * half_angle * series;
    return sign(x) * (a > 1.0 ? 0.5 * PI - angle : angle);
}

/// The angle of (x, y) from the x axis, for y > 0.
float angle_of(float x, float y) {
    const float acute = arctangent(y / abs(x));
    return x < 0.0 ? PI - acute : acute;
}

/// The part [t0, t1] of a line in steps: of equal length, or of equal angle at a point that is
/// `offset` > 0 away from the line where t = nearest.
struct Steps {
    float t0, t1;
    uint count;
    float nearest;
    float offset; ///< 0: equal length.
    float angle;  ///< Of all steps together.
};

Steps equal_steps(float t0, float t1, uint count) {
    return Steps(t0, t1, count, 0.0, 0.0, 0.0);
}

/// Nearer to the line than 1e-3 of its length, the point is taken to be there: any offset is good
/// for the choice of steps, and this one keeps their ends apart. Seen from far away, nothing would
/// be left of the difference of two arctangents: the angle is formed from its sine and cosine.
Steps equiangular_steps(float t0, float t1, uint count, float nearest, float offset) {
    Steps s = Steps(t0, t1, count, nearest, max(offset, 1e-3 * (t1 - t0)), 0.0);
    const vec2 begin = normalize(vec2(t0 - nearest, s.offset));
    s.angle = angle_of(begin.x * (t1 - nearest) + begin.y * s.offset, begin.y * (t1 - t0));
    return s;
}

/// Steps of equal angle at a place.
Steps steps_about(vec3 place, vec3 origin, vec3 direction, float t0, float t1, uint count) {
    const vec3 to = place - origin;
    const float nearest = dot(to, direction);
    return equiangular_steps(t0, t1, count, nearest, length(to - nearest * direction));
}

/// Where x steps end; x need not be whole.
float step_place(Steps s, float x) {
    const float share = x / float(s.count);
    if (s.offset == 0.0 || x <= 0.0 || x >= float(s.count)) return mix(s.t0, s.t1, share);
    const vec2 begin = vec2(s.t0 - s.nearest, s.offset);
    const float distance = length(begin);
    const vec2 sc = sin_cos_turns(share * s.angle / (2.0 * PI));
    return clamp(s.t0 + distance * sc.x / (dot(vec2(-sc.x, sc.y), begin / distance)), s.t0, s.t1);
}

/// Derivative of step_place there: the length that a sample at t stands for.
float step_weight(Steps s, float t) {
    if (s.offset == 0.0) return (s.t1 - s.t0) / float(s.count);
    const float along = t - s.nearest;
    return s.angle / float(s.count) * (s.offset + along * (along / s.offset));
}

#endif

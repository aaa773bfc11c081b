// Warps of uniform numbers, and the elementary functions they need. Pure functions.
//
// Vulkan promises little of sin, cos and log (absolute errors of 2^-11 and 2^-21), so those that
// decide where a path goes are our own.
#ifndef TYNDALL_SAMPLING_GLSL
#define TYNDALL_SAMPLING_GLSL

const float PI = 3.14159265358979;
#define INFINITY uintBitsToFloat(0x7F800000u)
const float FLOAT_MAX = 3.402823466e38;
const float FLOAT_MIN = 1.17549435e-38; // of those with all their digits
const float EPSILON = 5.9604645e-8;     // 2^-24: half an ulp of 1

/// sin and cos of 2 pi u, for u in [0, 1]. Absolute error below 1.2e-7.
vec2 sin_cos_turns(float u) {
    const float quarter = floor(4.0 * u + 0.5);
    const float x = 2.0 * PI * (u - 0.25 * quarter); // in [-pi/4, pi/4]
    const float x2 = x * x;
    const float s = x + x * x2 * (-1.6666654611e-1 + x2 * (8.3321608736e-3 - x2 * 1.9515295891e-4));
    const float c = 1.0 - 0.5 * x2 +
                    x2 * x2 * (4.1666645683e-2 + x2 * (-1.3887316255e-3 + x2 * 2.4433157118e-5));
    const uint q = uint(quarter) & 3u;
    const vec2 swapped = (q & 1u) != 0u ? vec2(c, s) : vec2(s, c);
    return vec2(q >= 2u ? -swapped.x : swapped.x, q == 1u || q == 2u ? -swapped.y : swapped.y);
}

/// Exponential variate -log(v), v = (word + 1/2) 2^-32, in (0, 22.9]. Relative error below 4e-7 at
/// both ends: for v near 1, 1 - v is formed from the word and not from v (ORACLES 6.1).
float exponential_variate(uint word) {
    const float scale = 1.0 / 4294967296.0;
    const bool tail = word < 0xB504F334u; // v < sqrt(1/2)
    const float v = (float(word) + 0.5) * scale;
    const float complement = (float(~word) + 0.5) * scale;
    // v = m 2^e with m in [sqrt(1/2), sqrt(2))
    const int bits = floatBitsToInt(v);
    const int e = (bits - 0x3F3504F3) >> 23;
    const float m = intBitsToFloat(bits - (e << 23));
    const float z = (tail ? 1.0 - m : complement) / (tail ? 1.0 + m : 2.0 - complement);
    const float z2 = z * z;
    const float series =
        1.0 + z2 * (0.333333333 + z2 * (0.2 + z2 * (0.142857143 + z2 * 0.111111111)));
    return 2.0 * z * series - (tail ? float(e) * 0.693147181 : 0.0);
}

/// 1 - exp(-x) for x >= 0, without cancellation: relative error below 1e-6.
float one_minus_exp(float x) {
    const float tail = 0.166666667 - x * (0.0416666667 - x * (0.00833333333 - x * 0.00138888889));
    const float series = x * (1.0 - x * (0.5 - x * tail));
    return x < 0.25 ? series : 1.0 - exp(-x);
}
vec3 one_minus_exp(vec3 x) {
    return vec3(one_minus_exp(x.x), one_minus_exp(x.y), one_minus_exp(x.z));
}

/// Two unit vectors that form a right-handed frame with the unit vector n.
/// Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited"; but the frame jumps at n.z
/// = -0.75 and not at 0, where rounding would pick the frame of every upright wall.
void make_frame(vec3 n, out vec3 s, out vec3 t) {
    const float sign_z = n.z < -0.75 ? -1.0 : 1.0;
    const float a = -1.0 / (sign_z + n.z);
    const float b = n.x * n.y * a;
    s = vec3(1.0 + sign_z * n.x * n.x * a, sign_z * b, -sign_z * n.x);
    t = vec3(b, sign_z + n.y * n.y * a, -n.y);
}

/// The direction at the given polar angle from the unit vector `axis`, azimuth 2 pi u.
vec3 deflect(vec3 axis, float cos_theta, float sin_theta, float u) {
    vec3 s, t;
    make_frame(axis, s, t);
    const vec2 sc = sin_cos_turns(u) * sin_theta;
    const vec3 d = axis * cos_theta + s * sc.y + t * sc.x;
    // Of unit length but for rounding, which must not add up: one step of Newton's iteration.
    return d * (1.5 - 0.5 * dot(d, d));
}

/// Uniform point of the unit disk (Shirley and Chiu 1997), as pbrt maps it.
vec2 sample_disk(float u, float v) {
    const float x = 2.0 * u - 1.0;
    const float y = 2.0 * v - 1.0;
    if (x == 0.0 && y == 0.0) return vec2(0);
    const bool wide = abs(x) > abs(y);
    const float r = wide ? x : y;
    // angle: wide ? pi/4 y/x : pi/2 - pi/4 x/y, in turns
    const float turns = wide ? 0.125 * (y / x) : 0.25 - 0.125 * (x / y);
    const vec2 sc = sin_cos_turns(turns < 0.0 ? turns + 1.0 : turns);
    return r * sc.yx;
}

/// Power heuristic (beta = 2) for one sample of pdf a against one of pdf b (Veach 1997, 9.2.4).
/// Formed from their ratio, so that no square overflows.
float power_heuristic(float a, float b) {
    if (b == 0.0) return 1.0;
    const float ratio = b / a;
    return 1.0 / (1.0 + ratio * ratio);
}

#endif

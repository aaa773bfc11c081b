// Reflection and refraction at smooth boundaries: unpolarised light, exact Fresnel equations. Pure
// functions.
//
// Everything is written with normal components of wave vectors: c, of the one here, whose length is
// 1, and of the one beyond, sqrt(eta^2 - 1 + c^2) (what is tangential is the same on both sides).
// Differences such as c - eta cos_t are then quotients in which nothing cancels: at grazing angles,
// near eta = 1, and next to the critical angle all digits stay.
#ifndef TYNDALL_FRESNEL_GLSL
#define TYNDALL_FRESNEL_GLSL

#include "lib/sampling.glsl"

/// A boundary of dielectrics as light meets it.
struct Boundary {
    float eta; ///< Index of refraction beyond over that here.
    float gap; ///< eta^2 - 1
};

/// @param eta  inside over outside;  @param entering  the light comes from outside.
Boundary make_boundary(float eta, bool entering) {
    const float gap = (eta - 1.0) * (eta + 1.0);
    if (entering) return Boundary(eta, gap);
    return Boundary(1.0 / eta, -gap / (eta * eta));
}

/// Normal component of the wave vector beyond, eta cos_t; 0 from the critical angle on.
float wave_beyond(Boundary b, float c) {
    return sqrt(max(0.0, b.gap + c * c));
}

/// Part of the light that is reflected; c is the cosine of incidence, in [0, 1]. 1 from the
/// critical angle on. Source: Born and Wolf, Principles of Optics, 1.5.2.
float fresnel_dielectric(Boundary b, float c) {
    if (b.gap + c * c <= 0.0 && b.gap != 0.0) return 1.0;
    const float a = wave_beyond(b, c);
    const float sum_s = c + a, sum_p = (b.gap + 1.0) * c + a;
    // r_s = (c - a) / (c + a) and r_p = (eta^2 c - a) / (eta^2 c + a), by the difference of
    // squares. Both sums are 0 only where light grazes a boundary that is none: it passes.
    const float r_s = b.gap / max(sum_s * sum_s, FLOAT_MIN);
    const float r_p = b.gap * ((b.gap + 2.0) * c * c - 1.0) / max(sum_p * sum_p, FLOAT_MIN);
    return min(1.0, 0.5 * (r_s * r_s + r_p * r_p));
}

/// What a thin pane reflects, of whose faces each reflects R: R + T^2 R / (1 - R^2), both faces and
/// all that goes back and forth between them.
float fresnel_pane(Boundary face, float c) {
    const float r = fresnel_dielectric(face, c);
    return 2.0 * r / (1.0 + r);
}

/// The direction beyond of light that comes from `w` (unit, towards where it comes from), c =
/// dot(w, normal) > 0. Only for angles below the critical one.
vec3 refract_through(Boundary b, vec3 w, vec3 normal, float c) {
    const float bend = b.gap / max(c + wave_beyond(b, c), FLOAT_MIN); // eta cos_t - cos_i
    return normalize(-w - bend * normal);
}

vec3 reflect_about(vec3 w, vec3 normal, float c) {
    return normalize(2.0 * c * normal - w);
}

/// Part of the light that a metal of index eta + i k reflects, by channel. a + i b is the normal
/// component of the wave vector in the metal.
vec3 fresnel_conductor(vec3 eta, vec3 k, float c) {
    const float sin2 = (1.0 - c) * (1.0 + c);
    const vec3 product = eta * k;
    const vec3 real = (eta - k) * (eta + k) - sin2; // of the square of a + i b
    const vec3 squared = sqrt(real * real + 4.0 * product * product);
    // The larger of a and b by a sum, the other from their product.
    const vec3 larger = sqrt(0.5 * (squared + abs(real)));
    const vec3 smaller = product / max(larger, FLOAT_MIN);
    const bvec3 swapped = lessThan(real, vec3(0));
    const vec3 a = mix(larger, smaller, swapped), b = mix(smaller, larger, swapped);
    const vec3 plus_s = c + a, minus_s = c - a;
    const vec3 plus_p = c * a + sin2, minus_p = c * a - sin2;
    const vec3 b2 = b * b;
    const vec3 r_s = (minus_s * minus_s + b2) / max(plus_s * plus_s + b2, FLOAT_MIN);
    const vec3 ratio =
        (minus_p * minus_p + c * c * b2) / max(plus_p * plus_p + c * c * b2, FLOAT_MIN);
    return min(vec3(1), 0.5 * r_s * (1.0 + ratio));
}

#endif

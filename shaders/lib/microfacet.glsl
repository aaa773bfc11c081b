// Rough boundaries: microfacets with the isotropic GGX distribution, height-correlated masking and
// shadowing (Smith), sampled by visible normals. One reflection or refraction per event. Pure
// functions.
//
// Directions are unit vectors in the frame of the shading normal, whose z axis is on the side of
// `wo`, where the path comes from: wo.z >= 0. Names and formulas as pbrt-v4, chapter 9; the
// quotients are rearranged so that grazing angles (z = 0) need no case of their own.
#ifndef TYNDALL_MICROFACET_GLSL
#define TYNDALL_MICROFACET_GLSL

#include "lib/fresnel.glsl"
#include "lib/sampling.glsl"

/// Density of normals per steradian and area of the surface.
/// Source: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces",
/// equation 33.
float ggx_density(vec3 m, float alpha) {
    const float alpha2 = alpha * alpha;
    const float q = dot(m.xy, m.xy) + alpha2 * m.z * m.z;
    return alpha2 / (PI * q * q);
}

/// Length of w in the space in which the distribution is a hemisphere: |w.z| (1 + 2 Lambda(w)).
float ggx_length(vec3 w, float alpha) {
    return sqrt(w.z * w.z + alpha * alpha * dot(w.xy, w.xy));
}

/// Density of visible normals over dot(wo, m): G1(wo) D(m) / wo.z.
float ggx_visible(vec3 wo, vec3 m, float alpha) {
    return 2.0 * ggx_density(m, alpha) / (wo.z + ggx_length(wo, alpha));
}

/// G(wo, wi) / G1(wo): what is left of light that visible normals send from wi. Any sign of wi.z
/// but 0.
float ggx_weight(vec3 wo, vec3 wi, float alpha) {
    const float cos_i = abs(wi.z);
    const float length_o = ggx_length(wo, alpha);
    return cos_i * (wo.z + length_o) / (length_o * cos_i + ggx_length(wi, alpha) * wo.z);
}

/// A normal that is visible from wo: uniform over the cap of the sphere (in the space of
/// ggx_length) that reflects wo upwards. Its axis is -z, turn u; 1 - z of a point of the cap is v
/// (1 + wo.z). Source: Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".
vec3 sample_visible_normal(vec3 wo, float alpha, float u, float v) {
    const vec3 w = normalize(vec3(alpha * wo.xy, wo.z));
    const float complement = v * (1.0 + w.z);
    const float sine = sqrt(max(0.0, complement * (2.0 - complement)));
    const vec2 sc = sin_cos_turns(u) * sine;
    return normalize(vec3(alpha * (vec2(sc.y, sc.x) + w.xy), (1.0 - v) * (1.0 + w.z)));
}

/// Solid angle of normals per solid angle of refracted directions, |d m / d wi|, for light that
/// meets m at the cosine c: |wi.m| / (wi.m + wo.m / eta)^2 (Walter et al., equation 17, with both
/// sides' indices over eta).
float refraction_jacobian(Boundary b, float c) {
    const float a = wave_beyond(b, c);
    const float q = (c + a) / b.gap; // wi.m + wo.m / eta = -gap / (eta (c + a))
    return a * b.eta * q * q;
}

/// Density per steradian of the direction that a facet m makes of wo, if sample_visible_normal and
/// Fresnel's choice draw them; c = dot(wo, m), f = fresnel_dielectric(b, c).
float rough_dielectric_pdf(Boundary b, float alpha, vec3 wo, vec3 m, float c, float f,
                           bool reflects) {
    const float choice = reflects ? 0.25 * f : (1.0 - f) * c * refraction_jacobian(b, c);
    return choice * ggx_visible(wo, m, alpha);
}

/// Value of the BSDF times |wi.z| over that density. Refraction spreads light over eta^2 times the
/// solid angle.
float rough_dielectric_weight(Boundary b, float alpha, vec3 wo, vec3 wi) {
    return ggx_weight(wo, wi, alpha) / (wi.z > 0.0 ? 1.0 : b.eta * b.eta);
}

/// Draws wi for a rough boundary of dielectrics: `u` chooses the facet, `choice` whether it
/// reflects or refracts. False if that sends it to the wrong side of the surface, from where
/// nothing comes. Source: pbrt-v4, DielectricBxDF::Sample_f.
bool sample_rough_dielectric(Boundary b, float alpha, vec3 wo, vec2 u, float choice, out vec3 wi,
                             out float pdf, out float weight) {
    const vec3 m = sample_visible_normal(wo, alpha, u.x, u.y);
    const float c = clamp(dot(wo, m), 0.0, 1.0);
    const float f = fresnel_dielectric(b, c);
    const bool reflects = choice < f;
    wi = reflects ? reflect_about(wo, m, c) : refract_through(b, wo, m, c);
    pdf = rough_dielectric_pdf(b, alpha, wo, m, c, f, reflects);
    weight = rough_dielectric_weight(b, alpha, wo, wi);
    return reflects ? wi.z > 0.0 : wi.z < 0.0;
}

/// Density and weight of a direction wi of any origin; light sampling needs them.
/// Source: pbrt-v4, DielectricBxDF::f and ::PDF.
void evaluate_rough_dielectric(Boundary b, float alpha, vec3 wo, vec3 wi, out float pdf,
                               out float weight) {
    const bool reflects = wi.z > 0.0;
    vec3 m = wo + (reflects ? 1.0 : b.eta) * wi;
    const float squared = dot(m, m);
    m *= (m.z < 0.0 ? -1.0 : 1.0) * inversesqrt(max(squared, FLOAT_MIN));
    const float c = dot(wo, m);
    pdf = weight = 0.0;
    // Normals that either direction sees from behind do not count.
    const bool is_seen = c > 0.0 && (reflects || dot(wi, m) < 0.0);
    if (!is_seen || squared == 0.0 || wi.z == 0.0) return;
    pdf = rough_dielectric_pdf(b, alpha, wo, m, c, fresnel_dielectric(b, min(c, 1.0)), reflects);
    weight = rough_dielectric_weight(b, alpha, wo, wi);
}

/// Draws wi for rough metal, both sides of which reflect; otherwise as for dielectrics.
/// Source: pbrt-v4, ConductorBxDF::Sample_f.
bool sample_rough_conductor(vec3 eta, vec3 k, float alpha, vec3 wo, vec2 u, out vec3 wi,
                            out float pdf, out vec3 weight) {
    const vec3 m = sample_visible_normal(wo, alpha, u.x, u.y);
    const float c = clamp(dot(wo, m), 0.0, 1.0);
    wi = reflect_about(wo, m, c);
    pdf = 0.25 * ggx_visible(wo, m, alpha);
    weight = fresnel_conductor(eta, k, c) * ggx_weight(wo, wi, alpha);
    return wi.z > 0.0;
}

/// Density and weight of a direction wi of any origin.
/// Source: pbrt-v4, ConductorBxDF::f and ::PDF.
void evaluate_rough_conductor(vec3 eta, vec3 k, float alpha, vec3 wo, vec3 wi, out float pdf,
                              out vec3 weight) {
    pdf = 0.0;
    weight = vec3(0);
    if (wi.z <= 0.0) return;
    const vec3 m = normalize(wo + wi);
    const float c = clamp(dot(wo, m), 0.0, 1.0);
    pdf = 0.25 * ggx_visible(wo, m, alpha);
    weight = fresnel_conductor(eta, k, c) * ggx_weight(wo, wi, alpha);
}

#endif

// Marching through media: sums over steps along a line, in place of tracking. Biased by the size of
// the steps; here to be compared with what is not.
#ifndef TYNDALL_MARCH_GLSL
#define TYNDALL_MARCH_GLSL

#include "lib/intersect.glsl"
#include "wavefront/volume.glsl"

/// Steps of a march over a length.
uint march_steps(float length) {
    const uvec4 march = fetch_scene(MARCH_TEXEL);
    const float size = uintBitsToFloat(march.y);
    return size > 0.0 ? uint(clamp(ceil(length / size), 1.0, float(MARCH_STEPS_MAX))) : march.x;
}

/// Cuts a line through a spherical atmosphere to where there is any: beyond 20 scale heights the
/// density is 2e-9.
void clip_to_atmosphere(inout Field f, inout float t) {
    if ((densities & DENSITY_BIT_SPHERE) == 0u || f.is_grid) return;
    float near = 0.0, far = 0.0;
    const float radius = f.sphere.radius + 20.0 * f.sphere.scale_height;
    if (!intersect_sphere(f.origin, f.direction, radius, near, far)) near = far = 0.0;
    t = max(t, near);
    f.t_end = min(f.t_end, far);
}

/// Where to end a march that nothing ends: e^-20 of the light is left of the channel that is
/// absorbed and scattered least, or of the density of an atmosphere.
float march_horizon(Medium medium, vec3 origin, vec3 direction) {
    const vec3 sigma_t = medium.sigma_a + medium.sigma_s;
    float least = INFINITY;
    for (int c = 0; c < 3; ++c)
        if (sigma_t[c] > 0.0) least = min(least, sigma_t[c]);
    float t = distance_of_column(medium, origin, direction, 20.0 / least);
    if ((densities & DENSITY_BIT_PLANE) != 0u && medium.density_kind == DENSITY_PLANE) {
        const ExponentialRecord e = load_exponential(medium.density_record);
        const float rise = dot(e.up, transform_vector(e.medium_from_render, direction));
        if (rise > 0.0) t = min(t, 20.0 * e.scale_height / rise);
    }
    return t <= FLOAT_MAX ? t : 0.0;
}

/// The line of a march, which goes from t to Field::t_end.
Field begin_march(Medium medium, vec3 origin, vec3 direction, float t_surface, out float t) {
    Field f = begin_field(medium, origin, direction, t_surface, t);
    if (is_tracked(medium))
        clip_to_atmosphere(f, t);
    else if (t_surface > FLOAT_MAX)
        f.t_end = march_horizon(medium, origin, direction);
    return f;
}

/// Density at distance t, but for that of grids.
float density_at(Medium medium, Field f, vec3 origin, vec3 direction, float t) {
    if ((densities & DENSITY_BIT_SPHERE) != 0u && medium.density_kind == DENSITY_SPHERE) {
        const float height = max(0.0, length(f.origin + t * f.direction) - f.sphere.radius);
        return exp(-height / f.sphere.scale_height);
    }
    if ((densities & DENSITY_BIT_PLANE) == 0u || medium.density_kind != DENSITY_PLANE) return 1.0;
    const ExponentialRecord e = load_exponential(medium.density_record);
    const vec3 place = transform_point(e.medium_from_render, origin + t * direction);
    return exp(-dot(e.up, place - e.origin) / e.scale_height);
}

/// The i-th of the eight voxels around a point of index space; returns its trilinear weight.
float corner_weight(vec3 point, int i, out ivec3 voxel) {
    const ivec3 upper = ivec3(i, i >> 1, i >> 2) & 1;
    const vec3 base = floor(point);
    const vec3 share = mix(1.0 - (point - base), point - base, equal(upper, ivec3(1)));
    voxel = ivec3(base) + upper;
    return share.x * share.y * share.z;
}

/// sigma_t at distance t along a line that is tracked.
vec3 extinction_at(Medium medium, Field f, vec3 origin, vec3 direction, float t) {
    if (!f.is_grid)
        return (medium.sigma_a + medium.sigma_s) * density_at(medium, f, origin, direction, t);
    vec3 sum = vec3(0);
    for (int i = 0; i < 8; ++i) {
        ivec3 voxel;
        const float weight = corner_weight(f.origin + t * f.direction, i, voxel);
        const Tap tap = tap_grid(medium, f.grid, f.bricks, voxel);
        sum += weight * (tap.sigma_a + tap.sigma_s);
    }
    return sum;
}

/// Transmittance of the line up to `t_surface`, by the middles of steps.
vec3 march_transmittance(Medium medium, vec3 origin, vec3 direction, float t_surface) {
    float t;
    const Field f = begin_march(medium, origin, direction, t_surface, t);
    if (!(t < f.t_end)) return vec3(1);
    const uint steps = march_steps(f.t_end - t);
    const float dt = (f.t_end - t) / float(steps);
    vec3 sum = vec3(0);
    for (uint i = 0u; i < steps; ++i)
        sum += extinction_at(medium, f, origin, direction, t + (float(i) + 0.5) * dt);
    return attenuation(sum, dt);
}

#endif

// Light of small lights, points and spots, in thin media. Few paths collide there, and fewer where
// the light is strong; so a path that passes its segment without a collision looks for light at one
// place on it, chosen by equal angles as seen from a light (lib/equiangular.glsl). Both ways of
// coming upon a place are weighed by the balance heuristic: a path collides with the density c(t) =
// sigma_s exp(-sigma_s t), or it passes, looks, and chooses t: exp(-sigma_s t_end) q e(t). Where
// media are dense nothing passes, and nothing changes.
#ifndef TYNDALL_PASSING_GLSL
#define TYNDALL_PASSING_GLSL

#include "lib/equiangular.glsl"
#include "wavefront/light_sampling.glsl"
#include "wavefront/phases.glsl"

/// A segment of a path in a medium.
struct Segment {
    vec3 origin;
    vec3 direction;
    vec3 r;      ///< Spectral ratios at its start.
    float t_end; ///< Where there is a surface, if no collision is before.
    uint event;
};

Segment segment_of(Path p, float t_end) {
    return Segment(p.origin, p.direction, p.r, t_end, p.event);
}

/// Of LOOKOUTS_MAX paths that pass the segment of an event, how many look for light on it.
uint lookouts(Medium medium, float t_end, uint event) {
    if (has_equiangular == 0u || (densities != 0u && medium.density_kind != DENSITY_HOMOGENEOUS) ||
        is_black(medium.sigma_s))
        return 0u;
    const vec3 sigma_s = medium.sigma_s;
    const float depth =
        (is_chromatic != 0u ? min(sigma_s.x, min(sigma_s.y, sigma_s.z)) : sigma_s.x) * t_end;
    if (!(depth <= LOOKOUT_DEPTH_MAX)) return 0u;
    const float early = clamp(LOOKOUTS_PER_DEPTH * depth, LOOKOUTS_MIN, LOOKOUTS_MAX);
    return uint(event > LATE_EVENT ? LATE_SHARE * early : early);
}

/// Whether a path does, by word 3 of its BLOCK_PATH.
bool looks_in_passing(Path p, Medium medium, float t_end, uint word) {
    return (word & 255u) < lookouts(medium, t_end, p.event);
}

bool is_small(LightRecord light) {
    return light.kind == LIGHT_POINT || light.kind == LIGHT_SPOT;
}

/// Where the light may shine on the segment, as one step; empty (t0 >= t1) if nowhere.
Steps lit_part(LightRecord light, Segment segment) {
    float t0 = 0.0, t1 = segment.t_end;
    if ((lights & LIGHTS_SPOT) != 0u && light.kind == LIGHT_SPOT && light.complement_width < 0.9) {
        const vec3 from = segment.origin - light.position;
        const float nearest = -dot(from, segment.direction);
        const vec3 foot = from + nearest * segment.direction;
        clip_to_cone(nearest, length(foot), dot(foot, light.axis),
                     dot(segment.direction, light.axis), 1.0 / (1.0 - light.complement_width), t0,
                     t1);
    }
    return steps_about(light.position, segment.origin, segment.direction, t0, t1, 1u);
}

/// The mean over the heroes that the path could have had.
float mean_of_heroes(vec3 r, vec3 density) {
    return is_chromatic != 0u ? mean(r * density) : density.x;
}

/// Density with which paths collide at t.
float collision_density(Segment segment, Medium medium, float t) {
    return mean_of_heroes(segment.r, medium.sigma_s * attenuation(medium.sigma_s, t));
}

/// Density with which paths come upon a place on the segment, in either way.
float density_on(Segment segment, Medium medium, Steps lit, float t) {
    const float collision = collision_density(segment, medium, t);
    if (!(t >= lit.t0 && t <= lit.t1)) return collision;
    const float passing = mean_of_heroes(segment.r, attenuation(medium.sigma_s, segment.t_end)) *
                          float(lookouts(medium, segment.t_end, segment.event)) / LOOKOUTS_MAX;
    return collision + passing / step_weight(lit, t);
}

/// MIS weight of light that a path gets at a collision at t.
float collision_weight(Segment segment, Medium medium, LightRecord light, float t) {
    if (!is_small(light) || lookouts(medium, segment.t_end, segment.event) == 0u) return 1.0;
    return collision_density(segment, medium, t) /
           density_on(segment, medium, lit_part(light, segment), t);
}

/// Light that a path finds on a segment that it passes, if nothing is in between; the path goes to
/// where that is.
LightSample light_in_passing(inout Path p, Medium medium, float t_end) {
    LightSample found = LightSample(vec3(0, 0, 1), INFINITY, vec3(0), 0.0, NONE);
    const uvec4 words = draw(p, p.event | EVENT_PASSING, BLOCK_LIGHT);
    const LightRecord light = load_light(draw_light(words.x));
    const Segment segment = segment_of(p, t_end);
    const Steps lit = lit_part(light, segment);
    if (p.depth == max_depth || !is_small(light) || !(lit.t0 < lit.t1)) return found;
    const float t = step_place(lit, unit_float(words.y));
    p.origin += t * p.direction;
    look_at_light(light, p.origin, found);
    const vec3 collision = medium.sigma_s * attenuation(medium.sigma_s + medium.sigma_a, t);
    found.radiance *= p.throughput * collision *
                      (evaluate_phase(medium, p.direction, found.direction) /
                       density_on(segment, medium, lit, t));
    return found;
}

#endif

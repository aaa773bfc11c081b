// What stages share of the end of a segment: the way there, scattering, roulette, light sampling.
#ifndef TYNDALL_INTERACT_GLSL
#define TYNDALL_INTERACT_GLSL

#include "wavefront/light_sampling.glsl"
#include "wavefront/passing.glsl"
#include "wavefront/path.glsl"
#include "wavefront/phases.glsl"
#include "wavefront/region.glsl"
#include "wavefront/volume.glsl"

/// Medium on the side of a surface that a ray leaves to along `direction`.
uint medium_beyond(ShapeRecord shape, SurfacePoint s, vec3 direction, uint medium) {
    if (has_media == 0u || (shape.flags & SHAPE_TRANSITION) == 0u) return medium;
    medium = dot(direction, s.normal) > 0.0 ? shape.medium_outside : shape.medium_inside;
    return medium == VACUUM ? VACUUM : medium + s.medium_shift;
}

/// Whether a collision absorbs the path, rather than scattering it.
bool is_absorbed(Path p, Medium medium) {
    if (is_analog == 0u) return false;
    const uint channel = is_chromatic != 0u ? p.hero : 0u;
    const float scattered = medium.sigma_s[channel];
    return unit_float(draw(p, BLOCK_LIGHT).w) * (scattered + medium.sigma_a[channel]) >= scattered;
}

/// Takes the path to the end of its segment at distance t: emission on the way, then throughput; a
/// path that is absorbed ends. Tracking or marching has done so already.
void travel(inout Path p, Medium medium, float t, bool collided) {
    if (has_closed_media == 0u || is_carried(medium)) return;
    const float column = column_length(medium, p.origin, p.direction, t);
    if (has_emission != 0u && is_analog == 0u)
        contribute(p, segment_emission(medium, p.throughput, p.r, column));
    const bool absorbed = collided && is_absorbed(p, medium);
    const uint end = absorbed ? END_ABSORBED : collided ? END_SCATTERED : END_PASSED;
    pass_segment(medium, p.hero, column, end, p.throughput, p.r);
    if (!absorbed) return;
    if (has_emission != 0u) contribute(p, p.throughput * medium.emission);
    log_path(EVENT_ABSORBED, p);
    p.status = STATUS_ENDED;
}

/// Whether paths run into what light sampling chooses as well, and are weighed against it.
bool paths_find_lights() {
    return (lights & (LIGHTS_AREA | LIGHTS_VOXELS)) != 0u;
}

/// The queue of paths that stand at the primitive; of those that escape if it is NONE.
uint queue_of_surface(uint primitive) {
    if (primitive == NONE) return QUEUE_ENDED;
    if ((surface_queues & (surface_queues - 1u)) == 0u) return uint(findLSB(surface_queues));
    return fetch_scene(push.shapes + shape_of(primitive) * SHAPE_TEXELS).w;
}

/// Counts a scattering event; false if the path has had its share, and ends.
bool may_scatter(inout Path p) {
    const bool may = p.depth != max_depth;
    note_mishap(HEALTH_EVENT_LIMIT, !may && depth_is_cut);
    if (!may) log_path(EVENT_DEPTH_LIMIT, p);
    p.status = may ? p.status : STATUS_ENDED;
    p.depth += may ? 1u : 0u;
    return may;
}

/// How much of the light inside the ball around all surfaces and lights is still to be found at a
/// place outside of it, by the solid angle of the ball and the medium in between: 1 inside.
float reach_of_light(vec3 place, Medium medium) {
    if (has_lit_ball == 0u) return 1.0;
    const vec4 ball = uintBitsToFloat(fetch_scene(LIT_BALL_TEXEL));
    const float distance = length(place - ball.xyz);
    const float share = ball.w / max(distance, ball.w);
    if (medium.density_kind != DENSITY_HOMOGENEOUS) return share * share;
    const vec3 sigma_t = medium.sigma_a + medium.sigma_s;
    const float least = min(sigma_t.x, min(sigma_t.y, sigma_t.z));
    return share * share * exp(-least * max(distance - ball.w, 0.0));
}

/// Russian roulette on what a path carries, times how much of the light is within its reach. Late,
/// and never at worse odds than 1 : 3, so that no weight grows by much.
void roulette(inout Path p, float reach, uint word) {
    const float w = max(p.throughput.x, max(p.throughput.y, p.throughput.z));
    // Without surfaces and voxels there is only spectral MIS, which never exceeds 3.
    if (geometry == GEOMETRY_BVH) note_mishap(HEALTH_WEIGHT, w * reach > WEIGHT_MAX);
    const float chance = clamp(roulette_scale * w * reach, 0.25, 1.0);
    if (unit_float(word) >= chance || w <= 0.0) {
        log_path(w <= 0.0 ? EVENT_ABSORBED : EVENT_ROULETTE, p);
        p.status = STATUS_ENDED;
    }
    p.throughput /= chance;
}

/// Light that the path gets at its origin, in a medium, from a light that it chooses, if nothing is
/// in between. It collided there at distance t of the segment.
LightSample light_in_medium(Path p, Medium medium, Segment segment, float t) {
    LightRecord chosen;
    LightSample light = sample_light(p, p.origin, draw(p, BLOCK_LIGHT), chosen);
    const vec3 value = evaluate_phase(medium, p.direction, light.direction);
    const float pdf = phase_density(value, p.r);
    float mis = light.pdf > 0.0 ? power_heuristic(light.pdf, pdf) : 1.0;
    if (has_equiangular != 0u && !is_black(light.radiance))
        mis *= collision_weight(segment, medium, chosen, t);
    light.radiance *= p.throughput * (value * mis);
    return light;
}

/// Scatters a path that collided at its origin. The phase function of the hero is sampled exactly:
/// no weight, but for what tells channels apart (lib/medium.glsl).
void scatter_in_medium(inout Path p, Medium medium, uvec4 words) {
    const vec3 incoming = p.direction;
    p.direction = sample_phase(medium, p.hero, incoming, unit_float(words.y), unit_float(words.z));
    if (paths_find_lights() || has_chromatic_phases != 0u) {
        const vec3 value = evaluate_phase(medium, incoming, p.direction);
        p.pdf = phase_density(value, p.r);
        // A delta has no density, and no colour.
        if (has_chromatic_phases != 0u && p.pdf > 0.0) {
            p.throughput *= value / p.pdf;
            p.r *= value / p.pdf;
        }
    }
    roulette(p, reach_of_light(p.origin, medium), words.w);
}

/// Leaves a shadow ray from `origin` to trace_shadow.
void cast_shadow_ray(uint slot, vec3 origin, uint medium, LightSample light) {
    if (is_black(light.radiance)) return;
    store_path(PATH_SHADOW, slot, uvec4(floatBitsToUint(origin), medium));
    store_path(PATH_SHADOW + 1u, slot, floatBitsToUint(vec4(light.direction, light.distance)));
    store_colour(PATH_SHADOW + 2u, slot, light.radiance, light.target);
    enqueue(QUEUE_SHADOW, slot);
}

/// Distance since the last scattering, where crossing interfaces does not reset it.
float distance_travelled(uint slot, float t) {
    if (has_interfaces == 0u || !paths_find_lights()) return t;
    return t + uintBitsToFloat(load_path(PATH_HIT, slot).w);
}
void set_distance_before(uint slot, float before) {
    if (has_interfaces != 0u && paths_find_lights())
        store_path_word(PATH_HIT, 3u, slot, floatBitsToUint(before));
}

#endif

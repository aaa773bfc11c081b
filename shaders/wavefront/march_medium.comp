#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/equiangular.glsl"
#include "wavefront/interact.glsl"
#include "wavefront/march.glsl"

// Takes paths through media by marching (integrator singlescatter): L = sum over steps of T
// (sigma_a Le + sigma_s p L_light T_light) dt, with T the product of the transmittances of the
// steps before. Each step is an event, and casts a shadow ray at most, to a light or in a direction
// chosen anew.
//
//   TRACK queue -> SHADOW queue, and the march goes on in the next round
//               -> SURFACE | INTERFACE | ENDED queue

/// What a step finds: coefficients, and emission weighed against light sampling.
struct Matter {
    vec3 sigma_a;
    vec3 sigma_s;
    vec3 source; ///< sigma_a Le
};

Matter scaled_matter(Medium medium, float density) {
    const vec3 sigma_a = density * medium.sigma_a;
    return Matter(sigma_a, density * medium.sigma_s, sigma_a * medium.emission);
}

/// At distance t; `before` is the distance from the path's last vertex to its origin.
Matter matter_at(Path p, Medium medium, Field f, float t, float before) {
    if (!f.is_grid) return scaled_matter(medium, density_at(medium, f, p.origin, p.direction, t));
    Matter sum = Matter(vec3(0), vec3(0), vec3(0));
    for (int i = 0; i < 8; ++i) {
        ivec3 voxel;
        const float weight = corner_weight(f.origin + t * f.direction, i, voxel);
        const Tap tap = tap_grid(medium, f.grid, f.bricks, voxel);
        const vec3 source = tap.sigma_a * tap.emission;
        sum.sigma_a += weight * tap.sigma_a;
        sum.sigma_s += weight * tap.sigma_s;
        if (has_emission != 0u)
            sum.source += weight * source *
                          emission_weight(p, f, source, tap.sigma_a + tap.sigma_s, before + t);
    }
    return sum;
}

/// Whether a step asks the environment and not the lights, by the numbers that choose a light.
bool asks_environment(uvec4 words) {
    return has_environment != 0u && (lights == 0u || unit_float(words.w) < 0.5);
}

/// The steps through the medium, given the numbers of the first event.
Steps plan(Path p, float t0, float t1, uvec4 words) {
    const uint count = t0 < t1 ? march_steps(t1 - t0) : 0u;
    if (march == MARCH_EQUIANGULAR && lights != 0u && !asks_environment(words)) {
        vec3 place;
        if (light_place(load_light(draw_light(words.x)), unit_float(words.y), unit_float(words.z),
                        place))
            return steps_about(place, p.origin, p.direction, t0, t1, count);
    }
    return equal_steps(t0, t1, count);
}

/// Light from one direction, per sigma_s, if nothing is in between. Its choice costs a factor 2
/// where there are lights and an environment.
LightSample single_scattered(Path p, Medium medium, vec3 place, uvec4 words) {
    LightSample light;
    if (asks_environment(words)) {
        const uvec4 own = draw(p, BLOCK_PATH);
        light = LightSample(
            sample_phase(medium, p.hero, p.direction, unit_float(own.y), unit_float(own.z)),
            INFINITY, load_camera().environment, 0.0, NONE);
        if (has_chromatic_phases != 0u) {
            const vec3 value = evaluate_phase(medium, p.direction, light.direction);
            const float pdf = phase_density(value, p.r);
            if (pdf > 0.0) light.radiance *= value / pdf;
        }
    } else {
        light = sample_light(p, place, words);
        light.radiance *= evaluate_phase(medium, p.direction, light.direction);
    }
    if (has_environment != 0u && lights != 0u) light.radiance *= 2.0;
    return light;
}

void main() {
    const uint slot = dequeue(QUEUE_TRACK);
    if (slot == NONE) return;
    Path p;
    load_ray(slot, p);
    load_throughput(slot, p);
    load_radiance(slot, p);
    load_sample(slot, p);
    const uvec4 hit = load_path(PATH_HIT, slot);
    const Medium medium = load_medium(p.medium);
    float t0;
    const Field f = begin_march(medium, p.origin, p.direction, uintBitsToFloat(hit.x), t0);

    uint i = 0u;
    vec3 depth = vec3(0); // optical, of the steps before, in media that are tracked otherwise
    if (p.status == STATUS_TRACKING) {
        const uvec4 state = load_path(PATH_TRACK, slot);
        i = state.x;
        depth = uintBitsToFloat(state.yzw);
    }
    Path first = p;
    first.event -= i;
    const uvec4 first_words = draw(first, BLOCK_LIGHT);
    const Steps s = plan(p, t0, f.t_end, first_words);
    const bool scatters = (lights != 0u || has_environment != 0u) && p.depth < max_depth;
    const bool is_incremental = is_tracked(medium);

    const uint run_length = push.run_length;
    bool casts = false;
    for (uint done = 0u; i < s.count && !casts && done < run_length; ++done) {
        const float begin = step_place(s, float(i));
        const float u = march == MARCH_UNIFORM ? 0.5 : unit_float(draw(p, BLOCK_PATH).x);
        const float t = step_place(s, float(i) + u);
        const Matter m = matter_at(p, medium, f, t, uintBitsToFloat(hit.w));
        const vec3 extinction = m.sigma_a + m.sigma_s;
        const vec3 reached =
            is_incremental ? exp(-(depth + extinction * (t - begin)))
                           : transmittance(medium, column_length(medium, p.origin, p.direction, t));
        const vec3 weight = p.throughput * reached * step_weight(s, t);
        if (has_emission != 0u) contribute(p, weight * m.source);
        if (scatters && !is_black(m.sigma_s)) {
            const vec3 place = p.origin + t * p.direction;
            uvec4 words = draw(p, BLOCK_LIGHT);
            if (march == MARCH_EQUIANGULAR) words.xw = first_words.xw;
            LightSample light = single_scattered(p, medium, place, words);
            light.radiance *= weight * m.sigma_s;
            casts = !is_black(light.radiance);
            cast_shadow_ray(slot, place, p.medium, light);
        }
        ++i;
        ++p.event;
        if (is_incremental) depth += extinction * (step_place(s, float(i)) - begin);
    }

    const bool goes_on = casts || i < s.count;
    if (goes_on) {
        store_path(PATH_TRACK, slot, uvec4(i, floatBitsToUint(depth)));
    } else {
        const float column = column_length(medium, p.origin, p.direction, uintBitsToFloat(hit.x));
        p.throughput *= is_incremental ? exp(-depth) : transmittance(medium, column);
    }
    p.status = goes_on ? STATUS_TRACKING : is_black(p.throughput) ? STATUS_ENDED : STATUS_RAY;
    store_progress(slot, p);
    store_throughput(slot, p);
    if (has_emission != 0u) store_radiance(slot, p);
    if (!goes_on) enqueue(p.status == STATUS_ENDED ? QUEUE_ENDED : queue_of_surface(hit.y), slot);
}

// Media whose density varies: lookups, and the walks that sample flights and transmittance.
#ifndef TYNDALL_VOLUME_GLSL
#define TYNDALL_VOLUME_GLSL

#include "lib/tracking.glsl"
#include "shared/volume_records.h"
#include "wavefront/path.glsl"

/// Word `index` of a table of words, four a texel.
uint table_word(uint texel, uint index) {
    return fetch_scene(texel + (index >> 2))[index & 3u];
}

GridRecord load_grid(uint texel) {
    GridRecord g;
    g.index_from_render = load_affine(texel);
    uvec4 t = fetch_scene(texel + 3u);
    g.lower = floats(t);
    g.density = t.w;
    t = fetch_scene(texel + 4u);
    g.upper = floats(t);
    g.temperature = t.w;
    t = fetch_scene(texel + 5u);
    g.majorant_lower = ivec3(t.xyz);
    g.majorants = t.w;
    t = fetch_scene(texel + 6u);
    g.majorant_count = ivec3(t.xyz);
    g.majorant_size = int(t.w);
    t = fetch_scene(texel + 7u);
    g.sigma_a = t.xyz;
    g.emission_scale = t.w;
    t = fetch_scene(texel + 8u);
    g.sigma_s = t.xyz;
    g.light_density = uintBitsToFloat(t.w);
    g.emission = fetch_scene(texel + 9u).xyz;
    return g;
}

ExponentialRecord load_exponential(uint texel) {
    ExponentialRecord e;
    e.medium_from_render = load_affine(texel);
    uvec4 t = fetch_scene(texel + 3u);
    e.origin = floats(t);
    e.radius = uintBitsToFloat(t.w);
    t = fetch_scene(texel + 4u);
    e.up = floats(t);
    e.scale_height = uintBitsToFloat(t.w);
    return e;
}

/// Where the bricks of a grid are.
BrickTableRecord load_bricks(uint texel) {
    BrickTableRecord bricks;
    const uvec4 t = fetch_scene(texel);
    bricks.first_brick = ivec3(t.xyz);
    bricks.table = t.w;
    bricks.brick_count = ivec3(fetch_scene(texel + 1u).xyz);
    return bricks;
}

/// Value of a voxel; 0 outside.
float voxel_value(BrickTableRecord bricks, ivec3 voxel) {
    const ivec3 brick = (voxel >> 3) - bricks.first_brick, count = bricks.brick_count;
    const bool is_inside = all(lessThan(uvec3(brick), uvec3(count)));
    const uint index = uint(brick.x + count.x * (brick.y + count.y * brick.z));
    const uint number = table_word(bricks.table, is_inside ? index : 0u);
    const bool is_stored = is_inside && number != NONE;
    const uvec3 local = uvec3(voxel & 7);
    return is_stored ? fetch_voxel(number * 512u + local.x + 8u * (local.y + 8u * local.z)) : 0.0;
}
/// Likewise of the grid whose BrickTableRecord is at `table`.
float voxel_value(uint table, ivec3 voxel) {
    return voxel_value(load_bricks(table), voxel);
}

/// Radiance of a black body, Planck's law scaled to a maximum of 1 over wavelengths.
vec3 blackbody(float kelvin) {
    const float span = log(BLACKBODY_MAX / BLACKBODY_MIN);
    const float x = log(kelvin / BLACKBODY_MIN) * (float(BLACKBODY_ENTRIES - 1u) / span);
    if (!(x > 0.0)) return vec3(0);
    const uint i = min(uint(x), BLACKBODY_ENTRIES - 2u);
    const vec3 logarithm =
        mix(floats(fetch_scene(push.blackbody + i)), floats(fetch_scene(push.blackbody + i + 1u)),
            min(x - float(i), 1.0));
    return colour(exp(logarithm));
}

/// A line through a medium whose flights are tracked.
struct Field {
    bool is_grid;
    GridRecord grid;
    BrickTableRecord bricks; ///< Of grid.density, if there is one.
    CellWalk cells;          ///< Those of the majorants.
    ExponentialRecord sphere;
    vec3 origin; ///< In index space, or the space of the sphere; distances stay those of the world.
    vec3 direction;
    float t_end;     ///< Collisions are before.
    float sigma_max; ///< Extinction of density 1, largest channel.
};

/// The line from a point of render space; t is where it enters the medium.
Field begin_field(Medium medium, vec3 origin, vec3 direction, float t_surface, out float t) {
    Field f;
    const vec3 sigma_t = medium.sigma_a + medium.sigma_s;
    f.sigma_max = max(sigma_t.x, max(sigma_t.y, sigma_t.z));
    f.is_grid = (densities & DENSITY_BIT_GRID) != 0u && medium.density_kind == DENSITY_GRID;
    f.t_end = t_surface;
    t = 0.0;
    if ((densities & DENSITY_BIT_SPHERE) != 0u && !f.is_grid) {
        f.sphere = load_exponential(medium.density_record);
        f.origin = transform_point(f.sphere.medium_from_render, origin) - f.sphere.origin;
        f.direction = transform_vector(f.sphere.medium_from_render, direction);
    }
    if (f.is_grid) {
        f.grid = load_grid(medium.density_record);
        f.origin = transform_point(f.grid.index_from_render, origin);
        f.direction = transform_vector(f.grid.index_from_render, direction);
        if (has_rgb_grids != 0u && f.grid.density == NONE)
            f.sigma_max = 1.0; // bounds are of sigma_t itself
        else
            f.bricks = load_bricks(f.grid.density);
        f.cells = make_cells(f.origin, f.direction, vec3(f.grid.majorant_lower),
                             float(f.grid.majorant_size));
        if (!clip_to_box(f.origin, f.direction, f.grid.lower, f.grid.upper, t_surface, t,
                         f.t_end)) {
            t = 0.0;
            f.t_end = 0.0;
        }
    }
    return f;
}

/// Steps of this invocation through cells and shells. They must be few: lavapipe breaks off all
/// loops of eight invocations, and says nothing, once these have been round 65535 times in them.
uint steps_walked = 0u;
const uint FLIGHT_STEPS_MAX = 2048u; ///< Of one call of next_collision.
const uint STEPS_MAX = 4096u;        ///< Before the last call of an invocation.

/// Goes on from t through the cells of the grid until the optical distance tau of the majorants is
/// used up. True if it is: then t is where, and `bound` the majorant there. Else t is the end of
/// the line; or short of it, after FLIGHT_STEPS_MAX cells, and tau is what is left of the flight.
/// (On testing first see phases.glsl; it costs other drivers 4 %.)
bool next_collision_in_grid(Field f, inout float tau, inout float t, out float bound) {
    CellWalk walk = f.cells;
    const ivec3 n = f.grid.majorant_count;
    walk.cell = cell_at(walk, n, t);
    bool collides = false, has_left = false;
    uint steps = 0u;
    bound = 0.0;
    do {
        if (loops_test_first != 0u && (collides || has_left || steps == FLIGHT_STEPS_MAX)) break;
        const ivec3 c = walk.cell;
        bound = f.sigma_max *
                uintBitsToFloat(table_word(f.grid.majorants, uint(c.x + n.x * (c.y + n.y * c.z))));
        ivec3 step;
        const float exit = max(t, min(cell_exit(walk, step), f.t_end));
        const float depth = bound * (exit - t);
        collides = depth > tau;
        t = collides ? min(t + tau / bound, exit) : exit;
        tau -= depth;
        walk.cell += step;
        has_left = t >= f.t_end || any(greaterThanEqual(uvec3(walk.cell), uvec3(n)));
        ++steps;
    } while (loops_test_first != 0u || (!collides && !has_left && steps < FLIGHT_STEPS_MAX));
    steps_walked += steps;
    if (has_left && !collides) t = f.t_end;
    return collides;
}

/// Likewise around a sphere, in steps over which the density hardly changes. Along a line the
/// density is largest where the line is nearest to the centre, so its bound over a step is exact,
/// but for rounding. Seen from 2^24 scale heights away, steps and free paths are below the rounding
/// of t: then each is a few roundings, or the walk would stand still.
bool next_collision_in_atmosphere(Field f, inout float tau, inout float t, out float bound) {
    const float speed2 = dot(f.direction, f.direction);
    const float speed = sqrt(speed2);
    const float t_nearest = -dot(f.origin, f.direction) / speed2;
    const float rounding = 4e-7;
    bool collides, has_left;
    uint steps = 0u;
    do {
        const float height = max(0.0, length(f.origin + t * f.direction) - f.sphere.radius);
        const float step = max(f.sphere.scale_height, 0.25 * height) / speed;
        const float exit = min(t + max(step, rounding * t), f.t_end);
        const vec3 nearest = f.origin + clamp(t_nearest, t, exit) * f.direction;
        const float slack = HEIGHT_ERROR * (length(nearest) + exit * speed);
        const float least =
            max(0.0, length(nearest) - slack - f.sphere.radius) / f.sphere.scale_height;
        bound = f.sigma_max * exp(-least);
        const float depth = bound * (exit - t);
        collides = depth > tau;
        t = collides ? min(t + max(tau / bound, rounding * t), exit) : exit;
        tau -= depth;
        has_left = t >= f.t_end || (least > 69.0 && t >= t_nearest); // exp(-69) = 1e-30
        ++steps;
    } while (!collides && !has_left && steps < FLIGHT_STEPS_MAX);
    steps_walked += steps;
    if (has_left && !collides) t = f.t_end;
    return collides;
}

bool next_collision(Field f, inout float tau, inout float t, out float bound) {
    bound = 0.0;
    if (densities == DENSITY_BIT_GRID) return next_collision_in_grid(f, tau, t, bound);
    if ((densities & DENSITY_BIT_GRID) != 0u && f.is_grid)
        return next_collision_in_grid(f, tau, t, bound);
    if ((densities & DENSITY_BIT_SPHERE) != 0u)
        return next_collision_in_atmosphere(f, tau, t, bound);
    t = f.t_end;
    return false;
}

/// What the medium is like at a point, by one stochastic trilinear tap.
struct Tap {
    vec3 sigma_a;
    vec3 sigma_s;
    vec3 emission; ///< Le
};

Tap tap_grid(Medium medium, GridRecord g, BrickTableRecord bricks, ivec3 corner) {
    Tap tap = Tap(medium.sigma_a, medium.sigma_s, medium.emission);
    if (has_rgb_grids == 0u || g.density != NONE) {
        const float density = voxel_value(bricks, corner);
        tap.sigma_a *= density;
        tap.sigma_s *= density;
    } else {
        for (int c = 0; c < 3; ++c) {
            tap.sigma_a[c] = voxel_value(g.sigma_a[c], corner);
            tap.sigma_s[c] = voxel_value(g.sigma_s[c], corner);
        }
    }
    if (has_emission == 0u) return tap;
    if (has_rgb_grids != 0u && g.emission.x != NONE)
        for (int c = 0; c < 3; ++c)
            tap.emission[c] *= voxel_value(g.emission[c], corner);
    if (g.emission_scale != NONE) tap.emission *= voxel_value(g.emission_scale, corner);
    if (has_temperature != 0u && g.temperature != NONE)
        tap.emission *= blackbody(voxel_value(g.temperature, corner));
    return tap;
}

Tap tap_field(Medium medium, Field f, float t, float u) {
    const vec3 point = f.origin + t * f.direction;
    if ((densities & DENSITY_BIT_SPHERE) != 0u && !f.is_grid) {
        const float height = max(0.0, length(point) - f.sphere.radius);
        const float density = exp(-height / f.sphere.scale_height);
        return Tap(medium.sigma_a * density, medium.sigma_s * density, medium.emission);
    }
    return tap_grid(medium, f.grid, f.bricks, choose_corner(point, u));
}

/// Transmittance of the line up to `t_surface` by ratio tracking, with roulette; `step` counts its
/// random blocks (random.h), `worst_ratio` becomes the largest ratio of extinction to majorant.
/// What takes more than STEPS_MAX steps in one dispatch counts as ended by the limit of events, and
/// is dark.
vec3 track_transmittance(Medium medium, vec3 origin, vec3 direction, float t_surface, Path p,
                         inout uint step, inout float worst_ratio) {
    float t, bound;
    float tau = 0.0; // what is left of a flight, if any
    const Field f = begin_field(medium, origin, direction, t_surface, t);
    vec3 result = vec3(1);
    bool goes_on = t < f.t_end;
    do {
        const uvec4 words = draw_random(p, BLOCK_SHADOW + step);
        if (tau == 0.0) tau = exponential_variate(words.x);
        const bool collides = goes_on && next_collision(f, tau, t, bound);
        if (collides) {
            const Tap tap = tap_field(medium, f, t, unit_float(words.y));
            const vec3 ratio = (tap.sigma_a + tap.sigma_s) / bound;
            worst_ratio = max(worst_ratio, max(ratio.x, max(ratio.y, ratio.z)));
            result *= max(1.0 - ratio, 0.0); // rounding: beyond 1
            const float most = max(result.x, max(result.y, result.z));
            if (most < SHADOW_ROULETTE)
                result *=
                    unit_float(words.z) * SHADOW_ROULETTE < most ? SHADOW_ROULETTE / most : 0.0;
            tau = 0.0;
            ++steps_walked;
        }
        const bool pauses = !collides && t < f.t_end; // in the middle of a flight
        step += pauses ? 0u : 1u;
        if (goes_on && t < f.t_end && steps_walked > STEPS_MAX) {
            note_mishap(HEALTH_EVENT_LIMIT, true);
            result = vec3(0);
        }
        goes_on = goes_on && t < f.t_end && max(result.x, max(result.y, result.z)) > 0.0;
    } while (goes_on);
    return result;
}

/// Length of homogeneous medium of density 1 that equals the line up to t; t itself in a
/// homogeneous medium.
float column_length(Medium medium, vec3 origin, vec3 direction, float t) {
    if ((densities & DENSITY_BIT_PLANE) == 0u || medium.density_kind != DENSITY_PLANE) return t;
    const ExponentialRecord e = load_exponential(medium.density_record);
    const float height = dot(e.up, transform_point(e.medium_from_render, origin) - e.origin);
    const float rise = dot(e.up, transform_vector(e.medium_from_render, direction));
    return exponential_column(height, rise, e.scale_height, t);
}

/// The distance at which column_length is `column`.
float distance_of_column(Medium medium, vec3 origin, vec3 direction, float column) {
    if ((densities & DENSITY_BIT_PLANE) == 0u || medium.density_kind != DENSITY_PLANE)
        return column;
    const ExponentialRecord e = load_exponential(medium.density_record);
    const float height = dot(e.up, transform_point(e.medium_from_render, origin) - e.origin);
    const float rise = dot(e.up, transform_vector(e.medium_from_render, direction));
    return exponential_column_inverse(height, rise, e.scale_height, column);
}

bool is_tracked(Medium medium) {
    return (densities & DENSITY_BITS_TRACKED) != 0u &&
           (has_closed_media == 0u || medium.density_kind == DENSITY_GRID ||
            medium.density_kind == DENSITY_SPHERE);
}

/// Whether a stage of its own takes paths through the medium: track_medium, or march_medium.
bool is_carried(Medium medium) {
    return is_tracked(medium) || (march != MARCH_NONE && !is_black(medium.sigma_s));
}

#endif

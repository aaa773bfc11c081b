// The paths in flight: their state, how samples begin and end, and how slots take up work.
#ifndef TYNDALL_PATH_GLSL
#define TYNDALL_PATH_GLSL

#include "lib/camera.glsl"
#include "wavefront/scene.glsl"

#define STATUS_NEW 0u      // has never had a ticket (state starts as zeros)
#define STATUS_WAITING 1u  // its ticket is not yet due
#define STATUS_RAY 2u      // has a ray to trace
#define STATUS_ENDED 3u    // its path has ended
#define STATUS_TRACKING 4u // is on its way through a medium (track_medium)

struct Path {
    vec3 origin;
    uint medium;
    uint status;
    uint hero; ///< Channel that samples flights.
    vec3 direction;
    uint event; ///< Index for random numbers (shared/random.h).
    vec3 throughput;
    uint depth;    ///< Scattering events so far.
    vec3 radiance; ///< So far, of the path.
    float pdf; ///< Of the last direction, per steradian; 0: none, or none that lights could match.
    uvec2 xy;  ///< Pixel in the picture.
    uint stream; ///< Index of the pixel in the picture, for random numbers.
    uint path_sample;
    uint batch_end;
    float weight; ///< Of the pixel filter: 1 or -1.
    vec4 sum;     ///< Over the samples of the batch: weight * radiance, weight.
    uint ticket;
    uint pixel; ///< In the rendered bounds.
    uint window_slot;
    vec3 r; ///< Spectral ratios (lib/medium.glsl).
};

void load_ray(uint slot, inout Path p) {
    const uvec4 a = load_path(PATH_ORIGIN, slot);
    const uvec4 b = load_path(PATH_DIRECTION, slot);
    p.origin = floats(a);
    p.medium = a.w & 0xFFFFu;
    p.status = a.w >> 16 & 0xFu;
    p.hero = a.w >> 20 & 3u;
    p.direction = floats(b);
    p.event = b.w;
}
void store_origin(uint slot, Path p) {
    store_path(PATH_ORIGIN, slot,
               uvec4(floatBitsToUint(p.origin), p.medium | p.status << 16 | p.hero << 20));
}
void store_direction(uint slot, Path p) {
    store_path(PATH_DIRECTION, slot, uvec4(floatBitsToUint(p.direction), p.event));
}

void load_throughput(uint slot, inout Path p) {
    const uvec4 a = load_path(PATH_THROUGHPUT, slot);
    p.throughput = colour(floats(a));
    p.depth = a.w;
    p.r = is_chromatic != 0u ? floats(load_path(PATH_SPECTRAL, slot)) : vec3(1);
}
void store_throughput(uint slot, Path p) {
    store_path(PATH_THROUGHPUT, slot, uvec4(floatBitsToUint(p.throughput), p.depth));
    if (is_chromatic != 0u) store_path(PATH_SPECTRAL, slot, floatBitsToUint(vec4(p.r, 0)));
}

void load_radiance(uint slot, inout Path p) {
    const uvec4 a = load_path(PATH_RADIANCE, slot);
    p.radiance = colour(floats(a));
    p.pdf = uintBitsToFloat(a.w);
}
void store_radiance(uint slot, Path p) {
    store_path(PATH_RADIANCE, slot, floatBitsToUint(vec4(p.radiance, p.pdf)));
}

void load_sample(uint slot, inout Path p) {
    const uvec4 a = load_path(PATH_SAMPLE, slot);
    p.xy = uvec2(a.x & 0xFFFFu, a.x >> 16);
    p.stream = p.xy.y * push.full_width + p.xy.x;
    p.path_sample = a.y;
    p.batch_end = a.z;
    p.weight = uintBitsToFloat(a.w);
}
void store_sample(uint slot, Path p) {
    store_path(PATH_SAMPLE, slot,
               uvec4(p.xy.x | p.xy.y << 16, p.path_sample, p.batch_end, floatBitsToUint(p.weight)));
}

void load_batch_state(uint slot, inout Path p) {
    const uvec4 a = load_path(PATH_TICKET, slot);
    p.sum = uintBitsToFloat(load_path(PATH_SUM, slot));
    p.sum.xyz = colour(p.sum.xyz);
    p.ticket = a.x;
    p.pixel = a.y;
    p.window_slot = a.z;
}
void store_batch_state(uint slot, Path p) {
    store_path(PATH_SUM, slot, floatBitsToUint(p.sum));
    store_path(PATH_TICKET, slot, uvec4(p.ticket, p.pixel, p.window_slot, 0u));
}

// Push constants that loops need, read once a kernel: a driver cannot know that stores leave them
// alone.
uvec2 seed = push.seed;
uint max_depth = push.max_depth;

/// The four random words of a block of the path's present event.
uvec4 draw(Path p, uint block) {
    return random_block(seed, p.stream, p.path_sample, p.event, block);
}

/// Starts the path of the present sample at the camera.
void begin_sample(inout Path p, CameraRecord camera) {
    p.event = 0u;
    const uvec4 words = draw(p, BLOCK_PATH);
    const float u = unit_float(words.x), v = unit_float(words.y);
    const vec2 radius = vec2(camera.filter_x_radius, camera.filter_y_radius);
    vec2 offset;
    p.weight = 1.0;
    if (filter_kind == FILTER_BOX) {
        offset = (2.0 * vec2(u, v) - 1.0) * radius;
    } else if (filter_kind == FILTER_TRIANGLE) {
        offset = vec2(sample_triangle_filter(radius.x, u), sample_triangle_filter(radius.y, v));
    } else {
        float sign_x, sign_y;
        const uint cells = camera.filter_cells;
        offset.x = sample_filter_table(push.filter_table, cells, radius.x, u, sign_x);
        offset.y = sample_filter_table(push.filter_table + cells + 1u, cells, radius.y, v, sign_y);
        p.weight = sign_x * sign_y;
    }
    camera_ray(camera, vec2(p.xy) + 0.5 + offset, vec2(unit_float(words.z), unit_float(words.w)),
               p.origin, p.direction);
    p.medium = has_media != 0u ? camera.medium : VACUUM;
    p.hero = 0u;
    if (is_chromatic != 0u) p.hero = min(2u, uint(3.0 * unit_float(draw(p, BLOCK_LIGHT).x)));
    p.status = STATUS_RAY;
    p.event = 1u;
    p.throughput = vec3(1);
    p.pdf = 0.0;
    p.radiance = vec3(0);
    p.depth = 0u;
    p.r = vec3(1);
}

uvec3 mishaps = uvec3(0); ///< What went wrong in this invocation, by kind of health counter.

/// Adds what went wrong to the health counters. Once an invocation: atomics do not belong into
/// loops.
void report_health() {
    for (int kind = 0; kind < HEALTH_COUNT; ++kind)
        if (mishaps[kind] > 0u) atomicAdd(control.health[kind], mishaps[kind]);
}

/// Adds the ended path to the sum of its batch. What is not a radiance is dropped, and counted.
void finish_sample(inout Path p, CameraRecord camera) {
    vec3 radiance = p.radiance * camera.exposure;
    const float least = min(min(radiance.x, radiance.y), radiance.z);
    const float most = max(max(radiance.x, radiance.y), radiance.z);
    const float total = radiance.x + radiance.y + radiance.z;
    const bool is_finite = abs(total) <= FLOAT_MAX; // false for NaN too
    const bool is_negative = is_finite && least < 0.0;
    mishaps += uvec3(is_finite ? 0u : 1u, is_negative ? 1u : 0u, 0u);
    if (!is_finite || is_negative) radiance = vec3(0);
    if (has_clamp != 0u && most > camera.clamp) radiance *= camera.clamp / most;
    p.sum += vec4(p.weight * radiance, p.weight);
    ++p.path_sample;
}

/// Sets the path to the first sample of its ticket's batch, if the ticket is due.
void start_ticket(inout Path p) {
    if (p.ticket >= control.ticket_limit) {
        p.status = STATUS_WAITING;
        return;
    }
    const uint batch = p.ticket / push.pixel_count;
    p.pixel = p.ticket - batch * push.pixel_count;
    p.window_slot = batch % push.window;
    const uint row = p.pixel / push.width;
    p.xy = uvec2(push.x0 + p.pixel - row * push.width, push.y0 + row);
    p.stream = p.xy.y * push.full_width + p.xy.x;
    p.path_sample = max(push.first_sample, batch_first_sample(push.first_batch + batch));
    p.batch_end = min(push.end_sample, batch_first_sample(push.first_batch + batch + 1u));
    p.sum = vec4(0);
    p.status = STATUS_ENDED;
}

/// Hands over the sum of the batch.
void finish_batch(inout Path p) {
    store_batch(p.window_slot * push.pixel_count + p.pixel, p.sum);
    atomicAdd(control.finished[p.window_slot], 1u);
}

/// Gives a slot without a path its next batch of samples, if one is due: afterwards its status is
/// STATUS_ENDED with no sample done, or STATUS_WAITING.
void take_work(inout Path p) {
    if (p.status == STATUS_ENDED) finish_batch(p);
    if (p.status != STATUS_WAITING) p.ticket = atomicAdd(control.next_ticket, 1u);
    start_ticket(p);
}

/// Whether all samples of the batch are done (or there is no batch).
bool needs_work(Path p) {
    return p.status != STATUS_RAY && (p.status != STATUS_ENDED || p.path_sample == p.batch_end);
}

#endif

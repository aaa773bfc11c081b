// The paths in flight: their state, how samples begin and end, and how slots take up work.
#ifndef TYNDALL_PATH_GLSL
#define TYNDALL_PATH_GLSL

#include "lib/camera.glsl"
#include "wavefront/event_log.glsl"
#include "wavefront/health.glsl"
#include "wavefront/scene.glsl"
#include "wavefront/slots.glsl"

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
    uint stream; ///< The pixel in the picture, for random numbers: pixel_stream.
    uint path_sample;
    uint piece_end;
    float weight; ///< Of the pixel filter: 1 or -1.
    vec4 sum;     ///< Over the samples of the piece: weight * radiance, weight.
    uint ticket;
    uint pixel; ///< In the rendered bounds.
    uint window_slot;
    vec3 r; ///< Spectral ratios (lib/medium.glsl).
};

/// Logs the path as it arrives at a place.
void log_path(uint kind, Path p, vec3 position, uint shape) {
    log_event(kind, p.event, position, p.direction, p.medium, p.throughput, p.radiance, shape);
}
void log_path(uint kind, Path p) {
    log_path(kind, p, p.origin, NONE);
}
/// Logs what a light adds to the radiance of the path.
void log_light(Path p, vec3 origin, vec3 direction, uint medium, vec3 added) {
    log_event(EVENT_LIGHT, p.event, origin, direction, medium, added, p.radiance, NONE);
}

void load_ray(uint slot, inout Path p) {
    const uvec4 a = load_path(PATH_ORIGIN, slot);
    const uvec4 b = load_path(PATH_DIRECTION, slot);
    p.origin = floats(a);
    p.medium = a.w & 0xFFFFu;
    p.status = a.w >> 16 & 0xFu;
    p.hero = a.w >> 20 & 3u;
    mishaps = a.w >> 22;
    p.direction = floats(b);
    p.event = b.w;
}
uint medium_word(Path p) {
    return p.medium | p.status << 16 | p.hero << 20 | mishaps << 22;
}
void store_origin(uint slot, Path p) {
    store_path(PATH_ORIGIN, slot, uvec4(floatBitsToUint(p.origin), medium_word(p)));
}
/// What of origin and direction changes where a path goes straight on.
void store_progress(uint slot, Path p) {
    store_path_word(PATH_ORIGIN, 3u, slot, medium_word(p));
    store_path_word(PATH_DIRECTION, 3u, slot, p.event);
}
void store_direction(uint slot, Path p) {
    store_path(PATH_DIRECTION, slot, uvec4(floatBitsToUint(p.direction), p.event));
}

/// A colour and a word; of a grey one only what load_* reads.
void store_colour(uint group, uint slot, vec3 rgb, uint word) {
    if (is_grey != 0u) {
        store_path_word(group, 0u, slot, floatBitsToUint(rgb.x));
        store_path_word(group, 3u, slot, word);
    } else {
        store_path(group, slot, uvec4(floatBitsToUint(rgb), word));
    }
}

void load_throughput(uint slot, inout Path p) {
    const uvec4 a = load_path(PATH_THROUGHPUT, slot);
    p.throughput = colour(floats(a));
    p.depth = a.w;
    p.r = is_chromatic != 0u ? floats(load_path(PATH_SPECTRAL, slot)) : vec3(1);
}
void store_throughput(uint slot, Path p) {
    store_colour(PATH_THROUGHPUT, slot, p.throughput, p.depth);
    if (is_chromatic != 0u) store_path(PATH_SPECTRAL, slot, floatBitsToUint(vec4(p.r, 0)));
}

void load_radiance(uint slot, inout Path p) {
    const uvec4 a = load_path(PATH_RADIANCE, slot);
    p.radiance = colour(floats(a));
    p.pdf = uintBitsToFloat(a.w);
}
void store_radiance(uint slot, Path p) {
    store_colour(PATH_RADIANCE, slot, p.radiance, floatBitsToUint(p.pdf));
}

/// What tells the random numbers of a pixel from those of others.
uint pixel_stream(uvec2 xy) {
    if (sampler_kind == SAMPLER_ZSOBOL) return morton_code(xy.x, xy.y);
    return xy.y * push.full_width + xy.x;
}

void load_sample(uint slot, inout Path p) {
    const uvec4 a = load_path(PATH_SAMPLE, slot);
    p.xy = uvec2(a.x & 0xFFFFu, a.x >> 16);
    p.stream = pixel_stream(p.xy);
    p.path_sample = a.y;
    p.piece_end = a.z;
    p.weight = filter_kind == FILTER_TABLE ? uintBitsToFloat(a.w) : 1.0;
}
void store_sample(uint slot, Path p) {
    store_path(PATH_SAMPLE, slot,
               uvec4(p.xy.x | p.xy.y << 16, p.path_sample, p.piece_end, floatBitsToUint(p.weight)));
}
/// What changes from sample to sample of a piece.
void store_next_sample(uint slot, Path p) {
    store_path_word(PATH_SAMPLE, 1u, slot, p.path_sample);
    if (filter_kind == FILTER_TABLE)
        store_path_word(PATH_SAMPLE, 3u, slot, floatBitsToUint(p.weight));
    store_colour(PATH_SUM, slot, p.sum.xyz, floatBitsToUint(p.sum.w));
}

void load_piece_state(uint slot, inout Path p) {
    const uvec4 a = load_path(PATH_TICKET, slot);
    p.sum = uintBitsToFloat(load_path(PATH_SUM, slot));
    p.sum.xyz = colour(p.sum.xyz);
    p.ticket = a.x;
    p.pixel = a.y;
    p.window_slot = a.z;
}
void store_ticket(uint slot, Path p) {
    store_path(PATH_TICKET, slot, uvec4(p.ticket, p.pixel, p.window_slot, 0u));
}

// Push constants that loops need, read once a kernel: a driver cannot know that stores leave them
// alone.
uvec2 seed = push.seed;
uint max_depth = min(push.max_depth, event_limit); // each scattering is an event
bool depth_is_cut = push.max_depth > event_limit;  // by no wish of the scene
float roulette_scale = push.roulette_scale;

/// The four random words of a block of the path's present event, whichever the sampler.
uvec4 draw_random(Path p, uint block) {
    return random_block(seed, p.stream, p.path_sample, p.event, block);
}
/// Those of BLOCK_PATH or BLOCK_LIGHT of an event, by the sampler.
uvec4 draw(Path p, uint event, uint block) {
    if (sampler_kind == SAMPLER_INDEPENDENT)
        return random_block(seed, p.stream, p.path_sample, event, block);
    if (sampler_kind == SAMPLER_ZSOBOL)
        return zsobol_block(seed, p.stream, p.path_sample, event, block, zsobol_bits);
    return sobol_block(seed, p.stream, p.path_sample, event, block);
}
uvec4 draw(Path p, uint block) {
    return draw(p, p.event, block);
}

/// Starts the path of the present sample at the camera, by the words of event 0.
void begin_sample(inout Path p, CameraRecord camera, uvec4 words) {
    p.event = 0u;
    if (sampler_kind != SAMPLER_INDEPENDENT) words = pairs_in_order(words);
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
    p.throughput = vec3(1);
    p.pdf = 0.0;
    p.radiance = vec3(0);
    p.depth = 0u;
    p.r = vec3(1);
    log_path(EVENT_CAMERA, p);
    p.event = 1u;
}

/// Adds light that the path brings to the camera: all that paths contribute comes through here.
void contribute(inout Path p, vec3 light) {
    p.radiance += light;
}

/// Whether the path may fly another segment: it has a direction, and events left.
bool can_go_on(Path p) {
    return p.event < event_limit && is_unit(p.direction);
}

/// Ends a path that cannot go on.
void lose(inout Path p) {
    note_mishap(HEALTH_EVENT_LIMIT, p.event >= event_limit);
    log_path(EVENT_LOST, p);
    p.status = STATUS_ENDED;
}

bool is_radiance(vec3 v) {
    const float least = is_grey != 0u ? v.x : min(min(v.x, v.y), v.z);
    const float sum = is_grey != 0u ? v.x : v.x + v.y + v.z;
    return least >= 0.0 && sum <= FLOAT_MAX; // false for NaN
}

/// Adds the ended path to the sum of its piece; as black if what it has is no radiance, or if it
/// went nowhere.
void finish_sample(inout Path p, CameraRecord camera) {
    vec3 radiance = p.radiance * camera.exposure;
    const bool is_sound = is_radiance(radiance) && is_unit(p.direction);
    note_mishap(HEALTH_DROPPED, !is_sound);
    radiance = is_sound ? radiance : vec3(0);
    const float most = max(max(radiance.x, radiance.y), radiance.z);
    if (has_clamp != 0u && most > camera.clamp) radiance *= camera.clamp / most;
    p.sum += vec4(p.weight * radiance, p.weight);
    ++p.path_sample;
}

/// Whether anything went wrong with a path that finish_sample has ended.
bool is_for_report(Path p) {
    return p.status == STATUS_ENDED && mishaps != 0u;
}

/// Counts what went wrong with such a path.
void report_path(Path p, CameraRecord camera) {
    mishaps &= ~(1u << HEALTH_DROPPED);
    const vec3 radiance = p.radiance * camera.exposure;
    const bool is_finite = abs(radiance.x + radiance.y + radiance.z) <= FLOAT_MAX;
    note_mishap(HEALTH_NONFINITE, !is_finite);
    note_mishap(HEALTH_NEGATIVE, is_finite && !is_radiance(radiance));
    note_mishap(HEALTH_DIRECTION, !is_unit(p.direction));
    report_mishaps(p.xy, p.path_sample - 1u, p.throughput);
}

/// n / d and the remainder, exactly, for n below 2^31 and d below 2^30: by floats, because CPU
/// drivers divide integers one lane at a time.
uint divide(uint n, uint d, out uint remainder) {
    const float inverse = 1.0 / float(d);
    uint quotient = uint(float(n) * inverse);                             // off by up to 2^9
    quotient += uint(int(floor(float(int(n - quotient * d)) * inverse))); // off by up to 1
    const int rest = int(n - quotient * d);
    const int correction = rest < 0 ? -1 : rest >= int(d) ? 1 : 0;
    remainder = uint(rest - correction * int(d));
    return quotient + uint(correction);
}

/// Whether the ticket may be worked on.
bool is_due(uint ticket) {
    return ticket < control.ticket_limit;
}

/// Sets the path to the first sample of its ticket's piece, if the ticket is due.
void start_ticket(inout Path p) {
    if (!is_due(p.ticket)) {
        p.status = STATUS_WAITING;
        return;
    }
    const uint piece = divide(p.ticket, push.pixel_count, p.pixel);
    p.window_slot = piece & (push.window - 1u);
    uint column;
    const uint row = divide(p.pixel, push.width, column);
    p.xy = uvec2(push.x0 + column, push.y0 + row);
    p.stream = pixel_stream(p.xy);
    const uint number = push.first_piece + piece,
               limit = piece_log2_limit(geometry == GEOMETRY_BVH);
    p.path_sample = max(push.first_sample, first_sample_of(number, limit));
    p.piece_end = min(push.end_sample, first_sample_of(number + 1u, limit));
    p.sum = vec4(0);
    p.status = STATUS_ENDED;
}

/// Hands over the sum of the piece.
void finish_piece(inout Path p) {
    store_piece(p.window_slot * push.pixel_count + p.pixel, p.sum);
    atomicAdd(control.finished[p.window_slot], 1u);
}

/// Gives a slot without a path its next piece of a batch, if one is due: afterwards its status is
/// STATUS_ENDED with no sample done, or STATUS_WAITING.
void take_work(inout Path p) {
    if (p.status == STATUS_ENDED) finish_piece(p);
    if (p.status != STATUS_WAITING) p.ticket = atomicAdd(control.next_ticket, 1u);
    start_ticket(p);
}

/// Whether all samples of the piece are done (or there is no piece).
bool needs_work(Path p) {
    return p.status != STATUS_RAY && (p.status != STATUS_ENDED || p.path_sample == p.piece_end);
}

#endif

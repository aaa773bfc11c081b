#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/interact.glsl"

// Runs whole paths of a scene without a hierarchy (GEOMETRY_NONE, _BOX, _ELLIPSOID): all that such
// a path needs stands in this stage, and each dispatch runs up to push.run_length events of every
// path.
//
//   ray -> ray, radiance

/// For a log, leaving is an event as it is where there is a hierarchy.
void log_exit(inout Path p, float t) {
    p.origin += t * p.direction;
    log_path(EVENT_INTERFACE, p);
    p.medium = VACUUM;
    ++p.event;
}

/// One segment and its end. Straight-line code: a CPU driver executes both sides of a branch
/// anyway.
void advance(inout Path p, Medium medium, vec3 environment) {
    bool inside = has_media != 0u && p.medium != VACUUM;
    if (geometry != GEOMETRY_NONE && !inside) {
        // The camera's ray, on its way in or past: what comes out again escapes.
        float near, far;
        if (intersect_region(p.origin, p.direction, near, far) && near > 0.0) {
            p.origin += near * p.direction;
            log_path(EVENT_INTERFACE, p);
            p.medium = region.medium;
            ++p.event;
            inside = true;
        }
    }
    const uvec4 words = draw(p, BLOCK_PATH);
    const float boundary =
        geometry == GEOMETRY_NONE ? INFINITY : region_exit(p.origin, p.direction);
    const float flight =
        has_collisions ? flight_distance(medium, p.hero, exponential_variate(words.x)) : INFINITY;
    const bool collided = inside && flight < boundary;
    const float t = min(flight, boundary);
    if (inside) travel(p, medium, t, collided);
    if (collided) {
        p.origin += t * p.direction;
        log_path(EVENT_COLLISION, p);
        if (p.status == STATUS_RAY && may_scatter(p)) {
            if (lights != 0u) {
                const LightSample light = light_in_medium(p, medium);
                const vec3 added = light.radiance * region_transmittance(p.origin, light.direction,
                                                                         light.distance, medium);
                contribute(p, added);
                if (!is_black(light.radiance))
                    log_light(p, p.origin, light.direction, p.medium, added);
            }
            scatter_in_medium(p, medium, words);
        }
    } else {
        if (log_capacity != 0u && geometry != GEOMETRY_NONE && inside) log_exit(p, t);
        if (has_environment != 0u) contribute(p, p.throughput * environment);
        log_path(EVENT_ESCAPE, p);
        p.status = STATUS_ENDED;
    }
    ++p.event;
}

/// In a grey scene: says so of what the loop carries, so that only one channel of it is computed.
void keep_channels(inout Path p) {
    p.throughput = colour(p.throughput);
    p.radiance = colour(p.radiance);
    p.sum.xyz = colour(p.sum.xyz);
}

/// A path to which something happened ends the work of its lane in this dispatch, so that it is
/// reported outside of the loops.
///
/// Taking up work is rare, but a CPU driver executes what stands in a loop for all lanes each time:
/// so it stands in an outer loop, and lanes that run out of samples wait for the end of the inner
/// one.
void main() {
    const uint slot = gl_GlobalInvocationID.x;
    if (slot >= push.slot_count) return;
    const uint chunk = 16u;
    const CameraRecord camera = load_camera();
    Medium medium;
    if (geometry != GEOMETRY_NONE) region = load_region();
    if (has_media != 0u)
        medium = load_medium(geometry == GEOMETRY_NONE ? camera.medium : region.medium);
    Path p;
    load_ray(slot, p);
    load_throughput(slot, p);
    load_radiance(slot, p);
    load_sample(slot, p);
    load_batch_state(slot, p);
    bool is_sound = true;
    for (uint done = 0u; done < push.run_length && is_sound; done += chunk) {
        if (needs_work(p)) take_work(p);
        if (p.status == STATUS_WAITING) break;
        for (uint i = 0u; i < chunk; ++i) {
            if (p.status == STATUS_ENDED) {
                if (p.path_sample == p.batch_end || !is_sound) break;
                begin_sample(p, camera);
            }
            keep_channels(p);
            advance(p, medium, camera.environment);
            if (p.status == STATUS_ENDED) is_sound = finish_sample(p, camera);
        }
    }
    if (!is_sound) report_path(p, camera);
    store_origin(slot, p);
    store_direction(slot, p);
    store_throughput(slot, p);
    store_radiance(slot, p);
    store_sample(slot, p);
    store_batch_state(slot, p);
}

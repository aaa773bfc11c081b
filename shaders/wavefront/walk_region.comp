#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/interact.glsl"

// Runs whole paths of a scene without a hierarchy (GEOMETRY_NONE, _BOX, _ELLIPSOID): all that such
// a path needs stands in this stage, and each dispatch runs up to push.run_length events of every
// path.
//
//   ray -> ray, radiance

/// Adds what a light gives to the path at a place in the region.
void add_light(inout Path p, vec3 place, Medium medium, LightSample light) {
    const vec3 added =
        light.radiance * region_transmittance(place, light.direction, light.distance, medium);
    contribute(p, added);
    if (!is_black(light.radiance)) log_light(p, place, light.direction, p.medium, added);
}

/// Scatters a path that collided at its origin, at t of its segment, in the light that reaches it
/// there.
void scatter(inout Path p, Medium medium, Segment segment, float t, uvec4 words) {
    if (lights != 0u) add_light(p, p.origin, medium, light_in_medium(p, medium, segment, t));
    scatter_in_medium(p, medium, words);
}

/// Looks for light on a segment that the path passes without a collision.
void look_in_passing(inout Path p, Medium medium, float t_end, uint word) {
    if (!looks_in_passing(p, medium, t_end, word)) return;
    Path at = p;
    const LightSample light = light_in_passing(at, medium, t_end);
    p.event |= EVENT_PASSING; // for the log
    add_light(p, at.origin, medium, light);
    p.event &= ~EVENT_PASSING;
}

/// Logs a crossing of the region's boundary, which is an event as it is where there is a hierarchy.
void cross_boundary(inout Path p, uint medium) {
    log_path(EVENT_INTERFACE, p);
    p.medium = medium;
    ++p.event;
}

/// Ends a path that left, or never came in: what leaves a convex region does not come back.
void escape(inout Path p, CameraRecord camera) {
    if (log_capacity != 0u && geometry != GEOMETRY_NONE && p.medium != VACUUM)
        cross_boundary(p, VACUUM);
    if (has_environment != 0u) contribute(p, p.throughput * camera.environment);
    log_path(EVENT_ESCAPE, p);
    p.status = STATUS_ENDED;
}

/// Begins a sample if one has ended, and flies a segment within the medium. All that in one go, of
/// which neither block of random numbers waits for what comes before: a CPU driver executes both
/// ways of each branch for all lanes, and what a turn takes is the longest chain through it.
void advance(inout Path p, CameraRecord camera, Medium medium) {
    const bool begins = p.status == STATUS_ENDED;
    const uint first_event = geometry == GEOMETRY_NONE ? 1u : 2u;
    const uvec4 words = draw(p, begins ? first_event : p.event, BLOCK_PATH);
    if (begins) {
        p.event = 0u;
        begin_sample(p, camera, draw(p, BLOCK_PATH));
    }
    p.status = STATUS_RAY; // of whoever gets here: said outside the branch, nothing waits for it
    if (has_emission == 0u && lights == 0u) p.radiance = vec3(0); // all of it comes at the end
    float near = 0.0, far = INFINITY;
    bool hits = has_media != 0u && p.medium != VACUUM;
    if (geometry != GEOMETRY_NONE) {
        hits = intersect_region(p.origin, p.direction, near, far) && (!begins || near > 0.0);
        if (begins && hits) {
            p.origin += near * p.direction;
            far -= near;
            cross_boundary(p, region.medium);
        }
    }
    const float boundary = hits ? max(0.0, far) : 0.0;
    const float flight =
        has_collisions ? flight_distance(medium, p.hero, exponential_variate(words.x)) : INFINITY;
    const bool collides = flight < boundary;
    const float t = min(flight, boundary);
    const Segment segment = segment_of(p, boundary);
    if (has_equiangular != 0u && hits && !collides) look_in_passing(p, medium, boundary, words.w);
    if (hits) travel(p, medium, t, collides);
    if (geometry != GEOMETRY_NONE || collides) p.origin += t * p.direction;
    if (collides) {
        log_path(EVENT_COLLISION, p);
        const bool is_absorbed = is_analog != 0u && p.status != STATUS_RAY;
        if (!is_absorbed && may_scatter(p)) scatter(p, medium, segment, t, words);
        ++p.event;
    }
    if (!collides) escape(p, camera); // no else: what neither way changes, it would select twice
}

/// Says what a turn of the loop leaves as it was, or to be set anew, so that the loop need not
/// carry it: a CPU driver does that by a masked store wherever a branch ends.
void keep_what_is_carried(inout Path p) {
    p.throughput = colour(p.throughput);
    p.radiance = colour(p.radiance);
    p.sum.xyz = colour(p.sum.xyz);
    if (is_chromatic == 0u) p.hero = 0u;
    if (!paths_find_lights()) p.pdf = 0.0;
    if (filter_kind != FILTER_TABLE) p.weight = 1.0;
    if (geometry != GEOMETRY_NONE) p.medium = region.medium;
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
    const uint chunk = 32u;
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
    load_piece_state(slot, p);
    for (uint done = 0u; done < push.run_length && !is_for_report(p); done += chunk) {
        if (needs_work(p)) take_work(p);
        if (p.status == STATUS_WAITING) break;
        for (uint i = 0u; i < chunk; ++i) {
            if (is_for_report(p) || (p.status == STATUS_ENDED && p.path_sample == p.piece_end))
                break;
            advance(p, camera, medium);
            keep_what_is_carried(p);
            if (p.status == STATUS_ENDED) finish_sample(p, camera);
        }
    }
    keep_what_is_carried(p);
    if (is_for_report(p)) report_path(p, camera);
    store_origin(slot, p);
    store_direction(slot, p);
    store_throughput(slot, p);
    store_radiance(slot, p);
    store_sample(slot, p);
    store_next_sample(slot, p);
    store_ticket(slot, p);
}

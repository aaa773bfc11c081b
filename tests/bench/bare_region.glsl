#ifndef TYNDALL_BARE_REGION_GLSL
#define TYNDALL_BARE_REGION_GLSL

#include "lib/phase.glsl"
#include "wavefront/path.glsl"

// The bar for walk_region: what is left of it if the program had been written for scenes such as
// homogeneous-cube alone. A grey homogeneous medium in a box and in even light, a pinhole, a box
// filter, independent numbers; no feature is asked for, and nothing more is carried along. How
// samples are handed out, and where state lies, is the wavefront's; and so is the watch over what
// can go wrong, if IS_WATCHED.
//
//   ray -> ray, radiance

void main() {
    const uint slot = gl_GlobalInvocationID.x;
    if (slot >= push.slot_count) return;
    const uint chunk = 32u;
    const CameraRecord camera = load_camera();
    const RegionRecord region = load_region();
    const Medium medium = load_medium(region.medium);
    const float sigma_a = medium.sigma_a.x, sigma_s = medium.sigma_s.x;
    Path p;
    load_ray(slot, p);
    load_throughput(slot, p);
    load_sample(slot, p);
    load_piece_state(slot, p);
    vec3 origin = p.origin, direction = p.direction;
    float throughput = p.throughput.x, sum = p.sum.x;
    for (uint done = 0u; done < push.run_length && !(IS_WATCHED && is_for_report(p));
         done += chunk) {
        if (needs_work(p)) {
            p.sum = vec4(sum, sum, sum, p.sum.w);
            take_work(p);
            sum = p.sum.x;
        }
        if (p.status == STATUS_WAITING) break;
        for (uint i = 0u; i < chunk; ++i) {
            const bool begins = p.status == STATUS_ENDED;
            if (begins && (p.path_sample == p.piece_end || (IS_WATCHED && mishaps != 0u))) break;
            const uint event = begins ? 2u : p.event;
            const uvec4 words = random_block(seed, p.stream, p.path_sample, event, BLOCK_PATH);
            if (begins) {
                const uvec4 first = random_block(seed, p.stream, p.path_sample, 0u, BLOCK_PATH);
                const vec2 radius = vec2(camera.filter_x_radius, camera.filter_y_radius);
                const vec2 at =
                    (2.0 * vec2(unit_float(first.x), unit_float(first.y)) - 1.0) * radius;
                const vec2 film = vec2(p.xy) + 0.5 + at;
                origin = camera.origin_0;
                direction = camera.direction_0 +
                            (film.x * camera.direction_x + film.y * camera.direction_y);
                direction *= inversesqrt(dot(direction, direction));
                throughput = 1.0;
                p.depth = 0u;
            }
            const vec3 inverse = 1.0 / mix(direction, vec3(1e-30), equal(direction, vec3(0)));
            const vec3 a = (region.lower - origin) * inverse;
            const vec3 b = (region.upper - origin) * inverse;
            const vec3 entry = min(a, b), exit = max(a, b);
            const float near = max(entry.x, max(entry.y, entry.z));
            float far = min(exit.x, min(exit.y, exit.z));
            const bool hits = near < far && (!begins || near > 0.0);
            if (begins && hits) {
                origin += near * direction;
                far -= near;
            }
            const float boundary = hits ? max(0.0, far) : 0.0;
            const float flight = exponential_variate(words.x) / sigma_s;
            const float t = min(flight, boundary);
            if (hits) throughput *= exp(-sigma_a * t);
            origin += t * direction;
            p.event = event + 1u;
            bool ends = flight >= boundary;
            float radiance = ends ? throughput * camera.environment.x : 0.0;
            if (!ends) {
                ends = p.depth == max_depth;
                if (IS_WATCHED) note_mishap(HEALTH_EVENT_LIMIT, ends && depth_is_cut);
                ++p.depth;
                const vec2 complements =
                    sample_hg_complements(medium.phase_parameter, unit_float(words.y));
                direction = deflect_by(direction, complements, unit_float(words.z));
                const float chance = max(roulette_scale * throughput, 0.25);
                if (chance < 1.0) {
                    ends = ends || unit_float(words.w) >= chance;
                    throughput /= chance;
                }
            }
            p.status = ends ? STATUS_ENDED : STATUS_RAY;
            if (ends) {
                radiance *= camera.exposure;
                if (IS_WATCHED) {
                    const bool is_sound = is_radiance(vec3(radiance)) && is_unit(direction);
                    note_mishap(HEALTH_DROPPED, !is_sound);
                    radiance = is_sound ? radiance : 0.0;
                }
                sum += radiance;
                p.sum.w += 1.0;
                ++p.path_sample;
            }
        }
    }
    p.origin = origin;
    p.direction = direction;
    p.throughput = vec3(throughput);
    p.sum = vec4(sum, sum, sum, p.sum.w);
    if (IS_WATCHED && is_for_report(p)) report_path(p, camera);
    store_origin(slot, p);
    store_direction(slot, p);
    store_throughput(slot, p);
    store_sample(slot, p);
    store_next_sample(slot, p);
    store_ticket(slot, p);
}

#endif

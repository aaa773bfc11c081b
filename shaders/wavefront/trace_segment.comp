#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/contact.glsl"

// Finds where the segment of each path ends: at the nearest surface, or before it by a collision in
// the medium (free flight).
//
//   ray -> VOLUME | SURFACE | INTERFACE | TRACK | ENDED queue, and EMITTER and PASSING queues

/// Whether light sampling has it for a light.
bool is_emitter(uint primitive) {
    const uint texel = push.primitives + primitive * PRIMITIVE_TEXELS;
    return primitive != NONE && fetch_scene(texel + 1u).w != NONE;
}

void main() {
    const uint slot = gl_GlobalInvocationID.x;
    if (slot >= push.slot_count) return;
    Path p;
    load_ray(slot, p);
    Hit hit = Hit(INFINITY, NONE, NONE);
    uint queue = p.status == STATUS_TRACKING ? QUEUE_TRACK
                                             : QUEUE_ENDED; // ENDED: waits for work, or escapes
    if (p.status == STATUS_WAITING && !is_due(load_path(PATH_TICKET, slot).x)) return;
    if (p.status == STATUS_RAY && can_go_on(p)) {
        hit = meet(p.origin, p.direction, INFINITY, false, NO_SKIP, p.medium);
        const Hit surface = hit;
        queue = queue_of_surface(hit.primitive);
        // Two ifs: the outer is of constants alone, and goes with what is in it.
        if (has_media != 0u && (has_collisions || densities != 0u)) {
            if (p.medium != VACUUM) {
                const Medium medium = load_medium(p.medium);
                if (has_closed_media == 0u || is_carried(medium)) {
                    queue = QUEUE_TRACK;
                } else if (march == MARCH_NONE) {
                    load_sample(slot, p);
                    const uvec4 words = draw(p, BLOCK_PATH);
                    const float column =
                        flight_distance(medium, p.hero, exponential_variate(words.x));
                    const float flight = distance_of_column(medium, p.origin, p.direction, column);
                    const bool collides = flight < hit.t;
                    if (!collides && looks_in_passing(p, medium, surface.t, words.w))
                        enqueue(QUEUE_PASSING, slot);
                    if (collides) {
                        hit.t = flight;
                        queue = QUEUE_VOLUME;
                    }
                }
            }
        }
        const bool emits = has_emitters != 0u && is_emitter(surface.primitive);
        const bool is_weighed = has_equiangular != 0u && queue == QUEUE_VOLUME; // passing.glsl
        if (emits) enqueue(QUEUE_EMITTER, slot);
        if (emits || is_weighed) store_path_word(PATH_TICKET, 3u, slot, floatBitsToUint(surface.t));
        store_path_word(PATH_HIT, 0u, slot, floatBitsToUint(hit.t));
        store_path_word(PATH_HIT, 1u, slot, hit.primitive);
        if ((primitives & PRIMITIVE_INSTANCES) != 0u)
            store_path_word(PATH_HIT, 2u, slot, hit.instance);
    }
    enqueue(queue, slot);
}

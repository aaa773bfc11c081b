#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/interact.glsl"

// Scatters paths that collided in a medium, or ends them.   VOLUME queue -> ray, SHADOW | ENDED
// queue

void main() {
    const uint slot = dequeue(QUEUE_VOLUME);
    if (slot == NONE) return;
    Path p;
    load_ray(slot, p);
    load_throughput(slot, p);
    load_radiance(slot, p);
    load_sample(slot, p);
    const float t = uintBitsToFloat(load_path(PATH_HIT, slot).x);
    const Medium medium = load_medium(p.medium);
    float reach = INFINITY;
    if (has_equiangular != 0u) reach = uintBitsToFloat(load_path(PATH_TICKET, slot).w);
    const Segment segment = segment_of(p, reach);
    travel(p, medium, t, true);
    p.origin += t * p.direction;
    log_path(EVENT_COLLISION, p);
    if (p.status == STATUS_RAY && may_scatter(p)) {
        if (lights != 0u)
            cast_shadow_ray(slot, p.origin, p.medium, light_in_medium(p, medium, segment, t));
        scatter_in_medium(p, medium, draw(p, BLOCK_PATH));
    }
    ++p.event;
    if (p.status == STATUS_ENDED) enqueue(QUEUE_ENDED, slot);
    store_origin(slot, p);
    store_direction(slot, p);
    store_throughput(slot, p);
    if (has_emission != 0u || has_emitters != 0u) store_radiance(slot, p);
    set_distance_before(slot, 0.0);
}

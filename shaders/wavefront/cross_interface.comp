#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/interact.glsl"

// Takes paths across boundaries between media, which cost nothing and count for nothing.
//
//   INTERFACE queue -> ray

void main() {
    const uint slot = dequeue(QUEUE_INTERFACE);
    if (slot == NONE) return;
    Path p;
    load_ray(slot, p);
    const uvec4 texel = load_path(PATH_HIT, slot);
    const Hit hit = Hit(uintBitsToFloat(texel.x), texel.y, texel.z);
    const SurfacePoint s = surface_point(p.origin, p.direction, hit);
    const ShapeRecord shape = load_shape(s.shape);
    const bool travels = has_closed_media != 0u && p.medium != VACUUM;
    if (travels || log_capacity != 0u) {
        load_throughput(slot, p);
        load_radiance(slot, p);
    }
    if (travels) {
        travel(p, load_medium(p.medium), hit.t, false);
        store_throughput(slot, p);
        if (has_emission != 0u) store_radiance(slot, p);
    }
    log_path(EVENT_INTERFACE, p, s.position, s.shape);
    p.origin = leave_surface(s, p.direction);
    p.medium = medium_beyond(shape, s, p.direction, p.medium);
    ++p.event;
    store_origin(slot, p);
    store_path_word(PATH_DIRECTION, 3u, slot, p.event);
    set_distance_before(slot, distance_travelled(slot, hit.t));
}

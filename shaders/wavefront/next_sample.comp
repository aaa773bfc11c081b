#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/interact.glsl"

// Ends paths and begins the next: light from infinity for those that escape, the sum of the piece,
// then the camera ray of the next sample. The last stage of a round: pending shadow rays have been
// traced.
//
//   ENDED queue -> ray, pieces

void escape(inout Path p, CameraRecord camera) {
    if (has_media != 0u && p.medium != VACUUM) travel(p, load_medium(p.medium), INFINITY, false);
    if (has_environment != 0u) contribute(p, p.throughput * camera.environment);
    log_path(EVENT_ESCAPE, p);
    p.status = STATUS_ENDED;
}

void main() {
    const uint slot = dequeue(QUEUE_ENDED);
    if (slot == NONE) return;
    const CameraRecord camera = load_camera();
    Path p;
    load_ray(slot, p);
    load_throughput(slot, p);
    load_radiance(slot, p);
    load_sample(slot, p);
    load_piece_state(slot, p);
    if (p.status == STATUS_RAY) {
        if (can_go_on(p))
            escape(p, camera);
        else
            lose(p);
    }
    if (p.status == STATUS_ENDED) finish_sample(p, camera);
    if (is_for_report(p)) report_path(p, camera);
    const bool takes_work = needs_work(p);
    if (takes_work) take_work(p);
    if (p.status == STATUS_ENDED) {
        p.event = 0u;
        begin_sample(p, camera, draw(p, BLOCK_PATH));
        store_direction(slot, p);
        store_throughput(slot, p);
        store_radiance(slot, p);
        set_distance_before(slot, 0.0);
    }
    store_origin(slot, p);
    if (takes_work) {
        store_sample(slot, p);
        store_ticket(slot, p);
    }
    store_next_sample(slot, p);
}

// What the stages that shade surfaces share: how a path arrives, what lights add, and how it
// leaves.
#ifndef TYNDALL_SURFACE_GLSL
#define TYNDALL_SURFACE_GLSL

#include "wavefront/interact.glsl"

/// Emission towards where the path came from, weighted against light sampling from its last vertex,
/// which is `distance` away.
vec3 emitted(Path p, SurfacePoint s, ShapeRecord shape, float distance) {
    if ((shape.flags & SHAPE_EMITS) == 0u) return vec3(0);
    if (!emits_towards((shape.flags & SHAPE_TWO_SIDED) != 0u, s.normal, -p.direction))
        return vec3(0);
    float mis = 1.0;
    if ((lights & LIGHTS_AREA) != 0u && p.pdf > 0.0) {
        const vec3 from = s.position - distance * p.direction;
        mis = power_heuristic(p.pdf, emitter_pdf(s.light, from, s.position, s.normal));
    }
    return mis * load_light(s.light).radiance;
}

/// Loads a path, takes it to the surface, and adds what the surface emits.
void arrive(uint slot, out Path p, out SurfacePoint s, out ShapeRecord shape) {
    load_ray(slot, p);
    load_throughput(slot, p);
    load_radiance(slot, p);
    load_sample(slot, p);
    const uvec4 texel = load_path(PATH_HIT, slot);
    const Hit hit = Hit(uintBitsToFloat(texel.x), texel.y, texel.z);
    s = surface_point(p.origin, p.direction, hit);
    note_mishap(HEALTH_COSINE, abs(dot(p.direction, s.shading)) > COSINE_MAX);
    shape = load_shape(s.shape);
    if (has_media != 0u) { // alone, so that it goes with what is in it
        if (p.medium != VACUUM) {
            const Medium medium = load_medium(p.medium);
            travel(p, medium, hit.t, false);
            if (has_emitters != 0u && is_tracked(medium))
                contribute(p, p.throughput * emitted(p, s, shape, distance_travelled(slot, hit.t)));
        }
    }
    log_path(EVENT_SURFACE, p, s.position, s.shape);
}

/// Sends off the shadow ray to a sampled light. `response` is the value of the BSDF times the
/// cosine for the light's direction, `pdf` the density with which the surface itself would have
/// drawn it.
void shade_light(uint slot, Path p, SurfacePoint s, ShapeRecord shape, LightSample light,
                 vec3 response, float pdf) {
    const float mis = light.pdf > 0.0 ? power_heuristic(light.pdf, pdf) : 1.0;
    light.radiance *= p.throughput * (response * mis);
    const vec3 origin = leave_surface(s, light.direction);
    light.distance -= dot(origin - s.position, light.direction); // see trace_shadow
    cast_shadow_ray(slot, origin, medium_beyond(shape, s, light.direction, p.medium), light);
}

/// Lets the path leave along a direction that was drawn with density `pdf`; 0: that lights could
/// not match.
void leave(inout Path p, SurfacePoint s, ShapeRecord shape, vec3 direction, float pdf) {
    p.direction = direction;
    p.pdf = pdf;
    p.origin = leave_surface(s, direction);
    p.medium = medium_beyond(shape, s, direction, p.medium);
}

/// Stores the path at the end of the event.
void depart(uint slot, inout Path p) {
    ++p.event;
    if (p.status == STATUS_ENDED) enqueue(QUEUE_ENDED, slot);
    store_origin(slot, p);
    store_direction(slot, p);
    store_throughput(slot, p);
    if (has_emission != 0u || has_emitters != 0u) store_radiance(slot, p);
    set_distance_before(slot, 0.0);
}

/// The frame of the shading normal, its z axis turned to the side that the path comes from.
mat3 frame_towards(SurfacePoint s, vec3 direction) {
    mat3 frame;
    make_frame(s.shading, frame[0], frame[1]);
    frame[2] = dot(direction, s.shading) > 0.0 ? -s.shading : s.shading;
    return frame;
}
/// Where the path comes from, in that frame: z >= 0.
vec3 towards_origin(mat3 frame, vec3 direction) {
    return -direction * frame;
}

#endif

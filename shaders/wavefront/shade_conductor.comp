#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/microfacet.glsl"
#include "wavefront/surface.glsl"

// Shades paths that stand at metal: emission, light sampling if it is rough, reflection. Two stages
// are built of it, by is_rough.
//
//   CONDUCTOR or ROUGH_CONDUCTOR queue -> ray, radiance, SHADOW | ENDED queue

void scatter_smooth(inout Path p, SurfacePoint s, ShapeRecord shape) {
    const vec3 up = dot(p.direction, s.shading) > 0.0 ? -s.shading : s.shading;
    const float c = clamp(-dot(p.direction, up), 0.0, 1.0);
    p.throughput *= fresnel_conductor(shape.eta, shape.k, c);
    leave(p, s, shape, reflect_about(-p.direction, up, c), 0.0);
}

void scatter_rough(uint slot, inout Path p, SurfacePoint s, ShapeRecord shape, uvec4 words) {
    const mat3 frame = frame_towards(s, p.direction);
    const vec3 wo = towards_origin(frame, p.direction);
    if (lights != 0u) {
        const LightSample light = sample_light(p, s.position, draw(p, BLOCK_LIGHT));
        float pdf;
        vec3 weight;
        evaluate_rough_conductor(shape.eta, shape.k, shape.alpha, wo, light.direction * frame, pdf,
                                 weight);
        shade_light(slot, p, s, shape, light, pdf * weight, pdf);
    }
    const vec2 u = vec2(unit_float(words.y), unit_float(words.z));
    vec3 wi, weight;
    float pdf;
    if (sample_rough_conductor(shape.eta, shape.k, shape.alpha, wo, u, wi, pdf, weight)) {
        p.throughput *= weight;
        leave(p, s, shape, normalize(frame * wi), pdf);
    } else {
        log_path(EVENT_ABSORBED, p);
        p.status = STATUS_ENDED;
    }
}

void main() {
    const uint slot = dequeue(is_rough != 0u ? QUEUE_ROUGH_CONDUCTOR : QUEUE_CONDUCTOR);
    if (slot == NONE) return;
    Path p;
    SurfacePoint s;
    ShapeRecord shape;
    arrive(slot, p, s, shape);
    if (may_scatter(p)) {
        const uvec4 words = draw(p, BLOCK_PATH);
        if (is_rough != 0u)
            scatter_rough(slot, p, s, shape, words);
        else
            scatter_smooth(p, s, shape);
        if (p.status != STATUS_ENDED) roulette(p, 1.0, words.w);
    }
    depart(slot, p);
}

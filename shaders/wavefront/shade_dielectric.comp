#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/microfacet.glsl"
#include "wavefront/surface.glsl"

// Shades paths that stand at the boundary of a dielectric: emission, light sampling if it is rough,
// reflection or refraction. Two stages are built of it, by is_rough.
//
//   DIELECTRIC or ROUGH_DIELECTRIC queue -> ray, radiance, SHADOW | ENDED queue

/// Where channels are refracted differently, the path goes on in its hero channel alone, of which
/// it is a fair sample: the others would have made it with the ratios r (lib/medium.glsl), and can
/// no more.
void disperse(inout Path p, vec3 eta) {
    if (has_dispersion == 0u || (eta.x == eta.y && eta.y == eta.z)) return;
    const vec3 hero = vec3(equal(uvec3(p.hero), uvec3(0u, 1u, 2u)));
    p.throughput *= 3.0 / p.r[p.hero] * hero;
    p.r = 3.0 * hero;
}

/// A mirror, or a window that bends. No light sampling finds what is seen through it.
void scatter_smooth(inout Path p, SurfacePoint s, ShapeRecord shape, float eta, float choice) {
    const float cosine = -dot(p.direction, s.shading);
    const bool is_thin = has_thin_panes != 0u && (shape.flags & SHAPE_THIN) != 0u;
    const Boundary boundary = make_boundary(eta, is_thin || cosine > 0.0);
    const vec3 up = cosine > 0.0 ? s.shading : -s.shading;
    const float c = min(abs(cosine), 1.0);
    const float reflected = is_thin ? fresnel_pane(boundary, c) : fresnel_dielectric(boundary, c);
    vec3 direction = p.direction;
    if (choice < reflected) {
        direction = reflect_about(-p.direction, up, c);
    } else if (!is_thin) {
        direction = refract_through(boundary, -p.direction, up, c);
        p.throughput /= boundary.eta * boundary.eta;
    }
    leave(p, s, shape, direction, 0.0);
}

/// Microfacets that are such windows.
void scatter_rough(uint slot, inout Path p, SurfacePoint s, ShapeRecord shape, float eta,
                   uvec4 words) {
    const mat3 frame = frame_towards(s, p.direction);
    const vec3 wo = towards_origin(frame, p.direction);
    const Boundary boundary = make_boundary(eta, dot(p.direction, s.shading) <= 0.0);
    const uvec4 light_words = draw(p, BLOCK_LIGHT);
    if (lights != 0u) {
        const LightSample light = sample_light(p, s.position, light_words);
        float pdf, weight;
        evaluate_rough_dielectric(boundary, shape.alpha, wo, light.direction * frame, pdf, weight);
        shade_light(slot, p, s, shape, light, vec3(pdf * weight), pdf);
    }
    const vec2 u = vec2(unit_float(words.y), unit_float(words.z));
    vec3 wi;
    float pdf, weight;
    if (sample_rough_dielectric(boundary, shape.alpha, wo, u, unit_float(light_words.w), wi, pdf,
                                weight)) {
        p.throughput *= weight;
        leave(p, s, shape, normalize(frame * wi), pdf);
    } else {
        log_path(EVENT_ABSORBED, p);
        p.status = STATUS_ENDED;
    }
}

void main() {
    const uint slot = dequeue(is_rough != 0u ? QUEUE_ROUGH_DIELECTRIC : QUEUE_DIELECTRIC);
    if (slot == NONE) return;
    Path p;
    SurfacePoint s;
    ShapeRecord shape;
    arrive(slot, p, s, shape);
    if (may_scatter(p)) {
        const uvec4 words = draw(p, BLOCK_PATH);
        disperse(p, shape.eta);
        const float eta = has_dispersion != 0u ? shape.eta[p.hero] : shape.eta.x;
        if (is_rough != 0u)
            scatter_rough(slot, p, s, shape, eta, words);
        else
            scatter_smooth(p, s, shape, eta, unit_float(draw(p, BLOCK_LIGHT).w));
        if (p.status != STATUS_ENDED) roulette(p, 1.0, words.w);
    }
    depart(slot, p);
}

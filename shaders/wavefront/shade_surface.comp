#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/interact.glsl"

// Shades paths that stand at a surface: emission, light sampling, the next direction.
//
//   SURFACE queue -> ray, radiance, SHADOW | ENDED queue

/// Emission towards where the path came from, weighted against light sampling from its last vertex,
/// which is `distance` away.
vec3 emitted(Path p, SurfacePoint s, ShapeRecord shape, float distance) {
    if ((shape.flags & SHAPE_EMITS) == 0u) return vec3(0);
    if (!emits_towards((shape.flags & SHAPE_TWO_SIDED) != 0u, s.normal, -p.direction))
        return vec3(0);
    float mis = 1.0;
    if (p.pdf > 0.0) {
        const vec3 from = s.position - distance * p.direction;
        mis = power_heuristic(p.pdf, emitter_pdf(s.light, from, s.position, s.normal));
    }
    return mis * load_light(s.light).radiance;
}

/// Lambert's law on both sides: albedo / pi on the side that the light comes from.
void scatter_diffuse(uint slot, inout Path p, SurfacePoint s, ShapeRecord shape, uvec4 words) {
    const vec3 up = dot(p.direction, s.shading) > 0.0 ? -s.shading : s.shading;
    p.throughput *= shape.reflectance;
    if (lights != 0u) {
        LightSample light = sample_light(s.position, draw(p, BLOCK_LIGHT));
        const float pdf = max(0.0, dot(light.direction, up)) / PI;
        const float mis = light.pdf > 0.0 ? power_heuristic(light.pdf, pdf) : 1.0;
        light.radiance *= p.throughput * (pdf * mis);
        cast_shadow_ray(slot, leave_surface(s, light.direction),
                        medium_beyond(shape, s, light.direction, p.medium), light);
    }
    const vec2 disk = sample_disk(unit_float(words.y), unit_float(words.z));
    const float cosine = sqrt(max(0.0, 1.0 - dot(disk, disk)));
    vec3 tangent, bitangent;
    make_frame(s.shading, tangent, bitangent);
    p.direction = normalize(disk.x * tangent + disk.y * bitangent + cosine * up);
    p.pdf = cosine / PI;
    p.origin = leave_surface(s, p.direction);
    p.medium = medium_beyond(shape, s, p.direction, p.medium);
    roulette(p, words.w);
}

void main() {
    const uint slot = dequeue(QUEUE_SURFACE);
    if (slot == NONE) return;
    Path p;
    load_ray(slot, p);
    load_throughput(slot, p);
    load_radiance(slot, p);
    load_sample(slot, p);
    const uvec4 texel = load_path(PATH_HIT, slot);
    const Hit hit = Hit(uintBitsToFloat(texel.x), texel.y, texel.z);
    const SurfacePoint s = surface_point(p.origin, p.direction, hit);
    const ShapeRecord shape = load_shape(s.shape);

    if (has_media != 0u && p.medium != VACUUM) travel(p, load_medium(p.medium), hit.t, false);
    if (has_emitters != 0u)
        p.radiance += p.throughput * emitted(p, s, shape, distance_travelled(slot, hit.t));
    if (may_scatter(p)) scatter_diffuse(slot, p, s, shape, draw(p, BLOCK_PATH));
    ++p.event;
    if (p.status == STATUS_ENDED) enqueue(QUEUE_ENDED, slot);
    store_origin(slot, p);
    store_direction(slot, p);
    store_throughput(slot, p);
    if (has_emission != 0u || has_emitters != 0u) store_radiance(slot, p);
    set_distance_before(slot, 0.0);
}

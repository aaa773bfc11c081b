#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/surface.glsl"

// Shades paths that stand at a diffuse surface: emission, light sampling, the next direction.
//
//   SURFACE queue -> ray, radiance, SHADOW | ENDED queue

/// Lambert's law on both sides: albedo / pi on the side that the light comes from.
void scatter(uint slot, inout Path p, SurfacePoint s, ShapeRecord shape, uvec4 words) {
    const mat3 frame = frame_towards(s, p.direction);
    p.throughput *= shape.reflectance;
    if (lights != 0u) {
        const LightSample light = sample_light(p, s.position, draw(p, BLOCK_LIGHT));
        const float pdf = max(0.0, dot(light.direction, frame[2])) / PI;
        shade_light(slot, p, s, shape, light, vec3(pdf), pdf);
    }
    const vec2 disk = sample_disk(unit_float(words.y), unit_float(words.z));
    const float cosine = sqrt(max(0.0, 1.0 - dot(disk, disk)));
    leave(p, s, shape, normalize(frame * vec3(disk, cosine)), cosine / PI);
    roulette(p, 1.0, words.w);
}

void main() {
    const uint slot = dequeue(QUEUE_SURFACE);
    if (slot == NONE) return;
    Path p;
    SurfacePoint s;
    ShapeRecord shape;
    arrive(slot, p, s, shape);
    if (may_scatter(p)) scatter(slot, p, s, shape, draw(p, BLOCK_PATH));
    depart(slot, p);
}

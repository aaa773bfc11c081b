#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/intersect.glsl"
#include "lib/phase.glsl"
#include "shared/bindings.h"
#include "shared/random.h"

// The bar for the wavefront: homogeneous-cube (scenes/homogeneous-cube.pbrt) in one kernel that
// knows nothing else. One invocation renders all samples of one pixel, lanes refilled in place;
// scene and camera are constants; no state leaves registers until the pixel is done. Estimator,
// random numbers and functions are the wavefront's own.

layout(local_size_x_id = 0) in;
layout(push_constant, std430) uniform Push {
    PushConstants push;
};
layout(binding = BINDING_FILM, rgba32ui) uniform uimageBuffer film_texels;

const float SIGMA_A = 0.5, SIGMA_S = 2.0, G = 0.5;
const float TAN_HALF_FOV = 0.34432761; // 38 degrees

void main() {
    const uint pixel = gl_GlobalInvocationID.x;
    if (pixel >= push.pixel_count) return;
    const vec2 xy = vec2(pixel % push.width, pixel / push.width);
    const float scale = 2.0 / float(push.width);
    float sum = 0.0, throughput = 0.0;
    vec3 origin = vec3(0), direction = vec3(0);
    uint path_sample = push.first_sample, event = 0u;
    bool alive = false;
    for (;;) {
        if (!alive) {
            if (path_sample == push.end_sample) break;
            const uvec4 words = random_block(push.seed, pixel, path_sample, 0u, BLOCK_PATH);
            const vec2 film = (xy + vec2(unit_float(words.x), unit_float(words.y))) * scale;
            direction =
                normalize(vec3(TAN_HALF_FOV * (film.x - 1.0), TAN_HALF_FOV * (1.0 - film.y), 1.0));
            const vec3 inverse = 1.0 / direction;
            const vec3 a = (vec3(-1, -1, 5)) * inverse, b = vec3(1, 1, 7) * inverse;
            const vec3 entry = min(a, b), exit = max(a, b);
            const float near = max(entry.x, max(entry.y, entry.z));
            ++path_sample;
            if (near >= min(exit.x, min(exit.y, exit.z))) {
                sum += 1.0;
                continue;
            }
            origin = near * direction;
            throughput = 1.0;
            event = 2u;
            alive = true;
        }
        const uvec4 words = random_block(push.seed, pixel, path_sample - 1u, event, BLOCK_PATH);
        const vec3 wall = mix(vec3(1, 1, 7), vec3(-1, -1, 5), lessThan(direction, vec3(0)));
        const vec3 t = (wall - origin) / direction;
        const float boundary = max(0.0, min(t.x, min(t.y, t.z)));
        const float flight = exponential_variate(words.x) / SIGMA_S;
        const float s = min(flight, boundary);
        throughput *= exp(-SIGMA_A * s);
        ++event;
        if (flight >= boundary) {
            sum += throughput;
            alive = false;
            continue;
        }
        origin += s * direction;
        const vec2 complements = sample_hg_complements(G, unit_float(words.y));
        direction = deflect_by(direction, complements, unit_float(words.z));
        if (throughput < 1.0 / 16.0) {
            alive = unit_float(words.w) >= 0.5;
            throughput *= 2.0;
        }
    }
    imageStore(film_texels, int(pixel * FILM_TEXELS),
               floatBitsToUint(vec4(vec3(sum), push.end_sample - push.first_sample)));
}

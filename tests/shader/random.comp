#version 460
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

// Random words, and the floats made of them.

void main() {
    if (is_idle()) return;
    const uint i = local_index();
    if (wanted() == 0u) { // philox(counter, key), number() rounds
        const uvec4 key = fetch_scene(2u * i + 1u);
        emit(i, philox(fetch_scene(2u * i), key.xy, int(number())));
    } else if (wanted() == 1u) { // random_block(seed; pixel, sample, event, block)
        const uvec4 at = fetch_scene(i);
        emit(i, random_block(push.seed, at.x, at.y, at.z, at.w));
    } else if (wanted() == 3u) { // sobol_block, likewise
        const uvec4 at = fetch_scene(i);
        emit(i, sobol_block(push.seed, at.x, at.y, at.z, at.w));
    } else {
        emit(i, vec4(unit_float(fetch_scene(i).x)));
    }
}

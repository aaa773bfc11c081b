#version 460
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

// The first samples of batches.

void main() {
    if (is_idle()) return;
    emit(local_index(), uvec4(batch_first_sample(global_index())));
}

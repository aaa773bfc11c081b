#version 460
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

// Sampling of the pixel filter: the table fills the input from texel 0 on, number() is the radius
// and push.shapes the number of cells.

void main() {
    if (is_idle()) return;
    const float u = float(global_index()) * (1.0 / 16777216.0);
    float filter_sign;
    const float x = sample_filter_table(0u, push.shapes, number(), u, filter_sign);
    emit(local_index(), vec4(x, filter_sign, u, 0));
}

#version 460
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

// The first samples of batches and pieces, and which of them samples are in.

void main() {
    if (is_idle()) return;
    const uint i = global_index(), limit = piece_log2_limit(true);
    emit(local_index(), uvec4(batch_first_sample(i), first_sample_of(i, limit),
                              number_of(i, BATCH_LOG2_LIMIT), number_of(i, limit)));
}

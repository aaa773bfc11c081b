#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/buffers.glsl"

// Folds complete batches into the film, in order.   batches -> film

/// Adds to a sum what rounding keeps out of it in `compensation` (Neumaier 1974).
void add_compensated(inout vec4 sum, inout vec4 compensation, vec4 value) {
    precise vec4 total = sum + value;
    precise vec4 lost_of_value = (sum - total) + value;
    precise vec4 lost_of_sum = (value - total) + sum;
    compensation += mix(lost_of_sum, lost_of_value, greaterThanEqual(abs(sum), abs(value)));
    sum = total;
}

void main() {
    const uint pixel = invocation();
    if (pixel >= push.pixel_count) return;
    const uint at = pixel * FILM_TEXELS;
    vec4 sum = load_film(at + FILM_SUM);
    vec4 compensation = load_film(at + FILM_COMPENSATION);
    vec4 residual = load_film(at + FILM_RESIDUAL);
    for (uint i = 0u; i < control.fold_count; ++i) {
        const uint batch = control.folded_batches + i;
        const vec4 value = load_batch((batch % push.window) * push.pixel_count + pixel);
        const uint first = batch_first_sample(push.first_batch + batch);
        const uint end = min(push.end_sample, batch_first_sample(push.first_batch + batch + 1u));
        const float before = float(first - min(first, push.first_sample));
        const float count = float(end - max(first, push.first_sample));
        const vec4 all = sum + compensation;
        // Of a filter with negative parts, the weights of a few samples can cancel: there is no
        // mean yet.
        if (before > 0.0 && all.w >= 0.5 * before) {
            // Welford's update by a batch of `count` samples after `before` samples, with the
            // residual of the ratio estimator sum(w L) / sum(w): for positive filters it is
            // Welford's exactly.
            const vec3 d = value.xyz - all.xyz * (value.w / all.w);
            residual.xyz += d * d * (before / (count * (before + count)));
        }
        add_compensated(sum, compensation, value);
    }
    store_film(at + FILM_SUM, sum);
    store_film(at + FILM_COMPENSATION, compensation);
    store_film(at + FILM_RESIDUAL, residual);
}

#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/buffers.glsl"

// Folds complete batches into the film, in order, and sums up what tells its error.
//
//   batches -> film

/// Adds to a sum what rounding keeps out of it in `compensation` (Neumaier 1974), which is kept
/// below the rounding of the sum (Dekker 1971): it would lose its own additions after 2^24 samples.
void add_compensated(inout vec4 sum, inout vec4 compensation, vec4 value) {
    precise vec4 total = sum + value;
    precise vec4 lost_of_value = (sum - total) + value;
    precise vec4 lost_of_sum = (value - total) + sum;
    compensation += mix(lost_of_sum, lost_of_value, greaterThanEqual(abs(sum), abs(value)));
    precise vec4 whole = total + compensation;
    precise vec4 rest = compensation - (whole - total);
    sum = whole;
    compensation = rest;
}

/// Root of the sum of squares, which may be out of range.
float hypotenuse(float a, float b) {
    const float larger = max(a, b), smaller = min(a, b);
    if (smaller == 0.0) return larger;
    const float ratio = smaller / larger;
    return larger * sqrt(1.0 + ratio * ratio);
}

/// Counts a single sample.
void count_sample(vec4 value) {
    if (value.w <= 0.0) return;
    const float luminance = max(dot(value.xyz, LUMINANCE) / value.w, 0.0);
    atomicAdd(control.sample_histogram[sample_bin(floatBitsToUint(luminance))], 1u);
}

/// The texels of one pixel.
struct FilmPixel {
    vec4 sum;
    vec4 compensation;
    vec4 residual;
    vec4 pair;
};

/// Sums over contrasts (ERROR_*).
struct BatchErrors {
    vec4 variances;
    vec4 covariances;
};

/// First sample of a batch, as far as they are rendered.
uint rendered_first_sample(uint batch) {
    return clamp(batch_first_sample(batch), push.first_sample, push.end_sample);
}

/// Of what is squared, so that it stays in range.
float film_unit = uintBitsToFloat(fetch_scene(MARCH_TEXEL).z);

/// Adds a batch to the pixel, and its contrast to the errors.
void fold(uint batch, vec4 value, inout FilmPixel film, inout BatchErrors errors) {
    const uint first = rendered_first_sample(batch);
    const float before = float(first - push.first_sample);
    const float count = float(rendered_first_sample(batch + 1u) - first);
    const vec4 all = film.sum + film.compensation;
    vec3 d = vec3(0);
    // Of a filter with negative parts, the weights of a few samples can cancel: there is no mean
    // yet.
    if (before > 0.0 && all.w >= 0.5 * before) {
        // Welford's update by a batch of `count` samples after `before` samples, with the residual
        // of the ratio estimator sum(w L) / sum(w): for positive filters it is Welford's exactly.
        d = (value.xyz - all.xyz * (value.w / all.w)) * film_unit;
        const float scale = before / (count * (before + count));
        const float weight = contrast_weight(batch, count);
        const vec3 squares = d * d * scale;
        const float square = squares.x + squares.y + squares.z;
        film.residual += vec4(squares, weight * square);
        errors.variances =
            vec4(errors.variances.xyz + weight * squares, hypotenuse(errors.variances.w, square));
        errors.covariances.xyz += weight * scale * (d.xxy * d.yzz);
        if ((batch & 1u) == 1u && float(first - rendered_first_sample(batch - 1u)) == count) {
            // The residual of the batch before, about the mean that this one has.
            const vec3 other = film.pair.xyz * ((before - count) / before);
            const float pair = dot(d - other, d - other) / (2.0 * count);
            film.pair.w += pair;
            errors.covariances.w = hypotenuse(errors.covariances.w, pair);
        }
    }
    film.pair.xyz = d;
    if (count == 1.0) count_sample(value);
    add_compensated(film.sum, film.compensation, value);
}

/// Loads a pixel.
FilmPixel load_pixel(uint at) {
    return FilmPixel(load_film(at + FILM_SUM), load_film(at + FILM_COMPENSATION),
                     load_film(at + FILM_RESIDUAL), load_film(at + FILM_PAIR));
}

void store_pixel(uint at, FilmPixel film) {
    store_film(at + FILM_SUM, film.sum);
    store_film(at + FILM_COMPENSATION, film.compensation);
    store_film(at + FILM_RESIDUAL, film.residual);
    store_film(at + FILM_PAIR, film.pair);
}

void main() {
    const uint lanes = fold_lanes(push.pixel_count);
    const uint lane = invocation();
    if (lane >= lanes) return;
    BatchErrors batch_errors = BatchErrors(vec4(0), vec4(0));
    vec4 pixel_errors = vec4(0);
    for (uint pixel = lane; pixel < push.pixel_count; pixel += lanes) {
        const uint at = pixel * FILM_TEXELS;
        FilmPixel film = load_pixel(at);
        for (uint i = 0u; i < control.fold_count; ++i) {
            const uint batch = control.folded_batches + i;
            fold(push.first_batch + batch,
                 load_batch((batch % push.window) * push.pixel_count + pixel), film, batch_errors);
        }
        store_pixel(at, film);
        if (film.sum.w == 0.0) continue;
        const vec3 mean = film.sum.xyz / film.sum.w * film_unit;
        const float weighted = film.residual.w;
        pixel_errors =
            vec4(pixel_errors.x + dot(mean, mean),
                 hypotenuse(pixel_errors.y, length(mean) * sqrt(weighted)),
                 hypotenuse(pixel_errors.z, weighted), hypotenuse(pixel_errors.w, film.pair.w));
    }
    const uint at = push.pixel_count * FILM_TEXELS + lane * ERROR_TEXELS;
    const vec4 variances = load_film(at + ERROR_VARIANCES);
    const vec4 covariances = load_film(at + ERROR_COVARIANCES);
    store_film(at + ERROR_VARIANCES, vec4(variances.xyz + batch_errors.variances.xyz,
                                          hypotenuse(variances.w, batch_errors.variances.w)));
    store_film(at + ERROR_COVARIANCES, vec4(covariances.xyz + batch_errors.covariances.xyz,
                                            hypotenuse(covariances.w, batch_errors.covariances.w)));
    store_film(at + ERROR_PIXELS, pixel_errors);
}

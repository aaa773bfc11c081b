#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/buffers.glsl"

// Folds pieces of batches into the film, in order: into the sum of their batch and, once that is
// whole, into the sum over all and into what tells its error.
//
//   pieces -> film

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
    vec4 batch;
};

/// Sums over contrasts (ERROR_*).
struct BatchErrors {
    vec4 variances;
    vec4 covariances;
};

// Push constants that loops need, read once.
uint first_sample = push.first_sample, end_sample = push.end_sample;
uint first_piece = push.first_piece, window_mask = push.window - 1u;
uint pixel_count = push.pixel_count;

/// First sample of a batch, as far as they are rendered.
uint rendered_first_sample(uint batch) {
    return clamp(batch_first_sample(batch), first_sample, end_sample);
}

/// Of what is squared, so that it stays in range.
float film_unit = uintBitsToFloat(fetch_scene(MARCH_TEXEL).z);

/// Adds a batch to the pixel, and its contrast to the errors.
void fold_batch(uint batch, vec4 value, inout FilmPixel film, inout BatchErrors errors) {
    const uint first = rendered_first_sample(batch);
    const float before = float(first - first_sample);
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

/// Adds the pieces that are due, and all batches that are whole with them. A batch at a time: a CPU
/// driver executes what stands in a loop whenever it goes round.
void fold(uint pixel, inout FilmPixel film, inout BatchErrors errors) {
    const uint limit = piece_log2_limit(geometry == GEOMETRY_BVH);
    const uint end = control.folded_pieces + control.fold_count;
    uint piece = control.folded_pieces;
    while (piece < end) {
        const uint batch = number_of(first_sample_of(first_piece + piece, limit), BATCH_LOG2_LIMIT);
        const uint batch_end = number_of(rendered_first_sample(batch + 1u) - 1u, limit) + 1u;
        const uint stop = min(end, batch_end - first_piece);
        for (; piece < stop; ++piece)
            film.batch += load_piece((piece & window_mask) * pixel_count + pixel);
        if (first_piece + piece == batch_end) {
            fold_batch(batch, film.batch, film, errors);
            film.batch = vec4(0);
        }
    }
}

/// Loads a pixel.
FilmPixel load_pixel(uint at) {
    return FilmPixel(load_film(at + FILM_SUM), load_film(at + FILM_COMPENSATION),
                     load_film(at + FILM_RESIDUAL), load_film(at + FILM_PAIR),
                     load_film(at + FILM_BATCH));
}

void store_pixel(uint at, FilmPixel film) {
    store_film(at + FILM_SUM, film.sum);
    store_film(at + FILM_COMPENSATION, film.compensation);
    store_film(at + FILM_RESIDUAL, film.residual);
    store_film(at + FILM_PAIR, film.pair);
    store_film(at + FILM_BATCH, film.batch);
}

void main() {
    const uint lanes = fold_lanes(push.pixel_count);
    const uint lane = invocation();
    if (lane >= lanes) return;
    BatchErrors batch_errors = BatchErrors(vec4(0), vec4(0));
    vec4 pixel_errors = vec4(0);
    for (uint pixel = lane; pixel < pixel_count; pixel += lanes) {
        const uint at = pixel * FILM_TEXELS;
        FilmPixel film = load_pixel(at);
        fold(pixel, film, batch_errors);
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

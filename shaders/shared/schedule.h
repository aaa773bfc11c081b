// Which samples form a batch. Batches are fixed ranges of sample indices: the film sums the samples
// of a batch in a fixed order and folds batches in order, which is what makes images bit-equal
// however the work was scheduled. Batches are also the independent estimates behind the stated
// error.
//
// Four batches of one sample, then two in each doubling of the sample count (2, 4, 8 ... samples
// long), up to batches of 64: any render has several, and a long one has few.
//
// What a slot works on at a time is a piece of a batch: samples that are summed in order from zero.
// Pieces are numbered as batches are, only that they grow no longer than a few samples where paths
// may take long; a batch is a row of them. At the end of a render slots wait for the last ones to
// finish what they took up, and a slot that waits costs as much as one that works.
#ifndef TYNDALL_SCHEDULE_H
#define TYNDALL_SCHEDULE_H

#include "interop.h"

TYNDALL_SHARED_BEGIN

TYNDALL_CONSTANT uint BATCH_LOG2_LIMIT = 6u;
TYNDALL_CONSTANT uint PIECE_LOG2_LIMIT = 2u; ///< Of paths through a hierarchy.

/// Index of the first sample of a batch or piece, of a kind that grows to 2^log2_limit samples.
TYNDALL_SHARED_INLINE uint first_sample_of(uint number, uint log2_limit) {
    if (number < 4u) return number;
    const uint octave = (number - 4u) / 2u;
    if (octave < log2_limit) return (4u << octave) + ((number & 1u) << (octave + 1u));
    const uint whole = 4u + 2u * log2_limit;
    return (4u << log2_limit) + ((number - whole) << log2_limit);
}

/// The inverse: the batch or piece that holds a sample.
TYNDALL_SHARED_INLINE uint number_of(uint sample_index, uint log2_limit) {
    if (sample_index < 4u) return sample_index;
    const uint octave = uint(findMSB(sample_index)) - 2u;
    if (octave < log2_limit)
        return 4u + 2u * octave + ((sample_index - (4u << octave)) >> (octave + 1u));
    return 4u + 2u * log2_limit + ((sample_index - (4u << log2_limit)) >> log2_limit);
}

TYNDALL_SHARED_INLINE uint batch_first_sample(uint batch) {
    return first_sample_of(batch, BATCH_LOG2_LIMIT);
}

/// For pieces. Where there is no hierarchy, paths are short, and lanes take up work seldom.
TYNDALL_SHARED_INLINE uint piece_log2_limit(bool has_hierarchy) {
    return has_hierarchy ? PIECE_LOG2_LIMIT : BATCH_LOG2_LIMIT;
}

/// Weight of the contrast of a batch of which so many samples are rendered: 1, and threefold from
/// each size of batches to the next; less for a last batch that is cut. Why, tells
/// stats/error_estimate.h.
TYNDALL_SHARED_INLINE float contrast_weight(uint batch, float count) {
    const float before = float(batch_first_sample(batch));
    const float whole = float(batch_first_sample(batch + 1u)) - before;
    float weight = 1.0f;
    for (float size = 1.0f; size < whole; size *= 2.0f)
        weight *= 3.0f;
    if (count < whole) weight *= count * (before - whole) / (whole * (before - count));
    return weight;
}

TYNDALL_SHARED_END

#endif

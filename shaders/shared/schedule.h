// Which samples form a batch. Batches are fixed ranges of sample indices: the film sums the samples
// of a batch in order from zero and folds batches in order, which is what makes images bit-equal
// however the work was scheduled. Batches are also the independent estimates behind the stated
// error.
//
// Four batches of one sample, then two in each doubling of the sample count (2, 4, 8 ... samples
// long), up to batches of 64: any render has several, and a long one has few.
#ifndef TYNDALL_SCHEDULE_H
#define TYNDALL_SCHEDULE_H

#include "interop.h"

TYNDALL_SHARED_BEGIN

TYNDALL_CONSTANT uint BATCH_LOG2_LIMIT = 6u;

/// Index of the first sample of a batch.
TYNDALL_SHARED_INLINE uint batch_first_sample(uint batch) {
    if (batch < 4u) return batch;
    const uint octave = (batch - 4u) / 2u;
    if (octave < BATCH_LOG2_LIMIT) return (4u << octave) + ((batch & 1u) << (octave + 1u));
    const uint whole = 4u + 2u * BATCH_LOG2_LIMIT;
    return (4u << BATCH_LOG2_LIMIT) + ((batch - whole) << BATCH_LOG2_LIMIT);
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

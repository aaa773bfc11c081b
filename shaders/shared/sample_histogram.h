// Bins of a histogram of samples by brightness: two for each power of two, over all positive
// floats. The film counts single samples in it, as long as batches are single samples; how heavy
// their tail is follows from the counts.
#ifndef TYNDALL_SAMPLE_HISTOGRAM_H
#define TYNDALL_SAMPLE_HISTOGRAM_H

#include "interop.h"

TYNDALL_SHARED_BEGIN

TYNDALL_CONSTANT uint SAMPLE_BINS = 512u;
TYNDALL_CONSTANT vec3 LUMINANCE = vec3(0.2126f, 0.7152f, 0.0722f); // of linear sRGB

/// Bin of a float that is not negative, by its bits: exponent and first bit of the mantissa. Bin 0
/// holds black (and what is next to it).
TYNDALL_SHARED_INLINE uint sample_bin(uint float_bits) {
    return float_bits >> 22u;
}

TYNDALL_SHARED_END

#endif

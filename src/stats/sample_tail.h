/// How heavy the tail of an image's samples is.
#pragma once

#include "shared/sample_histogram.h"

#include <array>
#include <cstdint>
#include <optional>

namespace tyndall::stats {

/// Counts of single samples by brightness (luminance); shared::sample_bin tells the bin.
using SampleHistogram = std::array<std::uint64_t, shared::SAMPLE_BINS>;

/// The share of the image that the brightest thousandth of its samples carry, in [0, 1]. None if
/// nothing was counted, or nothing but black. Bins are half an octave wide: right to about a tenth
/// of its value.
std::optional<double> tail_share(const SampleHistogram& counts);

/// From this share on, tails count as heavy: what an image still lacks may be in samples that are
/// too rare to have occurred, and intervals from those that have may be too narrow. Exponentially
/// distributed samples have a share of 0.8 %.
inline constexpr double kHeavyTailShare = 0.1;
inline bool is_heavy_tail(const std::optional<double>& share) {
    return share && *share > kHeavyTailShare;
}

} // namespace tyndall::stats

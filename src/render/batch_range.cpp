#include "render/batch_range.h"

#include "shared/schedule.h"

#include <algorithm>
#include <bit>

namespace tyndall {
namespace {

using shared::batch_first_sample;

/// The batch that holds the sample: the inverse of batch_first_sample.
std::uint32_t batch_of(std::uint32_t sample) {
    using shared::BATCH_LOG2_LIMIT;
    constexpr std::uint32_t first_whole = 4u << BATCH_LOG2_LIMIT;
    if (sample < 4) return sample;
    if (sample >= first_whole)
        return 4 + 2 * BATCH_LOG2_LIMIT + ((sample - first_whole) >> BATCH_LOG2_LIMIT);
    const auto octave = static_cast<std::uint32_t>(std::bit_width(sample)) - 3;
    return 4 + 2 * octave + ((sample - (4u << octave)) >> (octave + 1));
}

} // namespace

BatchRange::BatchRange(std::uint32_t first_sample, std::uint32_t end_sample)
    : first_sample_(first_sample), end_sample_(end_sample), first_(batch_of(first_sample)),
      end_(batch_of(end_sample - 1) + 1) {}

std::uint32_t BatchRange::samples_before(std::uint32_t batch) const {
    const std::uint32_t end = std::min(batch_first_sample(batch), end_sample_);
    return end > first_sample_ ? end - first_sample_ : 0;
}

std::uint32_t BatchRange::next_look(std::uint32_t batch) const {
    for (const std::uint32_t early : {2u, 4u, 8u})
        if (batch < first_ + early) return std::min(first_ + early, end_);
    const double wanted = first_sample_ + 1.1 * samples_before(batch);
    if (wanted >= end_sample_) return end_;
    return std::clamp(batch_of(static_cast<std::uint32_t>(wanted)) + 1, batch + 1, end_);
}

} // namespace tyndall

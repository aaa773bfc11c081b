#include "render/batch_range.h"

#include "shared/schedule.h"

#include <algorithm>

namespace tyndall {
namespace {

using shared::batch_first_sample;

/// The batch that holds the sample.
std::uint32_t batch_of(std::uint32_t sample) {
    std::uint32_t low = 0, high = sample + 1; // a batch has a sample at least
    while (high - low > 1) {
        const std::uint32_t middle = low + (high - low) / 2;
        (batch_first_sample(middle) <= sample ? low : high) = middle;
    }
    return low;
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

#include "render/batch_range.h"

#include <algorithm>

namespace tyndall {
namespace {

std::uint32_t batch_of(std::uint32_t sample) {
    return shared::number_of(sample, shared::BATCH_LOG2_LIMIT);
}

} // namespace

BatchRange::BatchRange(std::uint32_t first_sample, std::uint32_t end_sample,
                       std::uint32_t piece_log2_limit)
    : first_sample_(first_sample), end_sample_(end_sample), first_(batch_of(first_sample)),
      end_(batch_of(end_sample - 1) + 1), piece_log2_limit_(piece_log2_limit) {}

/// Of the samples before one, those that are in the range.
std::uint32_t BatchRange::rendered_before(std::uint32_t sample) const {
    return std::clamp(sample, first_sample_, end_sample_) - first_sample_;
}

std::uint32_t BatchRange::samples_before(std::uint32_t batch) const {
    return rendered_before(shared::batch_first_sample(batch));
}

std::uint32_t BatchRange::samples_before_piece(std::uint32_t piece) const {
    return rendered_before(shared::first_sample_of(piece, piece_log2_limit_));
}

std::uint32_t BatchRange::first_piece(std::uint32_t batch) const {
    const std::uint32_t sample = first_sample_ + samples_before(batch);
    if (sample == end_sample_) return shared::number_of(sample - 1, piece_log2_limit_) + 1;
    return shared::number_of(sample, piece_log2_limit_);
}

std::uint32_t BatchRange::next_look(std::uint32_t batch) const {
    for (const std::uint32_t early : {2u, 4u, 8u})
        if (batch < first_ + early) return std::min(first_ + early, end_);
    const double wanted = first_sample_ + 1.1 * samples_before(batch);
    if (wanted >= end_sample_) return end_;
    return std::clamp(batch_of(static_cast<std::uint32_t>(wanted)) + 1, batch + 1, end_);
}

} // namespace tyndall

/// The batches of a render of samples first <= s < end of each pixel: those of shared/schedule.h,
/// the first and the last of them cut if need be. Batches are numbered as there.
#pragma once

#include "shared/schedule.h"

#include <cstdint>

namespace tyndall {

class BatchRange {
  public:
    BatchRange() = default;
    /// first_sample < end_sample
    /// @param piece_log2_limit  Of the pieces that batches are worked on in.
    BatchRange(std::uint32_t first_sample, std::uint32_t end_sample,
               std::uint32_t piece_log2_limit = shared::BATCH_LOG2_LIMIT);

    std::uint32_t first() const { return first_; }
    std::uint32_t end() const { return end_; }
    /// Samples of the batches from the first on that are before `batch`.
    std::uint32_t samples_before(std::uint32_t batch) const;
    std::uint32_t samples_of(std::uint32_t batch) const {
        return samples_before(batch + 1) - samples_before(batch);
    }
    std::uint32_t samples_before_piece(std::uint32_t piece) const;
    /// The first piece of a batch; that which follows the last one, of end().
    std::uint32_t first_piece(std::uint32_t batch) const;
    /// Where to look at the film next, if the batches before `batch` are in it: with 2, 4 and 8
    /// batches, then whenever there are a tenth more samples. So there are few looks, and those who
    /// stop by what they see have few chances to be misled. The end, if there is nothing between.
    std::uint32_t next_look(std::uint32_t batch) const;

  private:
    std::uint32_t rendered_before(std::uint32_t sample) const;

    std::uint32_t first_sample_ = 0, end_sample_ = 0, first_ = 0, end_ = 0;
    std::uint32_t piece_log2_limit_ = shared::BATCH_LOG2_LIMIT;
};

} // namespace tyndall

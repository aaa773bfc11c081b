/// A film on the host, in double precision: what update_film.comp does on the device.
#pragma once

#include "image/image.h"
#include "stats/error_estimate.h"
#include "stats/sample_tail.h"

#include <glm/glm.hpp>
#include <vector>

namespace tyndall::stats {

class BatchFilm {
  public:
    /// Empty.
    explicit BatchFilm(std::size_t pixel_count = 0) : sums_(pixel_count), spreads_(pixel_count) {}

    /// Adds the next batch of the schedule (shared/schedule.h), the last of which may be cut: for
    /// each pixel, over `samples` samples, the sum of filter weight * radiance (xyz) and of filter
    /// weights (w).
    void fold(const std::vector<glm::dvec4>& batch, double samples);

    /// Samples per pixel folded.
    std::uint32_t samples() const { return static_cast<std::uint32_t>(contrasts_.samples); }
    /// Sums of everything folded, as in a batch.
    const std::vector<glm::dvec4>& sums() const { return sums_; }
    /// Channels R G B variance.R variance.G variance.B; the variance is that of the mean, 0 while
    /// there are fewer than two batches.
    Image image(int width) const;
    std::optional<ErrorEstimate> error() const;
    /// Of the batches of one sample.
    const SampleHistogram& histogram() const { return histogram_; }

  private:
    /// What the batches of a pixel tell of its noise (ErrorSums).
    struct Spread {
        glm::dvec3 residual{0}; ///< Sum of squared contrasts.
        double weighted = 0;    ///< W
        double pairs = 0;       ///< G
        glm::dvec3 last{0};     ///< Of the last batch: sum - samples * mean before.
    };

    void add_contrast(Spread& spread, const glm::dvec3& d, double weight, double scale);
    void add_pair(Spread& spread, const glm::dvec3& difference);
    void count_sample(const glm::dvec4& value);

    std::vector<glm::dvec4> sums_;
    std::vector<Spread> spreads_;
    std::uint32_t batches_ = 0;
    BatchContrasts contrasts_;
    ErrorSums error_sums_; ///< Those that grow with each batch.
    SampleHistogram histogram_{};
};

} // namespace tyndall::stats

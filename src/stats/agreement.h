/// Whether two renderers draw the same picture: a hypothesis test on paired batches.
///
/// Both render the same ranges of samples with the same seed, so most of the noise cancels in the
/// differences, and what is left of it is as likely to be positive as negative. Each block of
/// pixels and channel, and each channel of the whole image, gets a t-test of "the mean difference
/// is zero, up to rounding" over the batches.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace tyndall::stats {

/// For each pixel, row by row: (sum of weight * radiance, sum of weights) over a range of samples.
using PixelSums = std::vector<glm::dvec4>;

struct AgreementOptions {
    int block_size = 8; ///< Pixels along an edge.
    /// Probability of a rejection if the renderers do agree, over all blocks, channels and means.
    double false_alarm_rate = 1e-3;
    /// Means may differ by this much of their larger one: single precision has systematic rounding
    /// errors, and in a scene without noise any difference at all would be significant.
    double relative_tolerance = 1e-5;
};

struct Agreement {
    bool agrees = true;
    double p_value = 1;                       ///< Of everything, corrected for the number of tests.
    double p_means = 1;                       ///< Of the image means, corrected for three channels.
    double p_blocks = 1;                      ///< Of the blocks, corrected for blocks * channels.
    std::array<double, 3> mean_a{}, mean_b{}; ///< Image means.
    std::array<double, 3> mean_t{};           ///< Their t statistics, signed as a - b.
    int worst_x = 0, worst_y = 0,
        worst_channel = 0;           ///< First pixel and channel of the worst block.
    double worst_t = 0, worst_p = 1; ///< Its t statistic and own p-value.
    int tests = 0;                   ///< Blocks * channels.
};

/// @param a, b   Batches: a[i] and b[i] are sums over the same samples; at least 2, equally many.
///               Each has width pixels a row.
/// @throws Error failed if the sizes do not fit.
Agreement test_agreement(std::span<const PixelSums> a, std::span<const PixelSums> b, int width,
                         const AgreementOptions& options = {});

} // namespace tyndall::stats

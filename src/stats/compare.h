/// How two images differ.
#pragma once

#include "image/image.h"

#include <array>
#include <optional>

namespace tyndall::stats {

/// Errors of image a with respect to image b, over pixels; d = a - b.
struct ErrorMeasures {
    double mse = 0;    ///< mean of d^2
    double rmse = 0;   ///< sqrt(mse)
    double relmse = 0; ///< mean of d^2 / (b^2 + 0.01)
    double mean_a = 0;
    double mean_b = 0;
    double mean_ratio = 1; ///< mean_a / mean_b; 1 if both are 0
};

/// z-tests of "equal up to rounding", from the variances of the pixel means. Pixels are taken as
/// independent; blocks of 8 x 8 of them, so that their sums are nearer to normal than single
/// pixels.
struct SignificanceTest {
    std::array<double, 3> mean_z{}; ///< Of the image means, signed as a - b.
    double worst_block_z = 0;
    int worst_x = 0, worst_y = 0, worst_channel = 0; ///< First pixel and channel of that block.
    double blocks_beyond_3 = 0;                      ///< Share with |z| > 3; 0.0027 by chance.
    double p_means = 1;  ///< Of the image means, corrected for three channels.
    double p_blocks = 1; ///< Of the worst block, corrected for blocks * channels.
};

struct Comparison {
    ErrorMeasures all;                     ///< Over all three channels.
    std::array<ErrorMeasures, 3> channels; ///< R, G, B
    std::optional<SignificanceTest> test;  ///< None if neither image has variance.R/G/B.
    Image difference;                      ///< d, channels R, G, B
};

/// Compares the channels R, G, B. An image without variance channels counts as exact.
/// @throws Error bad_input if the sizes differ or a colour channel is missing.
Comparison compare(const Image& a, const Image& b);

} // namespace tyndall::stats

/// Means with standard errors, and the project's one policy of statistical tests: fixed seeds, pass
/// below 4.5 standard errors, and the same data must reject a named wrong answer at 6.
#pragma once

#include "reference/reference.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace tyndall::support {

inline constexpr double pass = 4.5;
inline constexpr double reject = 6;

struct Estimate {
    Rgb mean{0};
    Rgb standard_error{0};

    /// Distance from a value in standard errors; a miss without any spread is infinitely far.
    double z(double value, int channel = 0) const {
        const double miss = std::abs(mean[channel] - value);
        if (miss <= 1e-12 * std::abs(value)) return 0;
        return miss / standard_error[channel];
    }
};

/// Mean of the image over all pixels, from batches of samples_per_batch samples a pixel.
Estimate image_mean(const Scene& scene, std::uint32_t batches, std::uint32_t samples_per_batch);

/// The colour of each pixel.
std::vector<Rgb> colors(const reference::PixelSums& sums);
std::vector<Rgb> render(const Scene& scene, std::uint32_t samples);

} // namespace tyndall::support

/// Scalar C++ on homogeneous-cube: how fast this machine walks photons, so that figures of one day
/// or machine can be compared with another's.
#pragma once

#include <cstdint>

namespace tyndall::bench {

struct YardstickResult {
    double paths = 0;
    double mean = 0; ///< Of the picture; 0.854 with the yardstick's camera.
};

/// Renders 256 x 256 x 64 paths on two threads. `round` picks the random numbers.
YardstickResult run_yardstick(std::uint32_t round);

} // namespace tyndall::bench

/// Phase functions by table: Lorenz-Mie scattering and whatever else has no closed form.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace tyndall {

/// A phase function of three channels, each piecewise linear in mu = cos(theta) between shared
/// nodes.
///
/// Node i of n is at theta = pi (i / (n - 1))^2, from forward to backward: fine where the forward
/// peak is. Stored as 1 - mu, which keeps its digits there. Values are per steradian and integrate
/// to 1 as interpolated, so that evaluation, density and inversion of the CDF are the same function
/// exactly.
struct PhaseTable {
    std::vector<double> complement;           ///< 1 - mu, from 0 to 2.
    std::array<std::vector<double>, 3> value; ///< [1/sr], > 0 or 0
    /// Probability of scattering by less than the node's angle: 2 pi times the integral over mu; 0
    /// ... 1.
    std::array<std::vector<double>, 3> cdf;
    std::array<double, 3> mean_cosine{}; ///< Of the interpolant.

    /// The channels differ.
    bool is_chromatic() const { return value[0] != value[1] || value[0] != value[2]; }
};

/// Angle of node i of n [radians].
double phase_table_angle(std::size_t i, std::size_t n);

/// The table of functions given up to a factor.
/// @param value  by channel, at the nodes: at least two each, the same number; >= 0, finite, not
/// all 0.
PhaseTable make_phase_table(std::array<std::vector<double>, 3> value);

} // namespace tyndall

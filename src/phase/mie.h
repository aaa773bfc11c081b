/// Phase functions of clouds of spheres by Lorenz-Mie theory.
#pragma once

#include "phase/phase_table.h"

#include <array>

namespace tyndall {

struct MieParameters {
    /// Of the spheres [um]; with a distribution of sizes the median. The radius or, below, the
    /// distribution must keep 2 pi r / wavelength within [1e-6, 1e4].
    double radius_um = 1;
    /// Standard deviation of ln(radius): 0 for spheres of one size, else their number is lognormal
    /// in the radius; at most 1.
    double radius_sigma = 0;
    std::array<double, 3> eta{1.33, 1.33,
                              1.33};  ///< Refractive index of the spheres by channel, > 0.
    std::array<double, 3> k{0, 0, 0}; ///< Their absorption index, >= 0.
    std::array<double, 3> wavelength_um{0.6114, 0.5491, 0.4643}; ///< In vacuum.
    double medium_eta = 1; ///< Refractive index of what is around them, > 0.
};

/// What a channel sees of one sphere, on average over the sizes.
struct MieChannel {
    double size_parameter = 0; ///< 2 pi r / wavelength in the medium, for radius_um.
    double qext = 0, qsca = 0; ///< Cross sections over the mean geometric cross section.
    double asymmetry = 0;      ///< Mean cosine, by the series (not of the table).
    double extinction_um2 = 0; ///< Cross sections [um^2].
    double scattering_um2 = 0;
};

struct MieResult {
    PhaseTable table;
    std::array<MieChannel, 3> channels;
};

/// Efficiencies, and the phase function for unpolarised light as a table.
///
/// Sizes are integrated by the trapezoidal rule in a variable t with dt = 4 d(ln r) / sigma + (1 +
/// 250 / (x + 30)) dx: fine against the distribution, and against interference, whose phase changes
/// by at most 2 (1 + m) dx. What is left comes from resonances far sharper than any step, which a
/// distribution over many of them averages: below 1e-3 of every cross section (tested). Sizes that
/// add less than 1e-6 of what the most important one does are left out.
///
/// The intensity of a sphere with N terms is a trigonometric polynomial of degree 2N in the angle:
/// it is summed over sizes at equal steps of the angle that determine it, and evaluated at the
/// nodes of the table from its cosine series. The table has 512 + 20 x nodes, at most 32768, x the
/// mean size parameter by scattering: at least 20 to a lobe backward (pi / x), far more forward.
///
/// @throws Error  if a size parameter is outside the range that is stated above, or the spheres do
/// not scatter
///                because their index is that of the medium.
MieResult compute_mie(const MieParameters& parameters);

} // namespace tyndall

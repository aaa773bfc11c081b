/// Phase functions by hand, for tests.
#pragma once

#include "scene/scene.h"

namespace tyndall::support {

PhaseFunction henyey_greenstein(double g);
PhaseFunction schlick(double k);
PhaseFunction rayleigh();

/// Spheres of one size and index for each channel, or of a lognormal distribution.
/// @param sizes  size parameter 2 pi r / wavelength by channel.
PhaseFunction mie(const std::array<double, 3>& sizes, double eta, double sigma = 0);
inline PhaseFunction mie(double size, double eta, double sigma = 0) {
    return mie({size, size, size}, eta, sigma);
}

/// The same function with another weight, for mixtures.
PhaseFunction weighted(double weight, PhaseFunction phase);

/// A control: the table made steeper, as if its values had been multiplied by 1 + share *
/// cos(theta).
PhaseFunction perturbed(const PhaseFunction& mie, double share);

} // namespace tyndall::support

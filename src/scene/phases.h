/// Phase functions from the parameters of a medium.
#pragma once

#include "scene/input_files.h"
#include "scene/parameters.h"
#include "scene/scene.h"

#include <vector>

namespace tyndall {

/// "string phase": one of henyey-greenstein (default), isotropic, schlick, rayleigh, mie; or
/// several, for a mixture by "float phaseweights" (> 0, scaled to the sum 1; equal if not given). A
/// function of a mixture must not be a delta.
///
/// With several functions, a float parameter has one value for each that takes it, in order.
///
/// - "float g": mean cosine of henyey-greenstein; schlick fits k = 1.55 g - 0.55 g^3 to it (0)
/// - "float k": of schlick, in (-1, 1), in place of g
/// - "float mieradius": of the spheres [um], or the median of their radii; needed
/// - "float miesigma": standard deviation of ln(radius), in [0, 1] (0: one size)
/// - "float mieeta", or by channel "rgb" or "spectrum": refractive index of the spheres (water)
/// - "float miek", likewise: their absorption index (0)
/// - "float miemediumeta": refractive index of what is around them (1)
///
/// With "string preset" "air" the default is rayleigh. After an error the functions are such that
/// reading can go on.
std::vector<PhaseFunction> read_phases(Parameters& parameters, InputFiles& files);

/// Scattering coefficient [1/m] of air at sea level, at the wavelengths of the channels ("string
/// preset" "air").
Rgb air_scattering();

} // namespace tyndall

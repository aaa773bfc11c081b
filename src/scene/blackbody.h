/// Emission of hot media.
#pragma once

#include "scene/scene.h"

namespace tyndall {

/// blackbody_emission (scene/spectrum.h) to about 1e-6, fast enough to be asked at every collision.
/// 0 up to 100 K, as in pbrt.
Rgb blackbody_radiance(double kelvin);

} // namespace tyndall

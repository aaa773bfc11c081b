/// Boundaries for scenes by hand: each function adds a material and returns its index.
#pragma once

#include "scene/scene.h"

namespace tyndall::support {

/// @param eta  inside over outside;  @param alpha  GGX roughness, 0: smooth.
int add_dielectric(Scene& scene, const Rgb& eta, double alpha = 0);
int add_thin_dielectric(Scene& scene, const Rgb& eta);
int add_conductor(Scene& scene, const Rgb& eta, const Rgb& k, double alpha = 0);

} // namespace tyndall::support

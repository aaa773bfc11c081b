/// Scenes whose radiance is known from elsewhere: closed forms, published tables.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tyndall::selftest {

struct Case {
    std::string name;
    Scene scene;
    std::uint32_t samples; ///< Per pixel.
    Rgb expected;          ///< Mean over the film.
    /// Relative error that is no noise: a few roundings of float32 a path.
    double rounding = 2e-6;
};

/// A plane-parallel slab of optical thickness tau, under light at right angles.
struct Slab {
    double albedo, tau, g;
    double index = 1; ///< Of refraction; 1: without a surface.
};
/// What the camera, which looks at it from z < 0, sees of the sky.
enum class Lit { near_side, far_side, both_sides };

/// The slab 0 <= z <= 1, far wider than thick. A pixel is, by reciprocity, the part of a beam that
/// leaves the slab on the sides that are lit: the reflectance, the transmittance, their sum.
Scene slab_scene(const Slab& slab, Lit lit);

/// The same scene in other units: lengths times `factor`, coefficients over it.
Scene in_units(Scene scene, double factor);

/// The short form of what tests/stability goes through.
std::vector<Case> cases();

} // namespace tyndall::selftest

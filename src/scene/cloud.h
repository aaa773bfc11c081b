/// Procedural clouds.
#pragma once

#include "scene/parameters.h"
#include "scene/scene.h"

namespace tyndall {

/// Perlin's gradient noise with pbrt's gradients: 0 at points with integer coordinates, in about
/// (-1, 1), of period 256. Source: Perlin, Improving Noise (SIGGRAPH 2002); Pharr, Jakob and
/// Humphreys, Physically Based Rendering, 10.6.
double gradient_noise(const glm::dvec3& point);

/// Density of pbrt's "cloud" at a point of medium space, in [0, 1]: five octaves of noise over a
/// point that two more have displaced, thinning out towards y = 1 and solid below y = 0.
double cloud_density(const glm::dvec3& point, double density, double wispiness, double frequency);

/// The density of a "cloud" between "p0" and "p1", on voxels: four by the length over which its
/// finest octave but one changes (32 "frequency" a unit), at most 512 along an axis, of which a
/// warning tells. After an error the medium stays homogeneous.
void read_cloud(Parameters& parameters, Medium& medium);

} // namespace tyndall

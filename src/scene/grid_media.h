/// Media on voxels, from their parameters.
#pragma once

#include "scene/parameters.h"
#include "scene/scene.h"

namespace tyndall {

/// The density of a "uniformgrid": voxels that share a box evenly, with samples at their centres.
/// Medium::sigma_a, sigma_s, emission and world_from_medium must have been read. After an error the
/// medium stays homogeneous.
void read_uniform_grid(Parameters& parameters, Medium& medium);

} // namespace tyndall

/// Random fields for tests of grids.
#pragma once

#include "volume/grid.h"

#include <random>
#include <vector>

namespace tyndall {

using Random = std::mt19937;

/// A value per voxel, x fastest; `share` of the voxels are not 0.
std::vector<float> random_values(Random& random, const glm::ivec3& count, double share);

/// Bricks at random places of a box, also at negative ones; some are tiles.
Grid random_bricks(Random& random, const glm::ivec3& first_brick, const glm::ivec3& brick_count);

/// A point of the box, widened by `margin`; now and then with coordinates on voxels.
glm::dvec3 random_point(Random& random, const glm::dvec3& lower, const glm::dvec3& upper,
                        double margin);

} // namespace tyndall

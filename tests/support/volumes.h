/// Media on voxels by hand, for tests.
#pragma once

#include "scene/scene.h"

#include <cmath>
#include <functional>

namespace tyndall::support {

/// A value by voxel.
using VoxelFunction = std::function<double(const glm::ivec3&)>;

/// Voxels 0 ... count - 1 whose centres fill the box from lower to upper in medium space: trilinear
/// up to its faces and nothing beyond.
struct Lattice {
    glm::dvec3 lower{0}, upper{1};
    glm::ivec3 count{9}; ///< >= 2 on each axis.

    std::shared_ptr<const Grid> grid(const VoxelFunction& value) const;
    /// Of that density; no other grids.
    GridDensity density(const VoxelFunction& value, int cell_size = 3) const;
    /// Place of a voxel's centre in medium space.
    glm::dvec3 place(const glm::ivec3& voxel) const;
};

/// Coefficients by channel on the voxels, as of an rgbgrid medium; sigma_a and sigma_s of the
/// medium become 1.
void set_channel_grids(Medium& medium, const Lattice& lattice,
                       const std::function<Rgb(const glm::ivec3&)>& sigma_a,
                       const std::function<Rgb(const glm::ivec3&)>& sigma_s);

/// A wall that is lit squarely through two grids, one after the other: what is left of a flight
/// that ends in the first must not decide about the second.
Scene scene_behind_two_grids();
/// The radiance of the wall.
inline const double kBehindTwoGrids = 0.5 / 3.14159265358979323846 * std::exp(-2.0);

} // namespace tyndall::support

/// Voxels that shine: grids as lights.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace tyndall {

struct EmittingVoxel {
    glm::ivec3 voxel;
    double power; ///< Mean over the channels of sigma_a Le: radiance per unit length. > 0
};

/// More than this many voxels are no light: a table of them would outweigh the grids.
constexpr std::size_t max_emitting_voxels = std::size_t{1} << 22;

/// Media on grids that emit, and in which paths can be without being in an instance, by index: with
/// volpath, those are lights.
std::vector<int> emitting_grids(const Scene& scene);

/// sigma_a Le at a voxel: radiance per unit length.
Rgb voxel_emission(const Medium& medium, const GridDensity& density, const glm::ivec3& voxel);

/// sigma_a at a voxel.
Rgb voxel_absorption(const Medium& medium, const GridDensity& density, const glm::ivec3& voxel);

/// sigma_a + sigma_s at a voxel.
Rgb voxel_extinction(const Medium& medium, const GridDensity& density, const glm::ivec3& voxel);

/// The voxels of a medium with GridDensity that emit, brick by brick. Emission between voxels is
/// trilinear in them: a voxel drawn in proportion to its power, and a place around it drawn from a
/// tent one voxel wide to each side, is a point drawn in proportion to the emission.
/// @return Empty if there are more than max_emitting_voxels.
std::vector<EmittingVoxel> emitting_voxels(const Medium& medium);

} // namespace tyndall

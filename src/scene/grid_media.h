/// Media on voxels, from their parameters.
///
/// Source: pbrt-v4, media.cpp. Unlike there, "Lescale" that is not given counts 1 everywhere in the
/// box; pbrt takes a grid of one voxel for it, which falls off towards the faces.
#pragma once

#include "scene/input_files.h"
#include "scene/parameters.h"
#include "scene/scene.h"

#include <optional>

namespace tyndall {

/// The density of a "uniformgrid": voxels that share a box evenly, with samples at their centres.
/// Medium::sigma_a, sigma_s and world_from_medium must have been read. After an error the medium
/// stays homogeneous.
void read_uniform_grid(Parameters& parameters, Medium& medium, InputFiles& files);

/// The coefficients of an "rgbgrid", likewise; of "sigma_a" and "sigma_s" one may be missing and is
/// 1 then.
void read_rgb_grid(Parameters& parameters, Medium& medium);

/// A box from "p0" to "p1" in medium space, cut into voxels.
struct VoxelLattice {
    glm::ivec3 count{1};
    glm::dmat4 index_from_medium{1};

    std::size_t size() const { return std::size_t(count.x) * count.y * count.z; }
    /// Of index space: voxels reach half of their size beyond their centres.
    glm::dvec3 lower() const { return glm::dvec3(-0.5); }
    glm::dvec3 upper() const { return glm::dvec3(count) - 0.5; }
};

/// "p0" and "p1": the corners, sorted. Nothing after an error.
std::optional<std::array<glm::dvec3, 2>> read_box(Parameters& parameters);
VoxelLattice make_lattice(const glm::ivec3& count, const std::array<glm::dvec3, 2>& box);

/// The temperature in kelvin as scene.h wants it: (raw - "temperatureoffset") * "temperaturescale".
/// Where the raw grid has no value it counts 0.
/// @param around  the voxels that matter: those with density.
Grid read_temperature(Parameters& parameters, const Grid& raw, const VoxelBox& around);

/// Completes a density from its grids: cuts the box to where the medium is, and bounds the
/// extinction.
void finish_density(GridDensity& density, const Medium& medium);

} // namespace tyndall

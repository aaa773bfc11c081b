/// Majorants of grids: bounds by cell, and the choice of the cells.
#pragma once

#include "volume/grid.h"

#include <array>
#include <cstdint>
#include <memory>

namespace tyndall {

/// Most cells of a MajorantGrid: 64 MiB of bounds.
constexpr std::uint64_t max_majorant_cells = 1u << 24;

/// Bounds over cells of `size` voxels that cover all points where the field is not 0. A bound is
/// the largest of the voxels that the trilinear values of its cell come from: exact, and at least
/// 0.
/// @param size  >= 1, and so large that there are at most max_majorant_cells.
MajorantGrid build_majorants(const Grid& grid, int size);

/// The same over cells of the size that makes tracking cheapest, as far as can be told from the
/// data.
///
/// A ray pays for every cell it enters and for every null collision. In directions that are all
/// alike it enters 3 / (2 size) cells per voxel of its length, and meets sigma (bound - density)
/// null collisions per length; both are averaged over the box around all points where the field is
/// not 0. Of sizes 2, 4, ... 64 (larger ones only where max_majorant_cells asks for them) the
/// cheapest is taken. After Szirmay-Kalos, Toth and Magdics, Free Path Sampling in High Resolution
/// Inhomogeneous Participating Media (CGF 30, 2011), section 5, who weigh the same two costs to
/// choose their super-voxels.
///
/// @param voxel_length  edge of a voxel in scene units (the geometric mean, if edges differ), > 0.
/// @param sigma         extinction of density 1 [1/scene unit], largest channel; 1 for bounds of
/// extinction itself.
MajorantGrid choose_majorants(const Grid& grid, double voxel_length, double sigma);

/// By voxel the largest sigma_a + sigma_s of a channel, rounded up: what the majorants of an
/// rgbgrid bound.
/// @param sigma_a, sigma_s  one grid a channel; not null.
Grid max_extinction(const std::array<std::shared_ptr<const Grid>, 3>& sigma_a,
                    const std::array<std::shared_ptr<const Grid>, 3>& sigma_s);

} // namespace tyndall

/// Fields in files of OpenVDB and NanoVDB.
#pragma once

#include "volume/grid.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tyndall {

/// A scalar grid of a file.
struct Field {
    Grid grid; ///< All values of the file, whether their voxels are active or not.
    glm::dmat4 world_from_index{1}; ///< "World" is the file's; affine and invertible.
    VoxelBox active;                ///< Active voxels.
};

struct FieldRequest {
    std::string name;
    bool may_be_missing = false;
    bool may_be_negative = false;
    std::uint64_t max_voxels = GridBuilder::default_max_voxels; ///< That may be stored.
};

/// Reads one grid of an OpenVDB file (.vdb) or a NanoVDB file (.nvdb; packed by none, zip or
/// blosc): fog volumes, or grids of no class, of float or double, halves and quantised floats
/// included, under an affine transform.
///
/// Of several grids with the name the first counts. Files are not trusted: what is cut off or
/// contradicts itself is refused, and memory is bounded by the file and max_voxels.
///
/// @param bytes  of the file.
/// @return Nothing if there is no such grid and that is allowed.
/// @throws Error (bad_input)  what is wrong, without the name of the file: no such grid (the
/// message lists those
///         that there are); another type, a level set, another background than 0, a frustum; values
///         that are not finite or, unless allowed, negative (with the voxel); more voxels than
///         allowed.
std::optional<Field> read_field(std::string_view bytes, const FieldRequest& request);

} // namespace tyndall

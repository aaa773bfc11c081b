/// The tree of one NanoVDB grid in memory, once every node is known to lie within its bytes.
#pragma once

#include "volume/field_assembly.h"

#include <cstddef>
#include <span>

namespace tyndall {

/// @param bytes  of the grid, unpacked; aligned to 32. The result points into them.
/// @throws Error (bad_input)  see read_field.
VdbTree read_nanovdb_tree(std::span<const std::byte> bytes, const FieldRequest& request);

/// The same grid's transform and active voxels.
Field read_nanovdb_header(std::span<const std::byte> bytes, const FieldRequest& request);

} // namespace tyndall

/// From the nodes of a VDB tree to a Grid: what both kinds of files have in common.
#pragma once

#include "volume/volume_file.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace tyndall {

/// A node of 8 x 8 x 8 voxels.
struct VdbLeaf {
    glm::ivec3 brick{0}; ///< Counted from the origin, as in Grid::each_brick.
    const void* node = nullptr;
};

/// One value for a cube of bricks.
struct VdbTile {
    glm::ivec3 first_brick{0};
    int edge = 1; ///< Bricks.
    double value = 0;
};

struct VdbTree {
    std::vector<VdbLeaf> leaves;
    std::vector<VdbTile> tiles; ///< Those that are not 0.
    /// Writes the values of a leaf in the order of VDB, z fastest.
    std::function<void(const void* node, std::span<double, kBrickVoxels>)> unpack;
};

/// The grid of a tree.
/// @throws Error (bad_input)  see read_field.
Grid assemble_grid(const VdbTree& tree, const FieldRequest& request);

/// @throws Error (bad_input)  there is no such grid; lists those that there are. Returns if it may
/// be missing.
void report_missing(const FieldRequest& request, const std::vector<std::string>& names);

/// `grid "density": what`
[[noreturn]] void refuse_field(const FieldRequest& request, const std::string& what);

} // namespace tyndall

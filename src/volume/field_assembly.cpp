#include "volume/field_assembly.h"

#include "core/error.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace tyndall {
namespace {

/// A value as a float, once it is checked.
float checked(double value, const glm::ivec3& voxel, const FieldRequest& request) {
    const bool is_finite = std::abs(value) <= double{std::numeric_limits<float>::max()};
    if (!is_finite || (value < 0 && !request.may_be_negative)) {
        refuse_field(request,
                     fmt::format("voxel ({}, {}, {}) is {} (expected {})", voxel.x, voxel.y,
                                 voxel.z, value,
                                 is_finite ? "a value >= 0" : "a finite value that fits a float"));
    }
    return static_cast<float>(value);
}

VoxelBox box_of(const glm::ivec3& brick, int edge) {
    return {kBrickSize * brick, kBrickSize * (brick + edge) - 1};
}

} // namespace

Grid assemble_grid(const VdbTree& tree, const FieldRequest& request) {
    if (tree.leaves.size() > request.max_voxels / kBrickVoxels) {
        refuse_field(request,
                     fmt::format("{} voxels in nodes of 8^3 are too many (expected at most {})",
                                 tree.leaves.size() * kBrickVoxels, request.max_voxels));
    }
    VoxelBox box;
    for (const VdbLeaf& leaf : tree.leaves)
        box = box.joined(box_of(leaf.brick, 1));
    for (const VdbTile& tile : tree.tiles)
        box = box.joined(box_of(tile.first_brick, tile.edge));
    GridBuilder builder(box, request.max_voxels);
    builder.reserve(tree.leaves.size());
    for (const VdbTile& tile : tree.tiles) {
        const float value = checked(tile.value, kBrickSize * tile.first_brick, request);
        each_brick_of(box_of(tile.first_brick, tile.edge),
                      [&](const glm::ivec3& brick) { builder.set_tile(brick, value); });
    }
    std::array<double, kBrickVoxels> source;
    std::array<float, kBrickVoxels> values;
    for (const VdbLeaf& leaf : tree.leaves) {
        tree.unpack(leaf.node, source);
        for (int i = 0; i < kBrickVoxels; ++i) {
            const int from = (i & 7) << 6 | (i & 0x38) | i >> 6; // x and z trade places
            values[i] = checked(source[from], brick_voxel(leaf.brick, i), request);
        }
        builder.set_brick(leaf.brick, values);
    }
    return builder.finish();
}

void report_missing(const FieldRequest& request, const std::vector<std::string>& names) {
    if (request.may_be_missing) return;
    throw Error(ExitStatus::bad_input,
                names.empty() ? fmt::format("no grid \"{}\" (the file has no grids)", request.name)
                              : fmt::format("no grid \"{}\" (the file has \"{}\")", request.name,
                                            fmt::join(names, "\", \"")));
}

void refuse_field(const FieldRequest& request, const std::string& what) {
    throw Error(ExitStatus::bad_input, fmt::format("grid \"{}\": {}", request.name, what));
}

} // namespace tyndall

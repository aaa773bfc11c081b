/// Scalar fields on voxels: what VDB files, uniformgrid media and clouds become.
///
/// A grid lives in index space: voxel (i, j, k) has its centre at the integer point (i, j, k), and
/// values between centres are trilinear. Space is cut into bricks of 8 x 8 x 8 voxels; bricks
/// without a value other than 0 are not stored. Everything outside of the stored bricks is 0.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace tyndall {

constexpr int kBrickSize = 8;
constexpr int kBrickVoxels = kBrickSize * kBrickSize * kBrickSize;

struct Grid {
    static constexpr std::uint32_t empty = 0xFFFFFFFFu;
    /// In brick_index: not a brick of voxels, but one value for all of them (tiles[word & ~tile]).
    static constexpr std::uint32_t tile = 0x80000000u;

    glm::ivec3 first_brick{0}; ///< Brick b covers voxels 8 (first_brick + b) ... + 7 on each axis.
    glm::ivec3 brick_count{0}; ///< All 0 for a grid without values.
    /// For brick (x, y, z), x fastest: its number, `empty`, or `tile` | index into tiles.
    std::vector<std::uint32_t> brick_index;
    std::vector<float> voxels; ///< 512 a brick, x fastest. Finite.
    std::vector<float> tiles;
    bool is_half = false; ///< Every value is exact in 16 bits.

    /// Value of a voxel; 0 outside.
    float value(const glm::ivec3& voxel) const;
    /// Trilinear value at a point of index space.
    double sample(const glm::dvec3& index) const;
    /// Voxels that are not 0: lower and upper corner, inclusive. lower > upper if there are none.
    glm::ivec3 lower() const { return kBrickSize * first_brick; }
    glm::ivec3 upper() const { return kBrickSize * (first_brick + brick_count) - 1; }
    bool is_empty() const { return brick_index.empty(); }
    std::uint64_t bytes() const;
    float max() const;
};

/// Upper bounds of a field over cubic cells of index space, for tracking.
///
/// Cell c covers the points lower + size * c <= index < lower + size * (c + 1). Its bound is >=
/// every trilinear value inside, so voxels up to one beyond the cell count.
struct MajorantGrid {
    glm::ivec3 lower{0};
    int size = 8; ///< Voxels along an edge.
    glm::ivec3 count{0};
    std::vector<float> bounds; ///< x fastest.
};

} // namespace tyndall

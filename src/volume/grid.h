/// Scalar fields on voxels: what VDB files, uniformgrid media and clouds become.
///
/// A grid lives in index space: voxel (i, j, k) has its centre at the integer point (i, j, k), and
/// values between centres are trilinear. Space is cut into bricks of 8 x 8 x 8 voxels; bricks
/// without a value other than 0 are not stored. Everything outside of the stored bricks is 0.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <unordered_map>
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
    /// Trilinear value at a point of index space. Never beyond the values of its eight voxels, not
    /// even by rounding.
    double sample(const glm::dvec3& index) const;
    /// Voxels of the bricks: lower and upper corner, inclusive. lower > upper if there are none.
    glm::ivec3 lower() const { return kBrickSize * first_brick; }
    glm::ivec3 upper() const { return kBrickSize * (first_brick + brick_count) - 1; }
    bool is_empty() const { return brick_index.empty(); }
    std::uint64_t bytes() const;
    float max() const; ///< Of all of space, so at least 0.

    /// Calls visit(brick, values) for each brick that has voxels, and visit_tile(brick, value) for
    /// each tile; brick is counted from the origin: voxels 8 brick ... 8 brick + 7.
    template<typename Visit, typename VisitTile>
    void each_brick(const Visit& visit, const VisitTile& visit_tile) const {
        std::size_t at = 0;
        for (int z = 0; z < brick_count.z; ++z)
            for (int y = 0; y < brick_count.y; ++y)
                for (int x = 0; x < brick_count.x; ++x) {
                    const std::uint32_t word = brick_index[at++];
                    if (word == empty) continue;
                    const glm::ivec3 brick = first_brick + glm::ivec3(x, y, z);
                    if (word & tile)
                        visit_tile(brick, tiles[word & ~tile]);
                    else
                        visit(brick,
                              std::span<const float, kBrickVoxels>(
                                  voxels.data() + std::size_t{word} * kBrickVoxels, kBrickVoxels));
                }
    }
};

/// Voxels from `lower` to `upper`, both inclusive; none if a component of upper is below that of
/// lower.
struct VoxelBox {
    glm::ivec3 lower{0}, upper{-1};
    bool is_empty() const { return glm::any(glm::lessThan(upper, lower)); }
    bool contains(const glm::ivec3& voxel) const {
        return glm::all(glm::lessThanEqual(lower, voxel)) &&
               glm::all(glm::lessThanEqual(voxel, upper));
    }
    /// The smallest box with all voxels of both.
    VoxelBox joined(const VoxelBox& other) const;
};

/// Voxel i of a brick: x fastest.
inline glm::ivec3 brick_voxel(const glm::ivec3& brick, int i) {
    return kBrickSize * brick + glm::ivec3(i & 7, i >> 3 & 7, i >> 6);
}

/// Calls visit(brick) for each brick that the box touches, x fastest.
template<typename Visit>
void each_brick_of(const VoxelBox& box, const Visit& visit) {
    if (box.is_empty()) return;
    const glm::ivec3 first = box.lower >> 3, last = box.upper >> 3;
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x)
                visit(glm::ivec3(x, y, z));
}

/// The voxels whose value is not 0. The field is 0 from one voxel beyond the box on.
VoxelBox find_support(const Grid& grid);

/// Makes a Grid brick by brick. Bricks of zeros are not stored, those of a single value become
/// tiles.
class GridBuilder {
  public:
    /// Most bricks of the index, stored or not: 256 MiB of it.
    static constexpr std::uint64_t max_index = 1u << 26;
    /// Most voxels in bricks, unless a caller sets another limit: 8 GiB of them.
    static constexpr std::uint64_t default_max_voxels = 1ull << 31;

    /// @param box  holds all voxels that will be set.
    /// @throws Error (failed)  the box has more than max_index bricks.
    explicit GridBuilder(const VoxelBox& box, std::uint64_t max_voxels = default_max_voxels);

    /// Makes room for as many bricks with voxels.
    void reserve(std::size_t bricks) { grid_.voxels.reserve(bricks * kBrickVoxels); }

    /// Values of a brick, counted from the origin as in Grid::each_brick; it must touch the box.
    /// Finite.
    /// @throws Error (failed)  more than max_voxels were stored.
    void set_brick(const glm::ivec3& brick, std::span<const float, kBrickVoxels> values);
    void set_tile(const glm::ivec3& brick, float value);

    /// The grid; the builder is empty after it.
    Grid finish();

  private:
    std::uint32_t& word(const glm::ivec3& brick);

    Grid grid_;
    std::uint64_t max_voxels_;
    std::unordered_map<float, std::uint32_t> tile_numbers_;
};

/// Voxels 0 ... count - 1 from values with x fastest; 0 beyond them.
Grid make_dense_grid(std::span<const float> values, const glm::ivec3& count);

/// The grid whose voxels in a box have that value; 0 elsewhere.
Grid make_constant_grid(const VoxelBox& box, float value);

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

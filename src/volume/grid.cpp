#include "volume/grid.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace tyndall {
namespace {

/// Whether a float is a half: 11 bits of significand, a multiple of 2^-24, at most 65504.
bool is_exact_in_half(float value) {
    return (std::bit_cast<std::uint32_t>(value) & 0x1FFFu) == 0 && std::abs(value) <= 65504.0f &&
           std::trunc(value * 0x1p24f) == value * 0x1p24f;
}

int voxel_offset(const glm::ivec3& voxel) {
    const glm::ivec3 local = voxel & (kBrickSize - 1);
    return local.x + kBrickSize * (local.y + kBrickSize * local.z);
}

} // namespace

float Grid::value(const glm::ivec3& voxel) const {
    const glm::ivec3 brick = (voxel >> 3) - first_brick;
    if (glm::any(glm::lessThan(brick, glm::ivec3(0))) ||
        glm::any(glm::greaterThanEqual(brick, brick_count)))
        return 0;
    const std::uint32_t word =
        brick_index[brick.x + brick_count.x * (brick.y + std::size_t(brick_count.y) * brick.z)];
    if (word == empty) return 0;
    if (word & tile) return tiles[word & ~tile];
    return voxels[std::size_t{word} * kBrickVoxels + voxel_offset(voxel)];
}

double Grid::sample(const glm::dvec3& index) const {
    const glm::dvec3 base = glm::floor(index);
    // Far away nothing is stored, and an int would overflow.
    if (is_empty() || glm::any(glm::lessThan(base, glm::dvec3(lower()) - 1.0)) ||
        glm::any(glm::greaterThan(base, glm::dvec3(upper()))))
        return 0;
    const glm::dvec3 f = index - base;
    const glm::ivec3 voxel(base);
    std::array<double, 8> v;
    for (int corner = 0; corner < 8; ++corner)
        v[corner] = value(voxel + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2));
    // std::lerp is monotonic: no rounding leads out of its ends.
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 4 >> axis; ++i)
            v[i] = std::lerp(v[2 * i], v[2 * i + 1], f[axis]);
    return v[0];
}

std::uint64_t Grid::bytes() const {
    return brick_index.size() * sizeof(brick_index[0]) + voxels.size() * sizeof(voxels[0]) +
           tiles.size() * sizeof(tiles[0]);
}

float Grid::max() const {
    float largest = 0;
    for (const auto* values : {&voxels, &tiles})
        for (const float value : *values)
            largest = std::max(largest, value);
    return largest;
}

VoxelBox VoxelBox::joined(const VoxelBox& other) const {
    if (is_empty()) return other;
    if (other.is_empty()) return *this;
    return {glm::min(lower, other.lower), glm::max(upper, other.upper)};
}

VoxelBox find_support(const Grid& grid) {
    VoxelBox box;
    const auto add_brick = [&](const glm::ivec3& brick,
                               std::span<const float, kBrickVoxels> values) {
        if (box.contains(brick_voxel(brick, 0)) &&
            box.contains(brick_voxel(brick, kBrickVoxels - 1)))
            return;
        for (int i = 0; i < kBrickVoxels; ++i)
            if (values[i] != 0) box = box.joined({brick_voxel(brick, i), brick_voxel(brick, i)});
    };
    grid.each_brick(add_brick, [&](const glm::ivec3& brick, float) {
        box = box.joined({brick_voxel(brick, 0), brick_voxel(brick, kBrickVoxels - 1)});
    });
    return box;
}

GridBuilder::GridBuilder(const VoxelBox& box, std::uint64_t max_voxels) : max_voxels_(max_voxels) {
    grid_.is_half = true;
    if (box.is_empty()) return;
    grid_.first_brick = box.lower >> 3;
    grid_.brick_count = (box.upper >> 3) - grid_.first_brick + 1;
    double bricks = 1;
    for (int axis = 0; axis < 3; ++axis)
        bricks *= grid_.brick_count[axis];
    if (bricks > max_index) {
        throw Error(
            ExitStatus::failed,
            fmt::format(
                "a grid over {} x {} x {} voxels is too large (expected at most 2^26 bricks of 8^3 "
                "voxels, stored or not)",
                box.upper.x - std::int64_t{box.lower.x} + 1,
                box.upper.y - std::int64_t{box.lower.y} + 1,
                box.upper.z - std::int64_t{box.lower.z} + 1));
    }
    grid_.brick_index.assign(static_cast<std::size_t>(bricks), Grid::empty);
}

std::uint32_t& GridBuilder::word(const glm::ivec3& brick) {
    const glm::ivec3 at = brick - grid_.first_brick;
    TYNDALL_ASSERT(glm::all(glm::greaterThanEqual(at, glm::ivec3(0))) &&
                   glm::all(glm::lessThan(at, grid_.brick_count)));
    return grid_
        .brick_index[at.x + grid_.brick_count.x * (at.y + std::size_t(grid_.brick_count.y) * at.z)];
}

void GridBuilder::set_brick(const glm::ivec3& brick, std::span<const float, kBrickVoxels> values) {
    const auto differs = [&](float value) { return value != values[0]; };
    if (std::none_of(values.begin(), values.end(), differs)) {
        set_tile(brick, values[0]);
        return;
    }
    if (grid_.voxels.size() + kBrickVoxels > max_voxels_) {
        throw Error(ExitStatus::failed,
                    fmt::format("the grid has more voxels than fit (expected at most {} in bricks "
                                "of 8^3, {:.1f} GiB)",
                                max_voxels_, static_cast<double>(max_voxels_) / (1 << 28)));
    }
    word(brick) = static_cast<std::uint32_t>(grid_.voxels.size() / kBrickVoxels);
    grid_.voxels.insert(grid_.voxels.end(), values.begin(), values.end());
    grid_.is_half = grid_.is_half && std::all_of(values.begin(), values.end(), is_exact_in_half);
}

void GridBuilder::set_tile(const glm::ivec3& brick, float value) {
    if (value == 0) {
        word(brick) = Grid::empty;
        return;
    }
    const auto [found, is_new] =
        tile_numbers_.emplace(value, static_cast<std::uint32_t>(grid_.tiles.size()));
    if (is_new) {
        grid_.tiles.push_back(value);
        grid_.is_half = grid_.is_half && is_exact_in_half(value);
    }
    word(brick) = Grid::tile | found->second;
}

Grid GridBuilder::finish() {
    const auto is_empty = [](std::uint32_t x) { return x == Grid::empty; };
    if (std::all_of(grid_.brick_index.begin(), grid_.brick_index.end(), is_empty))
        grid_ = Grid{.is_half = true};
    if (grid_.voxels.capacity() / 5 * 4 > grid_.voxels.size())
        grid_.voxels.shrink_to_fit(); // which copies
    tile_numbers_.clear();
    return std::exchange(grid_, Grid{});
}

Grid make_dense_grid(std::span<const float> values, const glm::ivec3& count) {
    TYNDALL_ASSERT(values.size() == std::size_t(count.x) * count.y * count.z);
    const VoxelBox box{glm::ivec3(0), count - 1};
    GridBuilder builder(box);
    const glm::u64vec3 bricks((count + kBrickSize - 1) / kBrickSize);
    builder.reserve(bricks.x * bricks.y * bricks.z);
    std::array<float, kBrickVoxels> brick_values;
    each_brick_of(box, [&](const glm::ivec3& brick) {
        brick_values.fill(0);
        const glm::ivec3 first = kBrickSize * brick;
        const glm::ivec3 end = glm::min(count - first, glm::ivec3(kBrickSize));
        for (int z = 0; z < end.z; ++z)
            for (int y = 0; y < end.y; ++y) {
                const std::size_t row =
                    first.x + count.x * (first.y + y + std::size_t(count.y) * (first.z + z));
                std::copy_n(&values[row], end.x, &brick_values[kBrickSize * (y + kBrickSize * z)]);
            }
        builder.set_brick(brick, brick_values);
    });
    return builder.finish();
}

Grid make_constant_grid(const VoxelBox& box, float value) {
    GridBuilder builder(box);
    std::array<float, kBrickVoxels> values;
    each_brick_of(box, [&](const glm::ivec3& brick) {
        for (int i = 0; i < kBrickVoxels; ++i) {
            values[i] = box.contains(brick_voxel(brick, i)) ? value : 0;
        }
        builder.set_brick(brick, values);
    });
    return builder.finish();
}

} // namespace tyndall

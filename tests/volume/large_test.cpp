// Fields of the size that people have: time and memory.
#include "volume/fields.h"
#include "volume/majorants.h"

#include <array>
#include <gtest/gtest.h>
#include <sys/resource.h>

namespace tyndall {
namespace {

/// Most memory that the process has had at a time [bytes].
double peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// A value that is different in each voxel of a brick.
void fill(std::array<float, kBrickVoxels>& values, std::uint32_t seed) {
    for (float& value : values) {
        seed = seed * 1664525u + 1013904223u;
        value = static_cast<float>(seed >> 8) * 0x1p-24f;
    }
}

TEST(LargeField, Sparse2048HasOnePercentOfItsVoxels) {
    GridBuilder builder({glm::ivec3(0), glm::ivec3(2047)});
    std::array<float, kBrickVoxels> values;
    Random random(21);
    const int bricks = (1 << 24) / 100;
    builder.reserve(bricks);
    for (int i = 0; i < bricks; ++i) {
        fill(values, static_cast<std::uint32_t>(i));
        builder.set_brick({random() % 256, random() % 256, random() % 256}, values);
    }
    const Grid grid = builder.finish();
    const double voxels = double(bricks) * kBrickVoxels * 4, index = 4.0 * (1 << 24);
    EXPECT_LE(static_cast<double>(grid.bytes()), voxels + index);
    const MajorantGrid cells = choose_majorants(grid, 1e-2, 10);
    EXPECT_LE(cells.bounds.size(), max_majorant_cells);
    EXPECT_EQ(find_support(grid).lower, glm::ivec3(0));
    // The voxels, the index, bounds of three sizes at most, and the program.
    EXPECT_LE(peak_memory(), voxels + index + 3 * 4.0 * max_majorant_cells + 100e6);
}

TEST(LargeField, Dense512) {
    const glm::ivec3 count(512);
    std::vector<float> values(std::size_t{1} << 27);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<float>(i % 1009);
    const Grid grid = make_dense_grid(values, count);
    EXPECT_EQ(grid.voxels.size(), values.size());
    EXPECT_EQ(grid.value({511, 510, 509}), values[511 + 512 * (510 + 512 * 509)]);
    const MajorantGrid cells = choose_majorants(grid, 1e-2, 10);
    EXPECT_LE(cells.bounds.size(), max_majorant_cells);
    // The array, the grid, bounds as above, and what the other test left.
    EXPECT_LE(peak_memory(), 2 * 4.0 * (1 << 27) + 3 * 4.0 * max_majorant_cells + 100e6);
}

} // namespace
} // namespace tyndall

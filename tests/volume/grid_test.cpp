// Grids against arrays that are read by brute force.
#include "core/error.h"
#include "volume/fields.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <map>

namespace tyndall {
namespace {

float array_value(const std::vector<float>& values, const glm::ivec3& count, const glm::ivec3& v) {
    for (int axis = 0; axis < 3; ++axis)
        if (v[axis] < 0 || v[axis] >= count[axis]) return 0;
    return values[v.x + count.x * (v.y + std::size_t(count.y) * v.z)];
}

/// The sum of eight products, as in a textbook.
double array_sample(const std::vector<float>& values, const glm::ivec3& count,
                    const glm::dvec3& at) {
    const glm::dvec3 base = glm::floor(at);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 offset(corner & 1, corner >> 1 & 1, corner >> 2);
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis) {
            const double f = at[axis] - base[axis];
            weight *= offset[axis] ? f : 1 - f;
        }
        sum += weight * array_value(values, count, glm::ivec3(base) + offset);
    }
    return sum;
}

/// Eight products and their sum, of values up to 10: as many roundings.
constexpr double sample_tolerance = 10 * 32 * 0x1p-53;

int wrong_samples(Random& random, const Grid& grid, const std::vector<float>& values,
                  const glm::ivec3& count) {
    int wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 at = random_point(random, glm::dvec3(0), count, 2);
        wrong += std::abs(grid.sample(at) - array_sample(values, count, at)) > sample_tolerance;
    }
    return wrong;
}

TEST(Grid, DenseArraysReadBack) {
    Random random(1);
    for (const glm::ivec3 count :
         {glm::ivec3(1), glm::ivec3(8), glm::ivec3(9, 1, 17), glm::ivec3(20, 13, 7)}) {
        const std::vector<float> values = random_values(random, count, 0.5);
        const Grid grid = make_dense_grid(values, count);
        for (int z = -2; z < count.z + 2; ++z)
            for (int y = -2; y < count.y + 2; ++y)
                for (int x = -2; x < count.x + 2; ++x)
                    EXPECT_EQ(grid.value({x, y, z}), array_value(values, count, {x, y, z}));
    }
}

TEST(Grid, SamplesAreTrilinear) {
    Random random(2);
    const glm::ivec3 count(20, 13, 7);
    std::vector<float> values = random_values(random, count, 0.5);
    const Grid grid = make_dense_grid(values, count);
    EXPECT_EQ(wrong_samples(random, grid, values, count), 0);
    // Control: one voxel that is 1 % off.
    float& voxel = values[10 + 20 * (6 + 13 * 3)];
    voxel = 1.01f * (voxel + 1);
    EXPECT_GT(wrong_samples(random, grid, values, count), 0);
}

TEST(Grid, FarPointsAreEmpty) {
    const Grid grid = make_dense_grid(std::vector<float>(8, 1.0f), glm::ivec3(2));
    for (const double far : {1e10, -1e10, 1e300, -1e300})
        EXPECT_EQ(grid.sample({far, 0, 0}), 0);
    EXPECT_EQ(Grid{}.sample({0, 0, 0}), 0);
    EXPECT_EQ(Grid{}.value({0, 0, 0}), 0);
    EXPECT_EQ(Grid{}.max(), 0);
}

TEST(Grid, StoresNoZerosAndNoUniformBricks) {
    const glm::ivec3 count(32, 8, 8);
    std::vector<float> values(32 * 64, 0.0f);
    for (int i = 0; i < 64; ++i)
        for (int x = 0; x < 24; ++x)
            values[32 * i + x] = x < 8 ? 3.0f : x < 16 ? 0.0f : static_cast<float>(x);
    const Grid grid = make_dense_grid(values, count);
    EXPECT_EQ(grid.voxels.size(), 512u);
    EXPECT_EQ(grid.tiles, std::vector<float>{3.0f});
    EXPECT_EQ(grid.brick_index,
              (std::vector<std::uint32_t>{Grid::tile, Grid::empty, 0, Grid::empty}));
    EXPECT_EQ(grid.bytes(), 4u * (4 + 512 + 1));
    EXPECT_EQ(grid.max(), 23.0f);
    EXPECT_TRUE(make_dense_grid(std::vector<float>(64, 0.0f), glm::ivec3(4)).is_empty());
}

TEST(Grid, KnowsWhatFitsHalf) {
    const auto is_half = [](float value) {
        return make_dense_grid(std::vector{value}, glm::ivec3(1)).is_half;
    };
    for (const float value :
         {0.0f, 1.0f, 0.5f, 1.0f + 0x1p-10f, 65504.0f, 0x1p-24f, 0x1p-14f, 3 * 0x1p-24f})
        EXPECT_TRUE(is_half(value)) << value;
    for (const float value : {0.1f, 1.0f + 0x1p-11f, 65536.0f, 0x1p-25f, 3 * 0x1p-25f, 1e30f})
        EXPECT_FALSE(is_half(value)) << value;
}

TEST(Grid, SupportIsTight) {
    GridBuilder builder({glm::ivec3(-100), glm::ivec3(100)});
    std::array<float, kBrickVoxels> values{};
    values[1 + 8 * (2 + 8 * 3)] = 1; // voxel (1, 2, 3) of the brick
    builder.set_brick({-12, -3, 4}, values);
    const Grid point = builder.finish();
    EXPECT_EQ(find_support(point).lower, glm::ivec3(-95, -22, 35));
    EXPECT_EQ(find_support(point).upper, glm::ivec3(-95, -22, 35));
    EXPECT_TRUE(find_support(Grid{}).is_empty());
    const VoxelBox box{{-3, 5, -20}, {9, 5, 4}};
    const Grid constant = make_constant_grid(box, 2.5f);
    EXPECT_EQ(find_support(constant).lower, box.lower);
    EXPECT_EQ(find_support(constant).upper, box.upper);
    EXPECT_EQ(constant.max(), 2.5f);
}

TEST(GridBuilder, RefusesWhatIsTooLarge) {
    EXPECT_THROW(GridBuilder({glm::ivec3(-2'000'000'000), glm::ivec3(2'000'000'000)}), Error);
    EXPECT_THROW(GridBuilder({glm::ivec3(0), glm::ivec3(8 * 407)}), Error); // 408^3 > 2^26
    GridBuilder builder({glm::ivec3(0), glm::ivec3(31)}, 2 * kBrickVoxels);
    std::array<float, kBrickVoxels> values{1.0f};
    builder.set_brick({0, 0, 0}, values);
    builder.set_brick({1, 0, 0}, values);
    builder.set_tile({3, 0, 0}, 1);
    EXPECT_THROW(builder.set_brick({2, 0, 0}, values), Error);
}

} // namespace
} // namespace tyndall

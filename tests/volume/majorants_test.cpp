// Majorants against trilinear values at random points.
#include "volume/majorants.h"

#include "volume/fields.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace tyndall {
namespace {

float bound_at(const MajorantGrid& cells, const glm::dvec3& at) {
    const glm::ivec3 cell(glm::floor((at - glm::dvec3(cells.lower)) / double(cells.size)));
    for (int axis = 0; axis < 3; ++axis)
        if (cell[axis] < 0 || cell[axis] >= cells.count[axis]) return 0;
    return cells.bounds[cell.x + cells.count.x * (cell.y + std::size_t(cells.count.y) * cell.z)];
}

/// Points where the field exceeds the bound of its cell.
int exceeded(Random& random, const Grid& grid, const MajorantGrid& cells) {
    int count = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 at = random_point(random, grid.lower(), grid.upper(), 3);
        count += grid.sample(at) > bound_at(cells, at);
    }
    return count;
}

MajorantGrid scaled(MajorantGrid cells, float factor) {
    for (float& bound : cells.bounds)
        bound *= factor;
    return cells;
}

TEST(Majorants, BoundEveryTrilinearValue) {
    Random random(3);
    for (const int size : {1, 2, 3, 4, 8, 13, 16, 64}) {
        const Grid grid = random_bricks(random, {-3, 2, -1}, {4, 3, 5});
        const MajorantGrid cells = build_majorants(grid, size);
        EXPECT_EQ(exceeded(random, grid, cells), 0) << size;
        // Control: every fourth coordinate is on a voxel, where the bound of small cells is
        // reached.
        if (size <= 4) {
            EXPECT_GT(exceeded(random, grid, scaled(cells, 0.99f)), 0) << size;
        }
    }
}

TEST(Majorants, AreTight) {
    Random random(4);
    const Grid grid = random_bricks(random, {-1, 0, 0}, {2, 2, 2});
    const MajorantGrid cells = build_majorants(grid, 4);
    std::size_t at = 0;
    for (int z = 0; z < cells.count.z; ++z)
        for (int y = 0; y < cells.count.y; ++y)
            for (int x = 0; x < cells.count.x; ++x) {
                const glm::ivec3 first = cells.lower + 4 * glm::ivec3(x, y, z);
                float largest = 0;
                for (int k = 0; k < 125; ++k)
                    largest =
                        std::max(largest, grid.value(first + glm::ivec3(k % 5, k / 5 % 5, k / 25)));
                EXPECT_EQ(cells.bounds[at++], largest);
            }
}

TEST(Majorants, EmptyGridsHaveNoCells) {
    EXPECT_TRUE(build_majorants(Grid{}, 8).bounds.empty());
    EXPECT_TRUE(choose_majorants(Grid{}, 1, 1).bounds.empty());
}

TEST(Majorants, ChoiceIsThatOfTheSize) {
    Random random(5);
    const Grid grid = random_bricks(random, {0, -2, 0}, {9, 8, 7});
    const MajorantGrid chosen = choose_majorants(grid, 0.1, 1);
    const MajorantGrid built = build_majorants(grid, chosen.size);
    EXPECT_EQ(chosen.lower, built.lower);
    EXPECT_EQ(chosen.count, built.count);
    EXPECT_EQ(chosen.bounds, built.bounds);
}

TEST(Majorants, CellsShrinkAsTheMediumThickens) {
    Random random(6);
    const Grid grid = make_dense_grid(random_values(random, glm::ivec3(64), 0.01), glm::ivec3(64));
    int previous = 1 << 30;
    for (const double sigma : {0.0, 1e-4, 1e-2, 1.0, 100.0}) {
        const int size = choose_majorants(grid, 1, sigma).size;
        EXPECT_LE(size, previous) << sigma;
        previous = size;
    }
    EXPECT_EQ(choose_majorants(grid, 1, 0).size, 64);
    EXPECT_EQ(previous, 2);
    // Where nothing varies, small cells gain nothing.
    const Grid constant = make_constant_grid({glm::ivec3(0), glm::ivec3(255)}, 1);
    EXPECT_GT(choose_majorants(constant, 1, 1).size, 8);
}

TEST(Majorants, AreBoundedInNumber) {
    GridBuilder builder({glm::ivec3(0), glm::ivec3(3199)});
    builder.set_tile({0, 0, 0}, 1);
    builder.set_tile({399, 399, 399}, 1);
    const MajorantGrid cells = choose_majorants(builder.finish(), 1, 1e9);
    EXPECT_LE(cells.bounds.size(), max_majorant_cells);
    EXPECT_EQ(cells.size, 16);
}

TEST(Majorants, BoundTheExtinctionOfChannels) {
    Random random(7);
    std::array<std::shared_ptr<const Grid>, 3> sigma_a, sigma_s;
    for (int c = 0; c < 3; ++c) {
        sigma_a[c] =
            std::make_shared<const Grid>(random_bricks(random, glm::ivec3(c), glm::ivec3(2)));
        sigma_s[c] =
            std::make_shared<const Grid>(random_bricks(random, glm::ivec3(-c), glm::ivec3(2)));
    }
    const MajorantGrid cells = build_majorants(max_extinction(sigma_a, sigma_s), 2);
    int count = 0, control = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 at = random_point(random, glm::dvec3(-16), glm::dvec3(32), 3);
        for (int c = 0; c < 3; ++c) {
            const double sigma_t = sigma_a[c]->sample(at) + sigma_s[c]->sample(at);
            count += sigma_t > bound_at(cells, at);
            control += sigma_t > 0.99 * bound_at(cells, at);
        }
    }
    EXPECT_EQ(count, 0);
    EXPECT_GT(control, 0);
}

} // namespace
} // namespace tyndall

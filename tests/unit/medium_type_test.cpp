// Types of media and their parameters.
#include "unit/scene_files.h"

#include <gtest/gtest.h>

namespace tyndall {
namespace {

Medium read_one(const std::string& text) {
    return read_world("MakeNamedMedium \"m\" " + text).media.at(0);
}

std::string medium_error(const std::string& text) {
    return world_error("MakeNamedMedium \"m\" " + text);
}

TEST(UniformGrid, HasItsSamplesAtTheCentresOfVoxels) {
    const Medium medium =
        read_world("Translate 10 0 0 Scale 2 2 2\n"
                   "MakeNamedMedium \"m\" \"string type\" \"uniformgrid\"\n"
                   "\"integer nx\" 2 \"integer ny\" 3 \"float density\" [ 0 1 2 3 4 5 ]\n"
                   "\"point3 p0\" [ 1 1 1 ] \"point3 p1\" [ -3 4 2 ]\n"
                   "\"rgb sigma_a\" [ 1 2 3 ] \"float scale\" 2\n")
            .media.at(0);
    EXPECT_EQ(medium.sigma_a, Rgb(2, 4, 6));
    EXPECT_EQ(medium.sigma_s, Rgb(2));
    EXPECT_EQ(medium.world_from_medium * glm::dvec4(1, 1, 1, 1), glm::dvec4(12, 2, 2, 1));
    const auto& density = std::get<GridDensity>(medium.density);
    // p0 and p1 are sorted; voxel (0, 1, 0) is in the middle of the cell from (-3, 2, 1) to (-1, 3,
    // 2).
    const auto index = density.index_from_medium * glm::dvec4(-2, 2.5, 1.5, 1);
    EXPECT_TRUE(is_near(index, glm::dvec4(0, 1, 0, 1)));
    EXPECT_EQ(density.density->value({0, 1, 0}), 2);
    EXPECT_EQ(density.density->value({1, 2, 0}), 5);
    EXPECT_EQ(density.density->value({1, 2, 1}), 0);
    EXPECT_EQ(density.lower, glm::dvec3(-0.5));
    EXPECT_EQ(density.upper, glm::dvec3(1.5, 2.5, 0.5));
    EXPECT_FALSE(density.majorants.bounds.empty());
}

TEST(UniformGrid, IsCutToWhereItHasDensity) {
    const Medium medium = read_one(
        "\"string type\" \"uniformgrid\" \"integer nx\" 8 \"float density\" [ 0 0 0 1 0 0 0 0 ]");
    const auto& density = std::get<GridDensity>(medium.density);
    EXPECT_EQ(density.lower, glm::dvec3(2, -0.5, -0.5));
    EXPECT_EQ(density.upper, glm::dvec3(4, 0.5, 0.5));
    const Medium empty = read_one("\"string type\" \"uniformgrid\" \"float density\" 0");
    EXPECT_TRUE(std::get<GridDensity>(empty.density).density->is_empty());
    EXPECT_EQ(std::get<GridDensity>(empty.density).lower,
              std::get<GridDensity>(empty.density).upper);
}

TEST(UniformGrid, IsChecked) {
    const std::string grid = "\"string type\" \"uniformgrid\" ";
    EXPECT_EQ(medium_error(grid), "medium \"m\" needs a parameter \"float density\"");
    EXPECT_EQ(medium_error(grid + "\"integer nx\" 2 \"float density\" [ 1 2 3 ]"),
              "parameter \"float density\" has 3 values (expected nx ny nz = 2 x 1 x 1 = 2)");
    EXPECT_EQ(medium_error(grid + "\"integer ny\" 2 \"float density\" [ 1 -2 ]"),
              "parameter \"float density\" is -2 at voxel (0, 1, 0) (expected a value >= 0)");
    EXPECT_EQ(medium_error(grid + "\"integer ny\" 0 \"float density\" 1"),
              "parameter \"integer ny\" is 0 (expected a value >= 1)");
    EXPECT_EQ(medium_error(grid + "\"float density\" 1 \"point3 p1\" [ 1 0 1 ]"),
              "medium \"m\": the box from \"p0\" to \"p1\" has no volume (expected two corners "
              "that differ on each "
              "axis)");
}

} // namespace
} // namespace tyndall

// Types of media and their parameters.
#include "unit/scene_files.h"

#include <algorithm>
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

TEST(UniformGrid, Emits) {
    const std::string grid =
        "\"string type\" \"uniformgrid\" \"integer nx\" 2 \"float density\" [ 1 1 ] ";
    const Medium glow = read_one(grid + "\"rgb Le\" [ 1 2 3 ] \"float Lescale\" [ 5 6 ]");
    EXPECT_TRUE(is_near(glow.emission, Rgb(1, 2, 3)));
    EXPECT_EQ(std::get<GridDensity>(glow.density).emission_scale->value({1, 0, 0}), 6);
    EXPECT_FALSE(std::get<GridDensity>(glow.density).temperature);
    const Medium fire =
        read_one(grid + "\"float temperature\" [ 1000 30 ] \"float temperaturecutoff\" 20 "
                        "\"float temperaturescale\" 2");
    EXPECT_EQ(fire.emission, Rgb(1));
    const auto& density = std::get<GridDensity>(fire.density);
    EXPECT_FALSE(density.emission_scale);
    EXPECT_EQ(density.temperature->value({0, 0, 0}), 1960);
    EXPECT_EQ(density.temperature->value({1, 0, 0}), 20);
    EXPECT_EQ(density.temperature->value({2, 0, 0}), -40); // 0 in the array's surroundings
    EXPECT_EQ(medium_error(grid + "\"float temperature\" [ 1 2 ] \"rgb Le\" [ 1 1 1 ]"),
              "medium \"m\" has both \"Le\" and \"temperature\" (expected one of them)");
    EXPECT_EQ(medium_error(grid + "\"float Lescale\" [ 1 2 3 ]"),
              "parameter \"float Lescale\" has 3 values (expected nx ny nz = 2 x 1 x 1 = 2)");
}

TEST(RgbGrid, HasCoefficientsByChannel) {
    const Medium medium =
        read_one("\"string type\" \"rgbgrid\" \"integer nz\" 2 \"float scale\" 2\n"
                 "\"rgb sigma_a\" [ 1 2 3 4 5 6 ] \"rgb Le\" [ 0 0 1 1 0 0 ] \"float Lescale\" 3");
    const auto& density = std::get<GridDensity>(medium.density);
    EXPECT_FALSE(density.density);
    EXPECT_EQ(density.sigma_a[1]->value({0, 0, 0}), 4);
    EXPECT_EQ(density.sigma_a[2]->value({0, 0, 1}), 12);
    EXPECT_EQ(density.sigma_s[0]->value({0, 0, 1}), 2);
    EXPECT_EQ(density.sigma_s[0]->sample(density.upper), 2); // 1 does not fade at the faces
    EXPECT_EQ(density.emission[2]->value({0, 0, 0}), 1);
    EXPECT_TRUE(is_near(medium.emission, Rgb(3 * 106.857), 1e-2));
    EXPECT_EQ(medium.sigma_a, Rgb(1));
    EXPECT_GE(*std::max_element(density.majorants.bounds.begin(), density.majorants.bounds.end()),
              14);
    EXPECT_EQ(density.lower, glm::dvec3(-0.5));
    EXPECT_EQ(medium_error("\"string type\" \"rgbgrid\""),
              "medium \"m\" needs a parameter \"rgb sigma_a\" or \"rgb sigma_s\"");
    EXPECT_EQ(
        medium_error("\"string type\" \"rgbgrid\" \"rgb sigma_s\" [ 1 1 1 ] \"rgb Le\" [ 1 1 1 ]"),
        "medium \"m\" has \"rgb Le\" without \"rgb sigma_a\" (expected both)");
    EXPECT_EQ(medium_error("\"string type\" \"rgbgrid\" \"rgb sigma_s\" [ 1 -1 1 ]"),
              "parameter \"rgb sigma_s\" is -1 at voxel (0, 0, 0) (expected a value >= 0)");
}

TEST(Homogeneous, PresetsAreInPerMillimetre) {
    const Medium apple =
        read_one("\"string type\" \"homogeneous\" \"string preset\" \"Apple\" \"float scale\" 10");
    EXPECT_TRUE(is_near(apple.sigma_a, Rgb(0.03, 0.034, 0.46)));
    EXPECT_TRUE(is_near(apple.sigma_s, Rgb(22.9, 23.9, 19.7)));
    EXPECT_TRUE(
        medium_error("\"string type\" \"homogeneous\" \"string preset\" \"Pear\"")
            .starts_with(
                "parameter \"string preset\" is \"Pear\" (expected one of air, Apple, Chicken1, "));
    EXPECT_EQ(
        medium_error(
            "\"string type\" \"homogeneous\" \"string preset\" \"Coke\" \"rgb sigma_a\" [ 1 1 1 ]"),
        "unused parameter \"rgb sigma_a\" of medium \"m\"");
}

TEST(Exponential, FallsOffWithHeightOrRadius) {
    const Medium plane =
        read_one("\"string type\" \"exponential\" \"float scaleheight\" 8 \"vector3 up\" [ 0 0 2 ] "
                 "\"point3 origin\" [ 1 2 3 ]");
    const auto& flat = std::get<ExponentialDensity>(plane.density);
    EXPECT_FALSE(flat.is_spherical);
    EXPECT_EQ(flat.scale_height, 8);
    EXPECT_EQ(flat.up, glm::dvec3(0, 0, 1));
    EXPECT_EQ(flat.origin, glm::dvec3(1, 2, 3));
    const Medium planet = read_one(
        "\"string type\" \"exponential\" \"float radius\" 6360 \"point3 center\" [ 0 -1 0 ]");
    const auto& round = std::get<ExponentialDensity>(planet.density);
    EXPECT_TRUE(round.is_spherical);
    EXPECT_EQ(round.radius, 6360);
    EXPECT_EQ(round.origin, glm::dvec3(0, -1, 0));
    EXPECT_EQ(medium_error("\"string type\" \"exponential\" \"float scaleheight\" 0"),
              "parameter \"float scaleheight\" is 0 (expected a value > 0)");
    EXPECT_EQ(medium_error("\"string type\" \"exponential\" \"vector3 up\" [ 0 0 0 ]"),
              "medium \"m\": \"up\" has no direction (expected another vector than 0 0 0)");
    EXPECT_EQ(world_error("Scale 1 0 1 MakeNamedMedium \"m\" \"string type\" \"exponential\""),
              "the transformation has no inverse (expected one that keeps three dimensions)");
}

TEST(PhaseFunction, HasFourKinds) {
    using Kind = PhaseFunction::Kind;
    const auto phase = [](const std::string& text) {
        return read_one("\"string type\" \"homogeneous\" \"string phase\" " + text).phases.at(0);
    };
    EXPECT_EQ(phase("\"schlick\" \"float g\" 0.5").kind, Kind::schlick);
    EXPECT_NEAR(phase("\"schlick\" \"float g\" 0.5").k, 1.55 * 0.5 - 0.55 * 0.125, 1e-15);
    EXPECT_EQ(phase("\"schlick\" \"float k\" -0.99").k, -0.99);
    EXPECT_EQ(phase("\"rayleigh\"").kind, Kind::rayleigh);
    EXPECT_EQ(phase("\"isotropic\"").kind, Kind::henyey_greenstein);
    EXPECT_EQ(phase("\"henyey-greenstein\" \"float g\" -1").g, -1);
    const std::string medium = "\"string type\" \"homogeneous\" \"string phase\" ";
    EXPECT_EQ(medium_error(medium + "\"schlick\" \"float g\" 0.95"),
              "parameter \"float g\" is 0.95 (expected |g| < 0.938, where k = 1.55 g - 0.55 g^3 is "
              "below 1; or give "
              "\"float k\")");
    EXPECT_EQ(medium_error(medium + "\"schlick\" \"float k\" 1"),
              "parameter \"float k\" is 1 (expected a value in (-1, 1))");
    EXPECT_EQ(medium_error(medium + "\"rayleigh\" \"float g\" 0.5"),
              "unused parameter \"float g\" of medium \"m\"");
}

} // namespace
} // namespace tyndall

// Procedural clouds.
#include "scene/cloud.h"

#include "unit/scene_files.h"

#include <cmath>
#include <gtest/gtest.h>

namespace tyndall {
namespace {

TEST(Cloud, NoiseIsThatOfPerlin) {
    for (const glm::dvec3 lattice : {glm::dvec3(0), glm::dvec3(3, -7, 250), glm::dvec3(-256, 1, 9)})
        EXPECT_EQ(gradient_noise(lattice), 0);
    // By hand: the gradients at (0..1, 0, 0) give u = +-dx; halfway the weights are 1/2 each.
    const glm::dvec3 p(0.3, 4.6, -2.2);
    EXPECT_NEAR(gradient_noise(p), gradient_noise(p + glm::dvec3(256, -512, 256)), 1e-12);
    // Continuous, with a continuous slope, across a face of its cells.
    const glm::dvec3 face(5, 0.25, 0.75), step(1e-5, 0, 0);
    const double before = (gradient_noise(face) - gradient_noise(face - step)) / 1e-5;
    const double after = (gradient_noise(face + step) - gradient_noise(face)) / 1e-5;
    EXPECT_NEAR(before, after, 1e-3);
    EXPECT_GT(std::abs(before), 1e-2);
}

TEST(Cloud, IsSolidBelowAndClearAbove) {
    for (double x = 0; x < 3; x += 0.37) {
        EXPECT_EQ(cloud_density({x, -0.1, 2 * x}, 1, 1, 5), 1);
        EXPECT_EQ(cloud_density({x, 1, 2 * x}, 1, 1, 5), 0);
    }
}

TEST(Cloud, VoxelsFollowTheFormula) {
    const Scene scene =
        read_world("MakeNamedMedium \"m\" \"string type\" \"cloud\" \"float frequency\" 1 "
                   "\"point3 p1\" [ 1 0.9 1 ] \"rgb sigma_a\" [ 0 0 0 ] \"float g\" 0.5");
    const Medium& medium = scene.media.at(0);
    EXPECT_EQ(medium.phases[0].g, 0.5);
    const auto& density = std::get<GridDensity>(medium.density);
    const auto error_at = [&](double frequency) {
        double worst = 0;
        for (double x = 0; x < 1; x += 0.13) {
            const glm::dvec3 index(std::round(32 * x), 20, 5);
            const glm::dvec3 point(glm::inverse(density.index_from_medium) * glm::dvec4(index, 1));
            worst = std::max(worst, std::abs(density.density->sample(index) -
                                             cloud_density(point, 1, 1, frequency)));
        }
        return worst;
    };
    EXPECT_LT(error_at(1), 1e-6);    // the rounding to float
    EXPECT_GT(error_at(1.01), 1e-4); // control
    // It does not fade at the faces.
    EXPECT_EQ(density.density->sample({5, -0.5, 5}), 1);
    EXPECT_EQ(density.lower, glm::dvec3(-0.5));
}

TEST(Cloud, ResolutionIsBounded) {
    const std::vector<std::string> warnings =
        world_warnings("MakeNamedMedium \"m\" \"string type\" \"cloud\" \"float frequency\" 50 "
                       "\"point3 p1\" [ 1 0.01 0.01 ]");
    EXPECT_EQ(warnings,
              std::vector<std::string>{
                  "scene.pbrt:2:1: warning: medium \"m\" would take 1600 x 16 x 16 voxels; "
                  "it is smoothed to 512 x 16 x 16"});
}

} // namespace
} // namespace tyndall

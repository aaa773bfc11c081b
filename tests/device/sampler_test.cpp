// Sobol' points in place of independent random numbers: the same picture, with less noise.
#include "device/device_test.h"
#include "device/test_scenes.h"

#include <cmath>

namespace tyndall::device_test {
namespace {

using namespace support;

class SamplerTest : public DeviceTest {};

Scene on_sobol_points(Scene scene) {
    scene.sampler = Sampler::sobol;
    return scene;
}

/// A box that absorbs paths or lets them pass, by one random number each, before a sky of 1.
Scene box_of_tosses(double thickness) {
    Scene scene = empty_scene(16, 0.1);
    scene.integrator.absorption = Integrator::Absorption::analog;
    add_shape(scene, box_mesh({-1, -1, 1}, {1, 1, 2}),
              {.inside = add_medium(scene, Rgb(thickness), Rgb(0))});
    add_infinite(scene);
    return scene;
}

/// Furthest from a radiance that a pixel is.
double worst_error(const Scene& scene, std::uint32_t samples, double radiance) {
    double worst = 0;
    for (const Rgb& pixel : colors_of(render(scene, samples)))
        worst = std::max(worst, std::abs(pixel.g - radiance));
    return worst;
}

/// Of 2^m samples, one has its random number in each interval of length 2^-m: all but one of them
/// fall as they should.
TEST_F(SamplerTest, EachPixelHasItsShareOfEachRandomNumber) {
    for (const double thickness : {0.1, 1.0, 3.0})
        for (const std::uint32_t samples : {8u, 64u, 512u}) {
            const Scene scene = box_of_tosses(thickness);
            const double radiance = std::exp(-thickness), most = 1.001 / samples;
            EXPECT_LT(worst_error(on_sobol_points(scene), samples, radiance), most);
            EXPECT_GT(worst_error(scene, samples, radiance), most) << "no teeth";
        }
}

TEST_F(SamplerTest, MeansAreTheSame) {
    for (const Scene& scene : {busy_scene(), plain_scene()}) {
        const Estimate a = mean_of(on_sobol_points(scene), 512), b = mean_of(scene, 512);
        const Estimate difference{a.mean - b.mean, glm::sqrt(a.standard_error * a.standard_error +
                                                             b.standard_error * b.standard_error)};
        expect_mean(difference, 0, 0.05 * b.mean.g);
    }
}

TEST_F(SamplerTest, NoBitDependsOnHowTheWorkIsCutUp) {
    for (const Scene& independent : {busy_scene(), plain_scene()}) {
        const Scene scene = on_sobol_points(independent);
        const auto sums = render_sums(scene, 0, 5);
        EXPECT_NE(render_sums(independent, 0, 5), sums) << "no teeth";
        EXPECT_EQ(render_sums(scene, 0, 5, {.slots = 100}), sums);
        EXPECT_EQ(render_sums(scene, 0, 5, {.run_length = 7}), sums);
        EXPECT_EQ(render_sums(scene, 0, 5, {.workgroup_size = 32}), sums);
    }
}

} // namespace
} // namespace tyndall::device_test

// Sobol' points in place of independent random numbers: the same picture, with less noise.
#include "device/device_test.h"
#include "device/test_scenes.h"

#include <cmath>

namespace tyndall::device_test {
namespace {

using namespace support;

class SamplerTest : public DeviceTest {};

Scene on_points(Sampler sampler, Scene scene, std::uint32_t samples) {
    scene.sampler = sampler;
    scene.samples_per_pixel = static_cast<int>(samples);
    return scene;
}

/// Furthest from a radiance that the mean over a square of pixels is; 16 is the picture.
double worst_error(const Scene& scene, std::uint32_t samples, double radiance,
                   std::size_t side = 1) {
    const std::vector<Rgb> pixels = colors_of(render(scene, samples));
    std::vector<double> squares(256 / (side * side));
    for (std::size_t i = 0; i < 256; ++i)
        squares[i / 16 / side * (16 / side) + i % 16 / side] += pixels[i].g / double(side * side);
    double worst = 0;
    for (const double mean : squares)
        worst = std::max(worst, std::abs(mean - radiance));
    return worst;
}

/// Of 2^m samples, one has its random number in each interval of length 2^-m: all but one of them
/// fall as they should.
TEST_F(SamplerTest, EachPixelHasItsShareOfEachRandomNumber) {
    for (const double thickness : {0.1, 1.0, 3.0})
        for (const std::uint32_t samples : {8u, 64u, 512u}) {
            const Scene scene = box_of_tosses(thickness);
            const double radiance = std::exp(-thickness), most = 1.001 / samples;
            for (const Sampler sampler : {Sampler::sobol, Sampler::zsobol})
                EXPECT_LT(worst_error(on_points(sampler, scene, samples), samples, radiance), most);
            EXPECT_GT(worst_error(scene, samples, radiance), most) << "no teeth";
        }
}

/// In Z order, the same holds for squares of pixels: what is too much in one is missing next to it.
TEST_F(SamplerTest, InZOrderErrorsCancelBetweenNeighbours) {
    constexpr std::uint32_t samples = 4;
    const Scene scene = box_of_tosses(1);
    for (const std::size_t side : {2, 4, 16}) {
        const double most = 1.001 / double(samples * side * side);
        const auto error = [&](Sampler sampler) {
            return worst_error(on_points(sampler, scene, samples), samples, std::exp(-1), side);
        };
        EXPECT_LT(error(Sampler::zsobol), most) << side;
        EXPECT_GT(error(Sampler::sobol), most) << "no teeth: " << side;
    }
}

TEST_F(SamplerTest, MeansAreTheSame) {
    for (const Scene& scene : {busy_scene(), plain_scene()}) {
        const Estimate a = mean_of(on_points(Sampler::sobol, scene, 256), 256),
                       b = mean_of(scene, 256);
        const Estimate difference{a.mean - b.mean, glm::sqrt(a.standard_error * a.standard_error +
                                                             b.standard_error * b.standard_error)};
        expect_mean(difference, 0, 0.05 * b.mean.g);
    }
}

TEST_F(SamplerTest, NoBitDependsOnHowTheWorkIsCutUp) {
    for (const Sampler sampler : {Sampler::sobol, Sampler::zsobol}) {
        const Scene independent = sampler == Sampler::sobol ? busy_scene() : plain_scene();
        const Scene scene = on_points(sampler, independent, 4); // of which there are more
        const auto sums = render_sums(scene, 0, 5);
        EXPECT_NE(render_sums(independent, 0, 5), sums) << "no teeth";
        const Tuning other{.slots = 100, .run_length = 7, .workgroup_size = 32};
        EXPECT_EQ(render_sums(scene, 0, 5, other), sums);
    }
}

} // namespace
} // namespace tyndall::device_test

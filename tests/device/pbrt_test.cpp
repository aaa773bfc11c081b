// Pictures that pbrt-v4 rendered (pbrt/README.md says how, and gives their noise).
#include "device/device_test.h"
#include "scene/reader.h"

#include <cmath>

namespace tyndall::device_test {
namespace {

class PbrtTest : public DeviceTest {
  protected:
    static Scene scene_of(const std::string& name) { return read_scene(path(name) + ".pbrt"); }
    static Image image_of(const std::string& name) { return read_image(path(name) + ".exr"); }

  private:
    static std::string path(const std::string& name) {
        return source_folder() + "/tests/device/pbrt/" + name;
    }
};

Rgb mean_color(const Image& image) {
    Rgb sum(0);
    for (const Rgb& color : colors_of(image))
        sum += color;
    return sum / static_cast<double>(image.width * image.height);
}

/// pbrt's variance per sample of a green pixel of the grey cube. Its absorption ends paths, so a
/// path brings 1 or 0 with the pixel's mean m: m (1 - m). Wavelength sampling adds 0.001 (what the
/// pixels beside the cube scatter by).
double pbrt_variance(double mean) {
    return mean * (1 - mean) + 0.001;
}
constexpr double kPbrtSamples = 4096;

/// How two pictures of the grey cube differ, in standard errors.
struct Structure {
    double mean = 0;     ///< Of the image mean.
    double worst = 0;    ///< Of the worst 8 x 8 block.
    double beyond_3 = 0; ///< Share of the blocks.
};

Structure compare_blocks(const Image& ours, const Image& pbrts) {
    double all = 0, all_variance = 0;
    Structure result;
    const int size = 8;
    for (int y0 = 0; y0 < ours.height; y0 += size) {
        for (int x0 = 0; x0 < ours.width; x0 += size) {
            double sum = 0, variance = 0;
            for (int y = y0; y < y0 + size; ++y) {
                for (int x = x0; x < x0 + size; ++x) {
                    const double mean = ours.at(x, y, 1);
                    sum += mean - pbrts.at(x, y, 1);
                    variance += ours.at(x, y, 4) + pbrt_variance(mean) / kPbrtSamples;
                }
            }
            const double z = std::abs(sum) / std::sqrt(variance);
            result.worst = std::max(result.worst, z);
            result.beyond_3 += z > 3;
            all += sum;
            all_variance += variance;
        }
    }
    result.mean = std::abs(all) / std::sqrt(all_variance);
    result.beyond_3 /= ours.width * ours.height / (size * size);
    return result;
}

constexpr double kPass = support::pass, kReject = support::reject;

TEST_F(PbrtTest, GreyCubeHasTheSameMeanAndNoStructureIsLeft) {
    const Scene scene = scene_of("homogeneous-cube");
    const Image pbrts = image_of("homogeneous-cube");
    const Image ours = render(scene, 1024);
    const double ratio = mean_color(ours).g / mean_color(pbrts).g;
    EXPECT_NEAR(ratio, 1, 0.003); // asked for
    const Structure left = compare_blocks(ours, pbrts);
    EXPECT_LT(left.mean, kPass);
    EXPECT_LT(left.worst, kPass);
    EXPECT_LT(left.beyond_3, 0.01);

    // Controls: 2 % more absorption changes the mean; a phase function that is less forward
    // leaves a structure.
    Scene absorbing = scene;
    absorbing.media[0].sigma_a *= 1.02;
    EXPECT_GT(compare_blocks(render(absorbing, 1024), pbrts).mean, kReject);
    Scene blunt = scene;
    blunt.media[0].phases[0].g = 0.4;
    EXPECT_GT(compare_blocks(render(blunt, 1024), pbrts).worst, kReject);
}

/// pbrt spreads coloured coefficients over wavelengths, which three channels cannot follow exactly.
constexpr double kColoured = 0.02; // asked for

void expect_channel_means(const Image& ours, const Image& pbrts) {
    const Rgb ratio = mean_color(ours) / mean_color(pbrts);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(ratio[c], 1, kColoured) << "channel " << c;
}

bool any_channel_differs(const Image& ours, const Image& pbrts) {
    const Rgb off = glm::abs(mean_color(ours) / mean_color(pbrts) - Rgb(1));
    return std::max({off.r, off.g, off.b}) > kColoured;
}

TEST_F(PbrtTest, ChromaticBallHasTheSameMeans) {
    const Scene scene = scene_of("chromatic-ball");
    const Image pbrts = image_of("chromatic-ball");
    expect_channel_means(render(scene, 64), pbrts);
    // Control: half as much absorption again.
    Scene absorbing = scene;
    absorbing.media[0].sigma_a *= 1.5;
    EXPECT_TRUE(any_channel_differs(render(absorbing, 64), pbrts));
}

TEST_F(PbrtTest, FogRoomHasTheSameMeans) {
    const Scene scene = scene_of("fog-room");
    const Image pbrts = image_of("fog-room");
    const Image ours = render(scene, 96);
    // The tolerance is 4.5 standard errors at least.
    const support::Estimate mean = mean_of(ours);
    for (int c = 0; c < 3; ++c)
        EXPECT_LT(support::pass * mean.standard_error[c], kColoured * mean.mean[c]);
    expect_channel_means(ours, pbrts);
    // Control: fog of twice the density.
    Scene dense = scene;
    dense.media[0].sigma_s *= 2;
    EXPECT_TRUE(any_channel_differs(render(dense, 8), pbrts));
}

} // namespace
} // namespace tyndall::device_test

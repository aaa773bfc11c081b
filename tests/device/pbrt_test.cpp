// Pictures that pbrt-v4 rendered (pbrt/README.md says how, and gives their noise).
#include "device/device_test.h"
#include "scene/reader.h"

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

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

/// How two green pictures differ, in standard errors.
struct Structure {
    double mean = 0;     ///< Of the image mean.
    double worst = 0;    ///< Of the worst 8 x 8 block.
    double beyond_3 = 0; ///< Share of the blocks.
};

/// The noise of both pictures shows in how the differences within a block scatter, so that nothing
/// need be known about pbrt's. Where nothing scatters, pbrt's sampling of wavelengths still leaves
/// 1e-4.
Structure compare_blocks(const Image& ours, const Image& pbrts) {
    constexpr int size = 8;
    constexpr double count = size * size;
    double all = 0, all_variance = 0, blocks = 0;
    Structure result;
    for (int y0 = 0; y0 < ours.height; y0 += size) {
        for (int x0 = 0; x0 < ours.width; x0 += size) {
            double sum = 0, squares = 0, light = 0;
            for (int y = y0; y < y0 + size; ++y) {
                for (int x = x0; x < x0 + size; ++x) {
                    const double difference = double{ours.at(x, y, 1)} - pbrts.at(x, y, 1);
                    sum += difference;
                    squares += difference * difference;
                    light += pbrts.at(x, y, 1);
                }
            }
            const double scatter = (squares - sum * sum / count) * count / (count - 1);
            const double variance = std::max(scatter, 0.0) + std::pow(1e-4 * light, 2);
            const double z = std::abs(sum) / std::sqrt(variance);
            result.worst = std::max(result.worst, z);
            result.beyond_3 += z > 3;
            all += sum;
            all_variance += variance;
            ++blocks;
        }
    }
    result.mean = std::abs(all) / std::sqrt(all_variance);
    result.beyond_3 /= blocks;
    return result;
}

constexpr double kPass = support::pass, kReject = support::reject;

/// A grey scene has pbrt's mean within 0.3 %, and no structure is left in the difference; unlike
/// the scene after each of the changes.
void expect_no_structure(const Scene& scene, const Image& pbrts, std::uint32_t samples,
                         const std::vector<std::function<void(Medium&)>>& changes) {
    const Image ours = render(scene, samples);
    EXPECT_NEAR(mean_color(ours).g / mean_color(pbrts).g, 1, 0.003); // asked for
    const Structure left = compare_blocks(ours, pbrts);
    EXPECT_LT(left.mean, kPass);
    EXPECT_LT(left.worst, kPass);
    EXPECT_LT(left.beyond_3, 0.02); // of 256 blocks; 0.3 % are expected
    for (const auto& change : changes) {
        Scene wrong = scene;
        change(wrong.media[0]);
        const Structure structure = compare_blocks(render(wrong, samples), pbrts);
        EXPECT_GT(std::max(structure.mean, structure.worst), kReject);
    }
}

TEST_F(PbrtTest, GreyCubeHasTheSameMeanAndNoStructureIsLeft) {
    expect_no_structure(
        scene_of("homogeneous-cube"), image_of("homogeneous-cube"), 1024,
        {[](Medium& m) { m.sigma_a *= 1.02; }, [](Medium& m) { m.phases[0].g = 0.4; }});
}

TEST_F(PbrtTest, SmokeGridHasTheSameMeanAndNoStructureIsLeft) {
    expect_no_structure(
        scene_of("smoke-grid"), image_of("smoke-grid"), 192,
        {[](Medium& m) { m.sigma_s *= 0.9; }, [](Medium& m) { m.phases[0].g = 0.1; },
         // by half a voxel
         [](Medium& m) {
             auto& grid = std::get<GridDensity>(m.density);
             grid.index_from_medium =
                 glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0, 0)) * grid.index_from_medium;
         }});
}

TEST_F(PbrtTest, SmokeFromOpenVdbHasTheSameMeanAndNoStructureIsLeft) {
    expect_no_structure(scene_of("vdb-smoke"), image_of("vdb-smoke"), 96,
                        {[](Medium& m) { m.sigma_s *= 0.9; }});
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

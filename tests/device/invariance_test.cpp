// What must not change the picture: units, place, and how the work is cut up.
#include "device/device_test.h"
#include "device/full_scene.h"
#include "device/test_scenes.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::device_test {
namespace {

using namespace support;
using Sums = std::vector<glm::dvec4>;

class InvarianceTest : public DeviceTest {
  protected:
    /// The same picture as without the change, on the same random numbers, up to rounding.
    static void expect_same_picture(const Scene& changed, const Scene& scene,
                                    std::uint32_t samples) {
        expect_agreement(device_batches(changed, samples), device_batches(scene, samples),
                         scene.film.bounds.width());
    }
};

TEST_F(InvarianceTest, UnitsByPowersOfTwoChangeNothing) {
    for (const Scene& scene : {busy_scene(), plain_scene()}) {
        const Sums sums = render_sums(scene, 0, 8);
        for (int exponent : {-13, 20})
            EXPECT_EQ(render_sums(scaled(scene, std::ldexp(1, exponent)), 0, 8), sums) << exponent;
        // Control: a length that does not scale.
        Scene wrong = scaled(scene, std::ldexp(1, 20));
        wrong.media[0].sigma_s *= 1.01;
        EXPECT_NE(render_sums(wrong, 0, 8), sums);
    }
}

TEST_F(InvarianceTest, UnitsFromAtomsToMoons) {
    for (const Scene& scene : {busy_scene(), plain_scene()})
        for (double factor : {1e-4, 1e6})
            expect_same_picture(scaled(scene, factor), scene, 16);
}

TEST_F(InvarianceTest, FarFromTheOrigin) {
    for (const Scene& scene : {busy_scene(), plain_scene()})
        expect_same_picture(moved(scene, translation({1e4, -3e3, 2e4})), scene, 16);
}

TEST_F(InvarianceTest, Turned) { // paths turn about other axes: not the same ones
    for (const Scene& scene : {busy_scene(), plain_scene()}) {
        const Scene turned =
            moved(scene, glm::rotate(translation({50, 20, 10}), 1.1, glm::dvec3(1, 3, 2)));
        const Estimate a = mean_of(turned, 1024), b = mean_of(scene, 1024);
        const Estimate difference{a.mean - b.mean, glm::sqrt(a.standard_error * a.standard_error +
                                                             b.standard_error * b.standard_error)};
        expect_mean(difference, 0, 0.05 * b.mean.g);
    }
}

TEST_F(InvarianceTest, SameSeedSamePicture) {
    for (Scene scene : {busy_scene(), plain_scene()}) {
        const Sums sums = render_sums(scene, 0, 12);
        EXPECT_EQ(render_sums(scene, 0, 12), sums);
        ++scene.seed;
        EXPECT_NE(render_sums(scene, 0, 12), sums);
    }
}

TEST_F(InvarianceTest, SeedsOfMoreThan32Bits) {
    Scene scene = plain_scene();
    const Sums sums = render_sums(scene, 0, 2);
    scene.seed += std::uint64_t{1} << 32;
    EXPECT_NE(render_sums(scene, 0, 2), sums);
}

TEST_F(InvarianceTest, PathsInFlightAndTheirGrouping) {
    for (const Scene& scene : {busy_scene(), plain_scene()}) {
        const Sums sums = render_sums(scene, 0, 5);
        for (std::uint32_t slots : {100u, 1000u, 20000u})
            EXPECT_EQ(render_sums(scene, 0, 5, {.slots = slots}), sums) << slots << " slots";
        for (std::uint32_t run_length : {1u, 7u, 100u})
            EXPECT_EQ(render_sums(scene, 0, 5, {.run_length = run_length}), sums)
                << "run length " << run_length;
        for (std::uint32_t size : {1u, 32u, 128u, 256u})
            EXPECT_EQ(render_sums(scene, 0, 5, {.workgroup_size = size}), sums)
                << "workgroups of " << size;
    }
}

TEST_F(InvarianceTest, StagesInOneKernel) {
    // Which would take gigabytes for the kernel, and keeps to many.
    const bool is_swiftshader = context().info().driver.starts_with("SwiftShader");
    Scene dark = busy_scene(); // nothing scatters, but paths end by collisions
    dark.integrator.absorption = Integrator::Absorption::analog;
    for (Medium& medium : dark.media)
        medium.sigma_a += medium.sigma_s, medium.sigma_s = Rgb(0);
    for (const Scene& scene : {full_scene(), busy_scene(), dark}) {
        Renderer fused(context(), scene, {.run_length = 3, .stages = STAGES_FUSED});
        // Else the kernel, schedule and update_film.
        EXPECT_EQ(fused.wavefront().stages().size() == 3u, !is_swiftshader);
        fused.render(0, 9);
        const Sums sums = fused.read_sums();
        EXPECT_EQ(render_sums(scene, 0, 9, {.stages = STAGES_APART}), sums);
        EXPECT_NE(render_sums(scene, 0, 8, {.stages = STAGES_APART}), sums); // the control
    }
    // Where there is nothing to fuse, nothing is.
    const Renderer plain(context(), plain_scene(), {.stages = STAGES_FUSED});
    EXPECT_EQ(plain.wavefront().tuning().stages, STAGES_APART);
}

TEST_F(InvarianceTest, PartsOfThePicture) {
    for (const Scene& scene : {busy_scene(), plain_scene()}) {
        const Sums whole = render_sums(scene, 0, 10);
        const PixelBounds parts[] = {{0, 7, 0, 16}, {7, 16, 0, 5}, {7, 16, 5, 16}};
        Sums assembled(whole.size());
        for (const PixelBounds& part : parts) {
            Scene cropped = scene;
            cropped.film.bounds = part;
            const Sums sums = render_sums(cropped, 0, 10);
            ASSERT_EQ(sums.size(), static_cast<std::size_t>(part.width() * part.height()));
            for (int y = part.y0; y < part.y1; ++y)
                for (int x = part.x0; x < part.x1; ++x)
                    assembled[static_cast<std::size_t>(y * 16 + x)] =
                        sums[static_cast<std::size_t>((y - part.y0) * part.width() + x - part.x0)];
        }
        EXPECT_EQ(assembled, whole);
    }
}

/// On its way to many samples the film is, bit for bit, what fewer samples would have given.
TEST_F(InvarianceTest, FewerSamplesAreAPrefixOfMore) {
    for (const Scene& scene : {busy_scene(), plain_scene()}) {
        Renderer renderer(context(), scene, {.slots = 256, .run_length = 8});
        std::vector<std::pair<std::uint32_t, Sums>> seen;
        renderer.render(0, 64, [&](const Progress& progress) {
            if (progress.samples > 0 && (seen.empty() || seen.back().first < progress.samples)) {
                const Sums sums =
                    renderer.read_sums(); // may be of later samples than progress knew
                seen.emplace_back(renderer.samples(), sums);
            }
            return true;
        });
        ASSERT_GT(seen.size(), 1);
        for (std::size_t i = 0; i < seen.size(); i += (seen.size() + 3) / 4)
            EXPECT_EQ(render_sums(scene, 0, seen[i].first), seen[i].second)
                << seen[i].first << " samples";
        EXPECT_NE(seen.front().second, seen.back().second);
    }
}

/// Told to stop, the renderer leaves whole batches.
TEST_F(InvarianceTest, StoppingLeavesAPrefix) {
    const Scene scene = plain_scene();
    Renderer renderer(context(), scene, {.slots = 256, .run_length = 8});
    const std::uint32_t samples =
        renderer.render(0, 1u << 20, [](const Progress&) { return false; });
    EXPECT_GT(samples, 0);
    EXPECT_LT(samples, 1u << 20);
    EXPECT_EQ(renderer.samples(), samples);
    EXPECT_EQ(render_sums(scene, 0, samples), renderer.read_sums());
}

} // namespace
} // namespace tyndall::device_test

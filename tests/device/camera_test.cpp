// Cameras: what they see where.
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "scene/reader.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::device_test {
namespace {

using namespace support;

class CameraTest : public DeviceTest {};

constexpr int kPixels = 32;

/// A bright disk of this radius at this distance, straight ahead of a lens.
constexpr double kDisk = 0.02, kDistance = 2.5, kFocus = 4, kFov = 4, kLens = 0.2;

Scene defocused_disk() {
    Scene scene = empty_scene(kPixels);
    scene.camera.kind = Camera::Kind::perspective;
    scene.camera.fov = kFov;
    scene.camera.lens_radius = kLens;
    scene.camera.focal_distance = kFocus;
    add_shape(scene, Disk{.radius = kDisk},
              {.material = black, .area_light = add_area_light(scene, Rgb(1)), .reverse = true},
              translation({0, 0, kDistance}));
    return scene;
}

/// Mean square distance of the light from the middle of the picture, as a tangent.
Estimate mean_square_radius(const Scene& scene) {
    const double pixel = 2 * std::tan(glm::radians(kFov / 2)) / kPixels;
    std::vector<double> values;
    for (const stats::PixelSums& batch : device_batches(scene, 512)) {
        double light = 0, moment = 0;
        for (int y = 0; y < kPixels; ++y)
            for (int x = 0; x < kPixels; ++x) {
                const glm::dvec2 at = pixel * (glm::dvec2(x, y) + 0.5 - kPixels / 2.0);
                const double value = batch[static_cast<std::size_t>(y * kPixels + x)].y;
                light += value;
                moment += value * glm::dot(at, at);
            }
        values.push_back(moment / light);
    }
    double sum = 0, square = 0;
    for (double value : values)
        sum += value, square += value * value;
    const double n = static_cast<double>(values.size());
    return {Rgb(sum / n), Rgb(std::sqrt((square / n - sum / n * sum / n) / (n - 1)))};
}

TEST_F(CameraTest, DefocusHasTheRadiusOfThinLenses) {
    // Each point of the disk is spread over a disk with the tangent R |1/z - 1/f|; the mean square
    // radius of a disk is half its square. Pixels round positions: less a sixth of their square.
    const auto expected = [](double lens) {
        const double pixel = 2 * std::tan(glm::radians(kFov / 2)) / kPixels;
        const double blur = lens * std::abs(1 / kDistance - 1 / kFocus), disk = kDisk / kDistance;
        return (blur * blur + disk * disk) / 2 - pixel * pixel / 6;
    };
    expect_mean(mean_square_radius(defocused_disk()), expected(kLens), expected(1.05 * kLens));
}

TEST_F(CameraTest, InFocusALensChangesNothing) {
    Scene scene = defocused_disk();
    scene.camera.focal_distance = kDistance;
    const double with_lens = mean_square_radius(scene).mean.g;
    scene.camera.lens_radius = 0;
    const Estimate pinhole = mean_square_radius(scene);
    expect_mean(pinhole, with_lens, 2 * with_lens);
}

TEST_F(CameraTest, EveryKindAgreesWithTheReference) {
    for (bool orthographic : {false, true}) {
        for (double lens : {0.0, 0.1}) {
            Scene scene = busy_scene();
            scene.camera.kind =
                orthographic ? Camera::Kind::orthographic : Camera::Kind::perspective;
            scene.camera.screen_window = {-1, 1.25, -0.75, 1};
            scene.camera.screen_window_given = true;
            if (orthographic)
                for (double& edge : scene.camera.screen_window)
                    edge *= 2;
            scene.camera.lens_radius = lens;
            scene.camera.focal_distance = 5;
            expect_agreement(scene, 16);
        }
    }
}

/// Where a small bright ball appears: pictures are not mirrored, and pixels are where they should
/// be.
TEST_F(CameraTest, PixelsLookWhereTheyShould) {
    Scene scene = empty_scene(16, 8);
    scene.camera.world_from_camera = look_at({0, 0, -20}, {0, 0, 0}, {0, 1, 0});
    // In camera space x goes right and y goes up: pixel column 12 is around x = 4.5, row 5 around y
    // = 2.5.
    add_shape(
        scene, full_sphere(0.3), {.material = black, .area_light = add_area_light(scene, Rgb(1))},
        translation(glm::dvec3(scene.camera.world_from_camera * glm::dvec4(4.5, 2.5, 20, 1))));
    const Image film = render(scene, 64);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_EQ(film.at(x, y, 0) > 0, x == 12 && y == 5) << x << ", " << y;
}

} // namespace
} // namespace tyndall::device_test

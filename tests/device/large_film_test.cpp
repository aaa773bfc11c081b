// Films with more texels than small devices put into a texel buffer (65536 is what Vulkan
// guarantees): the same shaders then read storage buffers. Runs the fallback where the device is
// small, as SwiftShader is. And films with more bytes than a storage buffer may have (128 MiB is
// what Vulkan guarantees, and what lavapipe has): they are written as texels.
#include "device/device_test.h"
#include "device/test_scenes.h"

namespace tyndall::device_test {
namespace {

using namespace support;

Scene large(Scene scene) {
    scene.camera.screen_window_given = scene.camera.kind == Camera::Kind::orthographic;
    set_size(scene, 150, 150); // 90000 texels of film
    return scene;
}

class LargeFilmTest : public DeviceTest {};

TEST_F(LargeFilmTest, WithoutAHierarchyAgreesWithTheReference) {
    expect_agreement(large(plain_scene()), 16);
}

TEST_F(LargeFilmTest, WithAHierarchyAgreesWithTheReference) {
    Scene scene = large(busy_scene());
    scene.integrator.max_depth = 3;
    expect_agreement(scene, 16);
}

TEST_F(LargeFilmTest, EveryPixelIsWritten) {
    Scene scene = empty_scene(16);
    set_size(scene, 1600, 1400); // 137 MiB of film
    add_infinite(scene);
    for (const glm::dvec4& sum : render_sums(scene, 0, 1))
        ASSERT_EQ(sum, glm::dvec4(1));
}

} // namespace
} // namespace tyndall::device_test

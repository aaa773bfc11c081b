// Films with more texels than small devices put into a texel buffer (65536 is what Vulkan
// guarantees): the same shaders then read storage buffers. Runs the fallback where the device is
// small, as SwiftShader is.
#include "device/device_test.h"
#include "device/test_scenes.h"

namespace tyndall::device_test {
namespace {

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

} // namespace
} // namespace tyndall::device_test

// The longer tier (label "long"): scenes of eight kinds over 1e8 paths each, of which none may go
// wrong; 1e9 rays in a closed mesh. The rows of the table a hundred times deeper: rows_test.cpp.
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "selftest/cases.h"
#include "support/materials.h"
#include "support/volumes.h"

#include <algorithm>
#include <ostream>

namespace tyndall::stability {
namespace {

using namespace support;
using device_test::context;
using device_test::DeviceTest;
using selftest::Lit;
using selftest::slab_scene;

struct Kind {
    const char* name; ///< Letters, digits and spaces.
    Scene scene;
};
void PrintTo(const Kind& kind, std::ostream* to) {
    *to << kind.name;
}

/// A ball of fog with another, denser one inside, and a third in that.
Scene nested_media() {
    Scene scene = empty_scene(16, 1);
    scene.camera.world_from_camera = translation({0, 0, -4});
    add_infinite(scene);
    int outside = -1;
    for (const double radius : {1.0, 0.7, 0.4}) {
        const int inside = add_medium(scene, Rgb(0.1), Rgb(1 / radius), radius - 0.3);
        add_shape(scene, full_sphere(radius), {.inside = inside, .outside = outside});
        outside = inside;
    }
    return scene;
}

Scene chromatic() {
    Scene scene = slab_scene({0.9, 1, 0.3}, Lit::both_sides);
    scene.media[0].sigma_a *= Rgb(0.1, 1, 10);
    scene.media[0].sigma_s *= Rgb(0.1, 1, 10);
    return scene;
}

Scene emissive_grid() {
    Scene scene = empty_scene(16, 1.2);
    scene.camera.world_from_camera = translation({0, 0, -4});
    const int flame = add_medium(scene, Rgb(0.5), Rgb(1));
    scene.media[0].emission = {3, 2, 1};
    scene.media[0].density = Lattice{{-1, -1, -1}, {1, 1, 1}, {9, 9, 9}}.density(
        [](const glm::ivec3& v) { return (v.x + 2 * v.y + 3 * v.z) % 5; });
    add_shape(scene, full_sphere(2), {.inside = flame});
    return scene;
}

Scene inside_a_cloud() {
    Scene scene = empty_scene(16, 0.5);
    add_infinite(scene);
    scene.camera.medium = add_medium(scene, Rgb(0.01), Rgb(5), 0.85);
    add_shape(scene, full_sphere(1), {.inside = scene.camera.medium});
    return scene;
}

/// The light within the fog, so that its 1 / r^2 is met at any distance.
Scene point_light_in_fog() {
    Scene scene = empty_scene(16, 1);
    scene.camera.world_from_camera = translation({0, 0, -4});
    add_light(scene, PointLight{Rgb(1), {0.1, 0.2, 0.3}});
    add_shape(scene, full_sphere(1), {.inside = add_medium(scene, Rgb(0.1), Rgb(3), 0.5)});
    return scene;
}

Scene scaled_world() {
    return device_test::scaled(nested_media(), 1e6);
}

std::vector<Kind> kinds() {
    return {{"dense forward scattering", slab_scene({0.99, 64, 0.99}, Lit::both_sides)},
            {"nested media", nested_media()},
            {"chromatic", chromatic()},
            {"emissive grid", emissive_grid()},
            {"inside a cloud", inside_a_cloud()},
            {"point light in fog", point_light_in_fog()},
            {"glass with milk", slab_scene({0.9, 2, 0.75, 1.5}, Lit::near_side)},
            {"a world scaled by 1e6", scaled_world()}};
}

class LongStability : public DeviceTest {};

class LongPaths : public DeviceTest, public testing::WithParamInterface<Kind> {};

constexpr double kPaths = 1e8;

TEST_P(LongPaths, DoNotGoWrong) {
    Renderer renderer(context(), GetParam().scene);
    const auto samples = static_cast<std::uint32_t>(kPaths / (16 * 16)) + 1;
    EXPECT_EQ(renderer.render(0, samples), samples);
    for (std::size_t i = 0; i < kHealthNames.size(); ++i)
        EXPECT_EQ(renderer.health()[i], 0) << kHealthNames[i];
}

const auto name_of = [](const auto& info) {
    std::string name = info.param.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
};
INSTANTIATE_TEST_SUITE_P(Kinds, LongPaths, testing::ValuesIn(kinds()), name_of);

TEST_F(LongStability, ABillionRaysStayInAClosedMesh) {
    const Scene scene = device_test::dark_tube();
    EXPECT_EQ(device_test::mean_of(scene, 1'000'000'000 / (256 * 256)).mean, Rgb(0));
}

} // namespace
} // namespace tyndall::stability

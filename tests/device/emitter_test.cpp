// Every shape as a light.
#include "device/device_test.h"
#include "device/test_scenes.h"

#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::device_test {
namespace {

using namespace support;
using Geometry = std::variant<Mesh, Sphere, Disk>;

Mesh patch_mesh() { // saddle-shaped, about the origin, facing +z
    Mesh mesh;
    mesh.positions = {
        {-0.6F, -0.5F, 0.1F}, {0.5F, -0.6F, -0.1F}, {-0.5F, 0.5F, -0.1F}, {0.7F, 0.6F, 0.15F}};
    mesh.patches = {{0, 1, 2, 3}};
    return mesh;
}

Sphere cut_sphere() {
    Sphere sphere = full_sphere(0.5);
    sphere.z_min = -0.3;
    sphere.z_max = 0.4;
    sphere.phi_max = 4.5;
    return sphere;
}

struct EmitterCase {
    const char* name;
    Geometry geometry;
    glm::dmat4 world_from_object{1};
};

std::vector<EmitterCase> emitter_cases() {
    const glm::dmat4 squeezed = scaling({1.2, 0.7, 0.9}); // spheres become ellipsoids
    return {{"triangles", square_mesh(0.5F, 0, 1)},
            {"patch", patch_mesh()},
            {"sphere", full_sphere(0.4)},
            {"ellipsoid", full_sphere(0.4), squeezed},
            {"cut_sphere", cut_sphere()},
            {"disk", Disk{.radius = 0.5}},
            {"annulus", Disk{.radius = 0.6, .inner_radius = 0.3, .phi_max = 5}},
            {"mirrored_disk", Disk{.radius = 0.5}, scaling({-1, 1, 1})},
            {"torus", torus_mesh(8, 6), scaling(glm::dvec3(0.5))}};
}

class EmitterTest : public DeviceTest, public testing::WithParamInterface<EmitterCase> {};

/// The dark scene, lit by one emitter that hangs over it, facing down.
Scene lit_by(const EmitterCase& c, bool two_sided, bool reverse) {
    Scene scene = dark_scene();
    const glm::dmat4 facing_down =
        glm::rotate(translation({0.2, 2, 0.3}), glm::radians(100.0), glm::dvec3(1, 0.2, 0));
    add_shape(scene, c.geometry,
              {.material = black,
               .inside = 0,
               .outside = 0,
               .area_light = add_area_light(scene, {5, 6, 8}, two_sided),
               .reverse = reverse},
              facing_down * c.world_from_object);
    // Some emitters face away, and next to none of their light is seen: the control needs some.
    add_infinite(scene, Rgb(0.5));
    return scene;
}

// A wrong side, normal or density is off by far more than the control.
constexpr std::uint32_t kSamples = 16; // one a batch, or more
constexpr double kTeeth = 0.04;

TEST_P(EmitterTest, AgreesWithTheReference) {
    expect_agreement(lit_by(GetParam(), false, false), kSamples, kTeeth);
}
TEST_P(EmitterTest, TwoSidedAgreesWithTheReference) {
    expect_agreement(lit_by(GetParam(), true, false), kSamples, kTeeth);
}
TEST_P(EmitterTest, ReversedAgreesWithTheReference) {
    expect_agreement(lit_by(GetParam(), false, true), kSamples, kTeeth);
}

INSTANTIATE_TEST_SUITE_P(Shapes, EmitterTest, testing::ValuesIn(emitter_cases()),
                         [](const auto& test) { return std::string(test.param.name); });

/// What a ray sees that meets the middle of an emitter along -z (from its front) or +z.
double seen(const EmitterCase& c, bool from_front, bool two_sided, bool reverse) {
    Scene scene = empty_scene(4, 0.01);
    scene.camera.world_from_camera =
        look_at({0.35, 0.2, from_front ? 3 : -3}, {0.35, 0.2, 0}, {0, 1, 0});
    add_shape(scene, c.geometry,
              {.material = black,
               .area_light = add_area_light(scene, Rgb(2), two_sided),
               .reverse = reverse},
              c.world_from_object);
    const Image film = render(scene, 4);
    EXPECT_LT(mean_of(film).standard_error.g, 1e-8); // 0, if products are rounded before sums
    return film.at(2, 1, 1);
}

class EmittingSideTest : public DeviceTest {};

TEST_F(EmittingSideTest, FlatEmittersShineFromTheSideOfTheirNormal) {
    for (const EmitterCase& c : emitter_cases()) {
        const bool is_flat =
            !std::holds_alternative<Sphere>(c.geometry) && std::string(c.name) != "torus";
        if (!is_flat) continue;
        // Of quadrics, a mirroring transform turns the normal (pbrt's rule): the disk's +z stays
        // its front only without one.
        const bool flipped = std::string(c.name) == "mirrored_disk";
        for (bool reverse : {false, true}) {
            const bool front_shines = reverse == flipped;
            EXPECT_EQ(seen(c, true, false, reverse), front_shines ? 2 : 0) << c.name;
            EXPECT_EQ(seen(c, false, false, reverse), front_shines ? 0 : 2) << c.name;
            EXPECT_EQ(seen(c, true, true, reverse), 2) << c.name;
            EXPECT_EQ(seen(c, false, true, reverse), 2) << c.name;
        }
    }
}

TEST_F(EmittingSideTest, BallsShineOutwards) {
    const EmitterCase ball{"ball", full_sphere(1)};
    for (bool from_front : {false, true}) {
        EXPECT_EQ(seen(ball, from_front, false, false), 2);
        EXPECT_EQ(seen(ball, from_front, false, true), 0);
        EXPECT_EQ(seen(ball, from_front, true, true), 2);
    }
}

} // namespace
} // namespace tyndall::device_test

// Boundaries that touch: two media face to face, a medium that stands on a floor, on a lamp, or in
// the corner of another. Turned in space, so that rounding alone says which face a ray meets first;
// all of them are van de Hulst's slab (selftest/cases.h), cut or laid down in some way.
#include "device/device_test.h"
#include "selftest/cases.h"
#include "support/scenes.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <ostream>

namespace tyndall::stability {
namespace {

using namespace support;
using selftest::Lit;

constexpr double reflected = 0.0973946, transmitted = 0.6609577; // van de Hulst 1980
constexpr float kWide = 30; ///< Half of the width of slabs that are 1 thick.

struct Contact {
    const char* name;
    Scene scene;
    double expected;
};
void PrintTo(const Contact& contact, std::ostream* to) {
    *to << contact.name;
}

/// The camera and the sky of the slab, and its medium, without its boundary.
Scene unbounded() {
    Scene scene = selftest::slab_scene({0.9, 2, 0.75}, Lit::both_sides);
    scene.shapes.clear();
    return scene;
}

/// The part of the slab from z0 to z1. Stretched to its size, as rounding likes it.
void add_layer(Scene& scene, double z0, double z1, const Finish& finish) {
    add_shape(scene, box_mesh(glm::vec3(-1, -1, 0), glm::vec3(1)), finish,
              translation(glm::dvec3(0, 0, z0)) * scaling(glm::dvec3(kWide, kWide, z1 - z0)));
}

Scene turned(Scene scene) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(1, 2, 3));
    for (Shape& shape : scene.shapes)
        shape.world_from_object = turn * shape.world_from_object;
    scene.camera.world_from_camera = turn * scene.camera.world_from_camera;
    return scene;
}

Scene face_to_face() {
    Scene scene = unbounded();
    for (const double z : {0.0, 0.25, 0.5, 0.75})
        add_layer(scene, z, z + 0.25, {.inside = 0});
    return turned(scene);
}

/// A denser box in the same bounds as its surroundings but for one side; then the same medium.
Scene in_the_corner() {
    Scene scene = unbounded();
    add_layer(scene, 0, 1, {.inside = 0});
    add_layer(scene, 0.3, 1, {.inside = 0, .outside = 0});
    return turned(scene);
}

/// On a board, lit or black.
Scene on_a_board(double radiance) {
    Scene scene = unbounded();
    add_layer(scene, 0, 1, {.inside = 0});
    Finish finish{.material = black};
    if (radiance > 0) {
        scene.lights.clear();
        finish.area_light = add_area_light(scene, Rgb(radiance));
    }
    add_shape(scene, square_mesh(2 * kWide, 1, -1), finish);
    return turned(scene);
}

std::vector<Contact> contacts() {
    return {{"face to face", face_to_face(), reflected + transmitted},
            {"in the corner", in_the_corner(), reflected + transmitted},
            {"on a floor", on_a_board(0), reflected},
            {"on a lamp", on_a_board(1), transmitted}};
}

class Contacts : public device_test::DeviceTest, public testing::WithParamInterface<Contact> {};

/// Light that got past a face would be 5 % at least.
TEST_P(Contacts, LeakNothing) {
    const auto& [name, scene, expected] = GetParam();
    device_test::expect_mean(device_test::mean_of(scene, 512), expected, 1.05 * expected);
    const Estimate reference = image_mean(scene, 16, 16);
    EXPECT_LT(reference.z(expected), pass) << reference.mean.g;
}

INSTANTIATE_TEST_SUITE_P(Of, Contacts, testing::ValuesIn(contacts()));

} // namespace
} // namespace tyndall::stability

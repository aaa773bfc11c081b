// Camera and light change places.
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "support/materials.h"
#include "support/phases.h"
#include "support/volumes.h"

#include <cmath>

namespace tyndall::stability {
namespace {

using namespace support;

double uneven(const glm::ivec3& v) {
    return (v.x + 2 * v.y + 3 * v.z) % 4;
}

/// Things of all kinds that scatter into more than one direction, and look the same from no two
/// sides. What mirrors do to light from one direction, paths from the camera cannot find.
Scene still_life() {
    Scene scene = empty_scene(32, 3);
    scene.integrator.max_depth = 1000;
    const int cloud = add_medium(scene, {0.1, 0.3, 0.2}, {3, 2, 4}, 0.7);
    scene.media[0].density = Lattice{{-1, -1, -1}, {1, 1, 1}, {5, 6, 7}}.density(uneven);
    const int fog = add_medium(scene, Rgb(0.05), {0.3, 0.4, 0.5});
    scene.media[1].phases = {weighted(0.5, rayleigh()), weighted(0.5, henyey_greenstein(-0.4))};
    add_shape(scene, full_sphere(2.2), {.inside = fog});
    add_shape(scene, full_sphere(0.8), {.inside = cloud, .outside = fog}, translation({0.9, 0, 0}));
    add_shape(scene, device_test::torus_mesh(16, 8),
              {.material = add_diffuse(scene, {0.8, 0.5, 0.3}), .inside = fog, .outside = fog},
              translation({-0.5, 0.6, -0.4}) * scaling(glm::dvec3(0.7)));
    add_shape(scene, box_mesh({-1, -1.2, -0.8}, {0, -0.6, 0.9}),
              {.material = add_conductor(scene, {0.2, 0.9, 1.1}, {3.9, 2.4, 2.1}, 0.5),
               .inside = fog,
               .outside = fog});
    return scene;
}

/// All of it from one direction, under parallel light from another.
Scene seen_and_lit(const glm::dvec3& eye, const glm::dvec3& sun) {
    Scene scene = still_life();
    scene.camera.world_from_camera = look_at(9.0 * eye, {0, 0, 0}, {0, 0, 1});
    add_light(scene, DistantLight{Rgb(1), -sun});
    return scene;
}

const glm::dvec3 kFront = glm::normalize(glm::dvec3(1, -2, 0.5)),
                 kSide = glm::normalize(glm::dvec3(-2, -1, 1));

template<typename MeanOf>
void expect_reciprocity(const MeanOf& mean_of) {
    const Estimate there = mean_of(seen_and_lit(kFront, kSide));
    const auto z_of = [&](const Estimate& other, int c) {
        return std::abs(there.mean[c] - other.mean[c]) /
               std::hypot(there.standard_error[c], other.standard_error[c]);
    };
    const Estimate back = mean_of(seen_and_lit(kSide, kFront));
    const Estimate elsewhere = mean_of(seen_and_lit(kSide, kSide)); // the control
    for (int c = 0; c < 3; ++c) {
        EXPECT_LT(z_of(back, c), pass) << there.mean[c] << " and " << back.mean[c];
        EXPECT_GT(z_of(elsewhere, c), reject) << "no teeth";
    }
}

class Reciprocity : public device_test::DeviceTest {};

TEST_F(Reciprocity, CameraAndLightChangePlaces) {
    expect_reciprocity([](const Scene& scene) { return device_test::mean_of(scene, 64); });
}

TEST_F(Reciprocity, CameraAndLightChangePlacesInTheReference) {
    expect_reciprocity([](const Scene& scene) { return image_mean(scene, 16, 4); });
}

} // namespace
} // namespace tyndall::stability

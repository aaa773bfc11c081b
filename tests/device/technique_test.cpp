// Estimators that can be chosen: the same expectation where theory says so, and the bias of the
// method where it has one.
#include "core/error.h"
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "support/volumes.h"

#include <cmath>

namespace tyndall::device_test {
namespace {

using namespace support;

class TechniqueTest : public DeviceTest {};

Scene analog(Scene scene) {
    scene.integrator.absorption = Integrator::Absorption::analog;
    return scene;
}
Scene without_light_sampling(Scene scene) {
    scene.integrator.samples_lights = false;
    return scene;
}

/// A glowing cloud on voxels in a ball, and a lamp.
Scene glowing_cloud() {
    Scene scene = empty_scene(16);
    const int medium = add_medium(scene, {0.5, 1, 2}, {2, 3, 4}, 0.3);
    scene.media[0].emission = Rgb(0.3, 0.2, 0.1);
    scene.media[0].density = Lattice{{-1, -1, 2}, {1, 1, 4}, {9, 7, 8}}.density(
        [](const glm::ivec3& v) { return (v.x * v.y + 3 * v.z) % 5 / 4.0; }, 4);
    add_shape(scene, full_sphere(1.4), {.inside = medium}, translation({0, 0, 3}));
    add_shape(scene, square_mesh(2, 6, -1),
              {.material = black, .area_light = add_area_light(scene, {1, 2, 1})});
    add_infinite(scene, Rgb(0.2));
    return scene;
}

/// An absorbing atmosphere that glows, over a plane or a sphere.
Scene glowing_air(bool is_spherical) {
    Scene scene = glowing_cloud();
    scene.media[0].density = ExponentialDensity{.is_spherical = is_spherical,
                                                .origin = {0, is_spherical ? -9 : -1, 0},
                                                .radius = 8,
                                                .scale_height = 0.5};
    return scene;
}

TEST_F(TechniqueTest, AnalogAbsorptionHasTheSameExpectation) {
    Scene glowing = plain_scene(); // without a hierarchy
    glowing.media[0].emission = Rgb(0.5, 1, 2);
    for (const Scene& scene : {glowing, glowing_cloud(), glowing_air(false), glowing_air(true)})
        expect_agreement(device_batches(analog(scene), 64), device_batches(scene, 32),
                         scene.film.bounds.width(), 0.2);
}

/// What absorbs and does not scatter is without noise by weights, and a coin toss without them.
TEST_F(TechniqueTest, AnalogAbsorptionIsNoisyWhereWeightsAreNot) {
    Scene scene = empty_scene(8, 0.1);
    add_slab(scene, add_medium(scene, Rgb(1), Rgb(0)), 1, 2);
    add_infinite(scene);
    expect_mean(mean_of(analog(scene), 512), std::exp(-1), 1.05 * std::exp(-1));
    EXPECT_LT(mean_of(scene, 64).standard_error[1], 1e-9);
    EXPECT_EQ(compute_effects(analog(scene)).features.is_analog, 1);
    scene.media[0].sigma_a = Rgb(0);
    EXPECT_EQ(compute_effects(analog(scene)).features.is_analog, 0); // nothing absorbs
}

TEST_F(TechniqueTest, LightsAreFoundWithoutLightSampling) {
    for (const Scene& scene : {busy_scene(), glowing_cloud()}) {
        const Scene blind = without_light_sampling(scene);
        expect_agreement(device_batches(blind, 64), device_batches(scene, 16),
                         scene.film.bounds.width(), 0.3);
        const Renderer renderer(context(), blind);
        for (const StageKind* stage : renderer.wavefront().stages())
            EXPECT_STRNE(stage->name, "trace_shadow");
    }
}

TEST_F(TechniqueTest, LightsThatNothingRunsIntoAreRefusedByName) {
    Scene scene = without_light_sampling(busy_scene());
    scene.lights.push_back(
        {PointLight{}, {std::make_shared<const std::string>("room.pbrt"), 7, 3}});
    try {
        compute_effects(scene);
        FAIL() << "it was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::bad_input);
        EXPECT_EQ(std::string(error.what()),
                  "room.pbrt:7:3: error: nothing finds a point light without light sampling "
                  "(expected \"bool lightsampling\" true, or lights with a surface)");
    }
}

// A white floor under an absorbing slab of voxels, lit by the sun from the side that the camera
// looks from: radiance = (1 / pi) T, with T of the shadow ray alone.
constexpr int kLayers = 9;
double layer(int z) {
    return 0.2 + z * z / 16.0;
}
Scene lit_through_layers(const Integrator& integrator) {
    Scene scene = empty_scene(4, 0.1);
    scene.integrator = integrator;
    scene.camera.world_from_camera = look_at({0, 0, 4.5}, {0, 0, 5}, {0, 1, 0}); // below the slab
    const int medium = add_medium(scene, Rgb(0.7), Rgb(0));
    scene.media[0].density = Lattice{{-9, -9, 1}, {9, 9, 3}, {3, 3, kLayers}}.density(
        [](const glm::ivec3& v) { return layer(v.z); });
    add_slab(scene, medium, 0.5, 3.5);
    add_shape(scene, square_mesh(9, 5, -1), {.material = add_diffuse(scene, Rgb(1))});
    add_light(scene, DistantLight{Rgb(1), {0, 0, 1}});
    return scene;
}

/// Optical depth by the midpoint rule, of a density that is linear between layers.
double midpoint_depth(int steps) {
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double z = (i + 0.5) / steps * (kLayers - 1);
        const int below = static_cast<int>(z);
        sum += 0.7 * 2 / steps * (layer(below) + (z - below) * (layer(below + 1) - layer(below)));
    }
    return sum;
}

TEST_F(TechniqueTest, MarchedTransmittanceIsTheMidpointRule) {
    const double exact = midpoint_depth(kLayers * 4000 - 4000);
    for (const int steps : {1, 5, 16}) {
        Integrator integrator;
        integrator.transmittance = Integrator::Transmittance::marched;
        integrator.steps = steps;
        const Image film = render(lit_through_layers(integrator), 4);
        const double value = std::exp(-midpoint_depth(steps)) / 3.14159265358979;
        EXPECT_NEAR(film.pixels[0], value, 2e-6 * value) << steps; // rounding of float32
        EXPECT_LT(film.pixels[3], 1e-13 * value * value) << "marching has no noise";
        if (steps < 16) // the control; the layers are linear in between 8 steps
            EXPECT_GT(std::abs(film.pixels[0] - std::exp(-exact) / 3.14159265358979), 2e-5 * value);
        integrator.step_size = 2.0 / steps + 1e-6;
        EXPECT_NEAR(render(lit_through_layers(integrator), 1).pixels[0], value, 2e-6 * value);
    }
    EXPECT_GT(render(lit_through_layers({}), 4).pixels[3], 0) << "tracking has";
}

} // namespace
} // namespace tyndall::device_test

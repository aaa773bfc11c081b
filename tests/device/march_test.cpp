// Single scattering by marching: the order in which it converges, what of it has no noise, and what
// it leaves out.
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "support/volumes.h"

#include <algorithm>
#include <cmath>

namespace tyndall::device_test {
namespace {

using namespace support;
using Placement = Integrator::Placement;

class MarchTest : public DeviceTest {};

Scene marching(Scene scene, int steps, Placement placement = Placement::uniform) {
    scene.integrator.kind = Integrator::Kind::singlescatter;
    scene.integrator.steps = steps;
    scene.integrator.placement = placement;
    return scene;
}

/// An isotropic point light of intensity 1 beside the line of sight, in fog that ends at a wall:
/// sigma_s = 0.5, sigma_t = 1; `expected` by a quadrature of 30 digits.
Scene airlight(double distance) {
    Scene scene = empty_scene(4, 1e-6);
    trace_pixel_centers(scene);
    scene.camera.medium = add_medium(scene, Rgb(0.5), Rgb(0.5));
    add_shape(scene, square_mesh(100, 4, -1), {.material = black});
    add_light(scene, PointLight{Rgb(1), {distance, 0, 2}});
    return scene;
}
constexpr double kAirlight = 0.13634116884132; // at distance 0.1

/// A slab of tau = 1 that scatters isotropically under a distant light of irradiance 1 with cosine
/// 1, seen with cosine 0.5.
Scene lit_slab() {
    Scene scene = empty_scene(4, 1e-6);
    trace_pixel_centers(scene);
    const glm::dvec3 direction(std::sqrt(0.75), 0, 0.5);
    scene.camera.world_from_camera = look_at(-direction, {0, 0, 0}, {0, 1, 0});
    add_slab(scene, add_medium(scene, Rgb(0), Rgb(1)), 0, 1, 1e4);
    add_light(scene, DistantLight{Rgb(1), {0, 0, 1}});
    return scene;
}
constexpr double kSlab = 0.0504103616864;

double value_of(const Scene& scene) {
    return render(scene, 1).pixels[0];
}

/// Where the integrand is smooth, the midpoint rule is of second order in the length of steps: its
/// relative error is (1.5 h)^2 / 24 for the exponential of the slab.
TEST_F(MarchTest, ConvergesWithTheSecondOrder) {
    double coarse = 0;
    for (const int steps : {4, 16, 64}) {
        const double h = 2.0 / steps;
        const double error = value_of(marching(lit_slab(), steps)) / kSlab - 1;
        const double expected = -(1.5 * h) * (1.5 * h) / 24;
        EXPECT_NEAR(error, expected, 0.05 * std::abs(expected) + 2e-6)
            << steps; // next order; rounding
        if (coarse != 0) EXPECT_NEAR(std::log(coarse / error) / std::log(4.0), 2, 0.1) << steps;
        coarse = error;
    }
    // The control: rays that lose nothing on the way to the camera are far brighter.
    EXPECT_GT((1 - std::exp(-1)) / (2 * 3.14159265), 1.5 * value_of(marching(lit_slab(), 64)));
}

TEST_F(MarchTest, HasNoNoiseWhereThePlacesAreFixed) {
    Scene scene = marching(airlight(1), 16), other = scene;
    other.seed = 77;
    EXPECT_EQ(render_sums(scene, 0, 4), render_sums(other, 0, 4));
    scene.integrator.placement = other.integrator.placement = Placement::jittered;
    EXPECT_NE(render_sums(scene, 0, 4), render_sums(other, 0, 4)); // the control
}

/// With random places every number of steps has the same mean in a homogeneous medium.
TEST_F(MarchTest, JitteredAndEquiangularStepsHaveNoBias) {
    const Image equiangular = render(marching(airlight(0.1), 16, Placement::equiangular), 64);
    expect_mean(mean_of(equiangular), kAirlight, 1.05 * kAirlight);
    const Image jittered = render(marching(airlight(0.1), 16, Placement::jittered), 1024);
    expect_mean(mean_of(jittered), kAirlight, 1.3 * kAirlight);
    EXPECT_LT(mean_of(equiangular).standard_error[1], mean_of(jittered).standard_error[1]);
    // The middles of few steps miss the peak.
    EXPECT_GT(std::abs(value_of(marching(airlight(0.1), 16)) - kAirlight), 0.05 * kAirlight);
}

/// Media alone, several lights and a sky: many steps find what paths with one scattering find.
TEST_F(MarchTest, ManyStepsEqualPathsThatScatterOnce) {
    Scene scene = empty_scene(16);
    const int cloud = add_medium(scene, {0.5, 1, 2}, {2, 3, 4}, 0.3);
    scene.media[0].density = Lattice{{-1, -1, 2}, {1, 1, 4}, {9, 7, 8}}.density(
        [](const glm::ivec3& v) { return (v.x * v.y + 3 * v.z) % 5 / 4.0; }, 4);
    const int fog = add_medium(scene, Rgb(0.1), {0.3, 0.2, 0.1}, -0.2);
    add_shape(scene, box_mesh({-2, -2, 0.5f}, {2, 2, 6}), {.inside = fog});
    add_shape(scene, full_sphere(1.4), {.inside = cloud, .outside = fog}, translation({0, 0, 3}));
    add_light(scene, PointLight{Rgb(3), {1.5, 1.5, 2}});
    add_infinite(scene, Rgb(0.2));
    scene.integrator.max_depth = 1;
    const auto paths = device_batches(scene, 128);
    expect_agreement(device_batches(marching(scene, 64), 32), paths, 16, 0.1);
    scene.integrator.max_depth = 3; // the control: more than marching knows of
    const auto longer = device_batches(scene, 32);
    EXPECT_FALSE(stats::test_agreement(longer, paths, 16).agrees);
    Scene once = marching(scene, 8);
    once.integrator.max_depth = 1; // which is all that there is
    EXPECT_EQ(render_sums(marching(scene, 8), 0, 4), render_sums(once, 0, 4));
}

/// Nothing in the picture depends on how the work is cut up.
TEST_F(MarchTest, IsTheSameForAnyRunLength) {
    Scene scene = marching(busy_scene(), 5, Placement::equiangular);
    const auto sums = render_sums(scene, 0, 4);
    EXPECT_EQ(sums, render_sums(scene, 0, 4, {.slots = 100, .run_length = 1, .workgroup_size = 8}));
    scene.integrator.steps = 6; // the control
    EXPECT_NE(sums, render_sums(scene, 0, 4));
}

TEST_F(MarchTest, TakesThePlaceOfTracking) {
    const Renderer renderer(context(), marching(busy_scene(), 4));
    const auto stages = renderer.wavefront().stages();
    const auto has = [&](const std::string& name) {
        return std::any_of(stages.begin(), stages.end(),
                           [&](const StageKind* stage) { return stage->name == name; });
    };
    EXPECT_TRUE(has("march_medium"));
    EXPECT_FALSE(has("shade_volume"));
    EXPECT_EQ(compute_effects(busy_scene()).features.march, 0);
}

} // namespace
} // namespace tyndall::device_test

// Light on surfaces: closed forms of irradiance, shadows, shading normals, and MIS.
#include "support/estimates.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace tyndall::reference {
namespace {

using support::add_area_light;
using support::add_light;
using support::add_shape;
using support::black;
using support::empty_scene;
using support::Estimate;
using support::image_mean;
using support::pass;
using support::reject;
using support::translation;

constexpr double pi = std::numbers::pi;
constexpr double albedo = 0.8;

/// The camera looks along +z at one point of a floor at z = 2 that faces it; one scattering event.
Scene floor_scene() {
    Scene scene = empty_scene(8, 1e-9);
    scene.integrator.max_depth = 1;
    const int material = support::add_diffuse(scene, Rgb(albedo));
    add_shape(scene, support::square_mesh(50, 2, -1), {.material = material});
    return scene;
}

/// A light of radiance 1 behind the camera, moved to z = -1: 3 above the floor.
Scene lit_by(const std::variant<Mesh, Sphere, Disk>& geometry) {
    Scene scene = floor_scene();
    add_shape(scene, geometry, {.material = black, .area_light = add_area_light(scene, Rgb(1))},
              translation({0, 0, -1}));
    return scene;
}

void expect_irradiance(const Scene& scene, double expected) {
    const Estimate estimate = image_mean(scene, 32, 100);
    EXPECT_LT(estimate.z(albedo / pi * expected), pass) << estimate.mean.x * pi / albedo;
    EXPECT_GT(estimate.z(albedo / pi * expected * 1.03), reject);
}

TEST(DirectLight, AreaLightsMatchTheirConfigurationFactors) {
    Disk disk;
    disk.radius = 1.5;
    expect_irradiance(lit_by(disk), pi * 2.25 / (2.25 + 9));
    disk.inner_radius = 1;
    expect_irradiance(lit_by(disk), pi * (2.25 / (2.25 + 9) - 1.0 / (1 + 9)));
    expect_irradiance(lit_by(support::full_sphere(0.9)), pi * 0.81 / 9);
    // A square of half-width a at distance h; Siegel and Howell, configuration factor B-4.
    const double x = 2.0 / 3, root = std::sqrt(1 + x * x);
    const double factor = 4 / (2 * pi) * 2 * (x / root * std::atan(x / root));
    expect_irradiance(lit_by(support::square_mesh(2, 0, 1)), pi * factor);
    Mesh patch;
    patch.positions = {{-2, -2, 0}, {2, -2, 0}, {-2, 2, 0}, {2, 2, 0}};
    patch.patches = {{0, 1, 2, 3}};
    expect_irradiance(lit_by(patch), pi * factor);
    // The lower half of a sphere shines as the whole one.
    Sphere half = support::full_sphere(0.9);
    half.z_min = 0;
    expect_irradiance(lit_by(half), pi * 0.81 / 9);
}

TEST(DirectLight, ManyLightsAddUp) {
    Scene scene = lit_by(Disk{});
    double expected = pi / 10;
    for (int i = 0; i < 5; ++i) {
        const double height = 1 + 0.3 * i; // All of them in front of the disk.
        add_light(scene, PointLight{Rgb(0.1 * i), {0, 0, 2 - height}});
        expected += 0.1 * i / (height * height);
    }
    expect_irradiance(scene, expected);
}

void expect_exactly(const Scene& scene, const Rgb& irradiance) {
    for (const Rgb& color : support::render(scene, 2))
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(color[c], albedo / pi * irradiance[c], 1e-9 * (1e-3 + irradiance[c]));
}

TEST(DirectLight, DeltaLightsHaveNoNoise) {
    Scene point = floor_scene(), distant = floor_scene(), spot = floor_scene();
    add_light(point, PointLight{Rgb(1, 2, 3), {4, 0, -1}}); // At a distance of 5, cosine 3/5.
    expect_exactly(point, Rgb(1, 2, 3) / 25.0 * 0.6);
    add_light(distant, DistantLight{Rgb(3), {0.6, 0, 0.8}});
    expect_exactly(distant, Rgb(2.4));
    add_light(spot, SpotLight{Rgb(2), {0, 0, -1}, {0, 0, 1}, 0.99, 0.9});
    expect_exactly(spot, Rgb(2.0 / 9));
}

TEST(DirectLight, InterfacesAttenuateAndSurfacesBlock) {
    const Rgb sigma_a(0.1, 1, 0), sigma_s(0.4, 1, 0);
    Scene scene = floor_scene();
    add_light(scene, PointLight{Rgb(9), {0, 0, -1}});
    // The camera's own ray must not scatter: the medium is only behind it.
    support::add_slab(scene, support::add_medium(scene, sigma_a, sigma_s), -0.8, -0.3, 10);
    expect_exactly(scene, glm::exp(-0.5 * (sigma_a + sigma_s)));
    const int inner = support::add_medium(scene, Rgb(2), Rgb(0));
    add_shape(scene, support::full_sphere(0.1), {.inside = inner, .outside = 0},
              translation({0, 0, -0.5}));
    expect_exactly(scene, glm::exp(-0.3 * (sigma_a + sigma_s)) * std::exp(-0.4));
    add_shape(scene, support::full_sphere(0.01), {.material = black}, translation({0, 0, -0.1}));
    expect_exactly(scene, Rgb(0));
}

/// The floor says that fog is above it, although the camera's ray came through none.
TEST(DirectLight, ReflectedRaysAreInTheMediumOfTheirSide) {
    Scene scene = floor_scene();
    const int fog = support::add_medium(scene, Rgb(0.1, 0.2, 0.4), Rgb(0));
    scene.shapes[0].media = {.inside = -1, .outside = fog};
    add_light(scene, PointLight{Rgb(9), {0, 0, -1}});
    support::add_infinite(scene); // Unbounded fog hides it.
    expect_exactly(scene, glm::exp(-3.0 * scene.media[0].sigma_a));
}

TEST(DirectLight, FloorsAreLitOnTheSideThatIsSeen) {
    Scene scene = floor_scene();
    add_light(scene, PointLight{Rgb(9), {0, 0, 5}});
    expect_exactly(scene, Rgb(0));
    add_light(scene, DistantLight{Rgb(1), {0, 0, -1}});
    expect_exactly(scene, Rgb(0));
}

TEST(DirectLight, ShadingNormalsTiltTheCosine) {
    Scene scene = floor_scene();
    Mesh& mesh = std::get<Mesh>(scene.shapes[0].geometry);
    mesh.normals.assign(4, {3, 0, -4});
    add_light(scene, DistantLight{Rgb(1), {0, 0, 1}});
    expect_exactly(scene, Rgb(0.8));
    mesh.normals.assign(4, {-3, 0, 4}); // Turned around: the same surface.
    expect_exactly(scene, Rgb(0.8));
}

/// Inside of an emitting, diffuse sphere: Le (1 + rho + rho^2 + ...). The roulette takes
/// part in all but the first reflection at rho = 0.7: without its factors, more than 0.005 would be
/// missing.
TEST(IntegratingSphere, SumsTheGeometricSeries) {
    for (const double rho : {0.2, 0.7}) {
        Scene scene = empty_scene(8);
        scene.camera.kind = Camera::Kind::perspective;
        const int material = support::add_diffuse(scene, Rgb(rho));
        add_shape(
            scene, support::full_sphere(3),
            {.material = material, .area_light = add_area_light(scene, Rgb(1)), .reverse = true},
            translation({0.5, 1, -0.3}));
        const Estimate estimate = image_mean(scene, 32, 1200);
        EXPECT_LT(estimate.z(1 / (1 - rho)), pass) << estimate.mean.x;
        EXPECT_GT(estimate.z(1 / (1 - rho) - 0.005), reject);
    }
}

/// The same surroundings once as an infinite light, found by escaping, once as an emitting sphere,
/// found by both: a diffuse ball over a ball of a chromatic medium.
TEST(Mis, SampledAndUnsampledSurroundingsAgree) {
    Scene base = empty_scene(8);
    const int medium = support::add_medium(base, {0.1, 0.2, 0.5}, {1, 2, 4}, 0.7);
    const int material = support::add_diffuse(base, {0.9, 0.5, 0.2});
    add_shape(base, support::full_sphere(1), {.inside = medium}, translation({0, 0, 5}));
    add_shape(base, support::full_sphere(0.4),
              {.material = material, .inside = medium, .outside = medium},
              translation({0.2, 0.1, 4.9}));
    Scene infinite = base, sphere = base;
    support::add_infinite(infinite, {1, 2, 3});
    add_shape(
        sphere, support::full_sphere(20),
        {.material = black, .area_light = add_area_light(sphere, {1, 2, 3}), .reverse = true});
    const Estimate a = image_mean(infinite, 32, 150), b = image_mean(sphere, 32, 150);
    for (int c = 0; c < 3; ++c) {
        const double error = std::hypot(a.standard_error[c], b.standard_error[c]);
        EXPECT_LT(std::abs(a.mean[c] - b.mean[c]), pass * error);
        EXPECT_GT(0.03 * a.mean[c], reject * error);
    }
}

/// A ball by the cone in which it is seen, and all but a ball by its area: the same light in fog.
TEST(Mis, ConeAndAreaSamplingAgree) {
    const auto mean_with = [](double stretch) {
        Scene scene = floor_scene();
        scene.integrator.max_depth = 3;
        const int fog = support::add_medium(scene, Rgb(0.05), Rgb(0.2), 0.5);
        scene.camera.medium = fog;
        add_shape(scene, support::full_sphere(1), {.inside = fog});
        add_shape(scene, support::full_sphere(0.5),
                  {.material = black, .area_light = add_area_light(scene, Rgb(1))},
                  translation({1.5, 0, 0.5}) * support::scaling({1, 1, stretch}));
        return image_mean(scene, 32, 400);
    };
    const Estimate cone = mean_with(1), area = mean_with(1 + 1e-6);
    const double error = std::hypot(cone.standard_error.x, area.standard_error.x);
    EXPECT_LT(std::abs(cone.mean.x - area.mean.x), pass * error);
    EXPECT_GT(0.05 * cone.mean.x, reject * error);
}

} // namespace
} // namespace tyndall::reference

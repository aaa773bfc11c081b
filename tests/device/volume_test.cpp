// Media whose density varies: grids, atmospheres, and grids that shine.
#include "support/volumes.h"

#include "device/device_test.h"
#include "device/test_scenes.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::device_test {
namespace {

using namespace support;

constexpr double kPi = 3.14159265358979323846;

class VolumeTest : public DeviceTest {};

double one(const glm::ivec3&) {
    return 1;
}
double uneven(const glm::ivec3& v) {
    return (v.x * v.y + 3 * v.z) % 5 / 4.0;
}

/// A cloud in a ball, turned and stretched, lit by the sky, the sun and a lamp.
Scene cloud_scene(bool instanced) {
    Scene scene = empty_scene(16);
    scene.camera.kind = Camera::Kind::perspective;
    scene.camera.fov = 40;
    scene.camera.world_from_camera = look_at({0, 1, -4}, {0, 0, 0}, {0, 1, 0});
    scene.integrator.max_depth = 30;
    const int medium = add_medium(scene, {0.1, 0.3, 0.2}, {2, 5, 8}, 0.5);
    GridDensity density = Lattice{{-1, -1.5, -1}, {1, 1, 1}, {9, 7, 12}}.density(uneven, 4);
    scene.media[0].density = density;
    const glm::dmat4 place =
        glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(1, 2, 3)) * scaling({1.2, 0.8, 1});
    if (instanced) {
        scene.objects.push_back({"cloud", {make_shape(full_sphere(1.4), {.inside = medium})}});
        scene.instances.push_back({0, translation({-0.8, 0, 0}) * place});
        scene.instances.push_back({0, translation({0.8, 0, 1}) * place});
    } else {
        scene.media[0].world_from_medium = place;
        add_shape(scene, full_sphere(1.4), {.inside = medium}, place);
    }
    add_shape(scene, square_mesh(4, 2.5, -1), {.material = add_diffuse(scene, {0.4, 0.6, 0.5})});
    add_light(scene, PointLight{Rgb(20), {2, 3, -2}});
    add_light(scene, DistantLight{{1, 2, 3}, glm::normalize(glm::dvec3(1, -2, 1))});
    add_infinite(scene, {0.3, 0.4, 0.5});
    return scene;
}

TEST_F(VolumeTest, GridsAgreeWithTheReference) {
    expect_agreement(cloud_scene(false), 32, 0.04);
    expect_agreement(cloud_scene(true), 32, 0.04);
}

TEST_F(VolumeTest, ChannelGridsAgreeWithTheReference) {
    Scene scene = cloud_scene(false);
    set_channel_grids(
        scene.media[0], {{-1, -1.5, -1}, {1, 1, 1}, {9, 7, 12}},
        [](const glm::ivec3& v) { return 0.2 * uneven(v) * Rgb(1, 0, 2); },
        [](const glm::ivec3& v) { return Rgb(v.x, 3, 10 * (v.z % 2)); });
    expect_agreement(scene, 32, 0.04);
}

TEST_F(VolumeTest, ShadowRaysThroughTwoGridsMultiply) {
    expect_mean(mean_of(scene_behind_two_grids(), 4096), kBehindTwoGrids, 1.05 * kBehindTwoGrids);
}

/// The middle of a grid that is 1 everywhere is the homogeneous medium: the slab tables of van de
/// Hulst.
Scene constant_slab(bool reflectance) {
    Scene scene = empty_scene(16);
    const int medium = add_medium(scene, Rgb(0.1), Rgb(0.9), 0.75); // optical depth 2
    scene.media[0].density = Lattice{{-1e3, -1e3, 1}, {1e3, 1e3, 3}, {4, 5, 12}}.density(one);
    add_slab(scene, medium, 0.5, 3.5);
    add_shape(scene, square_mesh(1e6F, reflectance ? 4.0F : -1.0F, 1), {.material = black});
    add_infinite(scene);
    return scene;
}

TEST_F(VolumeTest, ConstantGridsReflectAndTransmitAsSlabsDo) {
    expect_mean(mean_of(constant_slab(true), 1024), 0.0973946, 1.08 * 0.0973946);
    expect_mean(mean_of(constant_slab(false), 512), 0.6609577, 1.02 * 0.6609577);
}

/// What is left of a light behind; scattering is fatal.
Scene transmission_scene(
    const std::variant<std::monostate, GridDensity, ExponentialDensity>& density,
    const Rgb& sigma_s) {
    Scene scene = empty_scene(16);
    scene.integrator.max_depth = 0;
    const int medium = add_medium(scene, Rgb(0), sigma_s);
    scene.media[0].density = density;
    add_slab(scene, medium, 1, 4);
    add_infinite(scene);
    return scene;
}

TEST_F(VolumeTest, LinearDensityTransmitsItsClosedForm) {
    const Lattice lattice{{-2, -2, 1}, {2, 2, 4}, {3, 4, 31}};
    const GridDensity density =
        lattice.density([&](const glm::ivec3& v) { return 0.5 + 0.2 * (lattice.place(v).z - 1); });
    const Rgb sigma(0.2, 1, 2);
    const Estimate seen = mean_of(transmission_scene(density, sigma), 1024);
    for (int c = 0; c < 3; ++c) // 0.0907179532894125 for sigma 1 (ORACLES: k = 0.2, t = 3)
        expect_mean(seen, std::exp(-2.4 * sigma[c]), std::exp(-2.6 * sigma[c]), c);
}

TEST_F(VolumeTest, ExponentialDensityTransmitsItsClosedForm) {
    // h = 0.5 where the ray starts, at a slope m; scale height 2, over a length of 3.
    const struct {
        double m, depth;
    } cases[] = {{1, 1.21005367924192},
                 {0.1, 2.16961474071531},
                 {0, 2.33640234921421},
                 {-0.5, 3.47968195051489}};
    for (const auto& [m, depth] : cases) {
        ExponentialDensity density;
        density.up = {std::sqrt(1 - m * m), 0, m};
        density.origin = glm::dvec3(0, 0, 1) - 0.5 * density.up;
        density.scale_height = 2;
        Scene scene = transmission_scene(density, Rgb(1));
        scene.camera.screen_window = {-1e-4, 1e-4, -1e-4, 1e-4};
        expect_mean(mean_of(scene, 1024), std::exp(-depth), std::exp(-1.1 * depth));
    }
}

/// A ray past a planet: the density along a chord, integrated in double.
TEST_F(VolumeTest, AtmospheresOfPlanetsTransmitTheirIntegral) {
    constexpr double radius = 6.36e6, height = 8000, least = 3000, sigma = 2e-6;
    Scene scene = empty_scene(8, 1);
    scene.integrator.max_depth = 0;
    scene.camera.world_from_camera = translation({0, radius + least, -2e6});
    scene.camera.medium = add_medium(scene, Rgb(0), Rgb(sigma));
    ExponentialDensity density;
    density.is_spherical = true;
    density.radius = radius;
    density.scale_height = height;
    scene.media[0].density = density;
    add_infinite(scene);
    double depth = 0;
    constexpr double step = 100;
    for (double z = -2e6 + step / 2; z < 4e6; z += step)
        depth += sigma * step * std::exp(-(std::hypot(radius + least, z) - radius) / height);
    expect_mean(mean_of(scene, 1024), std::exp(-depth), std::exp(-1.1 * depth));
}

TEST_F(VolumeTest, AtmospheresAgreeWithTheReference) {
    for (bool spherical : {false, true}) {
        Scene scene = cloud_scene(false);
        ExponentialDensity density;
        density.is_spherical = spherical;
        density.radius = 0.3;
        density.scale_height = 0.4;
        density.up = glm::normalize(glm::dvec3(1, 3, -1));
        scene.media[0].density = density;
        expect_agreement(scene, 32, 0.04);
    }
}

TEST_F(VolumeTest, EmissionAndAbsorptionOfASlab) {
    Scene scene = empty_scene(16);
    add_medium(scene, Rgb(0.3, 1, 3), Rgb(0));
    scene.media[0].emission = Rgb(2);
    scene.media[0].density = Lattice{{-10, -10, 1}, {10, 10, 2}, {4, 5, 12}}.density(one);
    add_slab(scene, 0, 0.5, 2.5);
    const Estimate seen = mean_of(scene, 512);
    for (int c = 0; c < 3; ++c) {
        const double depth = scene.media[0].sigma_a[c];
        expect_mean(seen, -2 * std::expm1(-depth), -2 * std::expm1(-1.1 * depth), c);
    }
}

/// A small thin flame over a floor: its light as that of a point of the same intensity.
Scene flame_scene(int max_depth) {
    Scene scene = empty_scene(8, 0.01);
    scene.integrator.max_depth = max_depth;
    scene.camera.world_from_camera = look_at({1, 1, 0}, {0, 0, 0}, {0, 1, 0});
    add_medium(scene, Rgb(1e-3, 2e-3, 1e-3), Rgb(0));
    scene.media[0].emission = Rgb(1e6);
    const Lattice lattice{{-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}, {5, 5, 5}};
    GridDensity density = lattice.density(one);
    // Only one voxel shines: a trilinear tent of the volume of a voxel.
    density.emission_scale =
        lattice.grid([](const glm::ivec3& v) { return v == glm::ivec3(2, 2, 2) ? 3 : 0; });
    scene.media[0].density = density;
    scene.media[0].world_from_medium = translation({0, 2, 0});
    add_shape(scene, full_sphere(0.5), {.inside = 0}, translation({0, 2, 0}));
    const int floor = add_diffuse(scene, Rgb(0.5));
    add_shape(scene, square_mesh(3, 0, 1), {.material = floor},
              glm::rotate(glm::dmat4(1), -kPi / 2, glm::dvec3(1, 0, 0)));
    return scene;
}

TEST_F(VolumeTest, GridsShineAsLights) {
    const Estimate seen = mean_of(flame_scene(1), 64);
    const double volume = std::pow(0.02 / 4, 3), intensity = 1e3 * 3 * volume;
    const double expected = 0.5 / kPi * intensity / 4;
    // The tent is 0.005 wide and 2 away: (0.005 / 2)^2 is nothing.
    expect_mean(seen, expected, 1.02 * expected, 0);
    expect_mean(seen, 2 * expected, 2.04 * expected, 1);
}

TEST_F(VolumeTest, FlamesAgreeWithTheReference) {
    for (const bool hot : {false, true}) {
        Scene scene = cloud_scene(false);
        scene.lights.clear();
        auto& density = std::get<GridDensity>(scene.media[0].density);
        const Lattice lattice{{-1, -1.5, -1}, {1, 1, 1}, {9, 7, 12}};
        scene.media[0].emission = hot ? Rgb(0.01) : Rgb(3, 2, 1);
        if (hot)
            density.temperature = lattice.grid([](const glm::ivec3& v) { return 300.0 * v.y; });
        else
            density.emission_scale =
                lattice.grid([](const glm::ivec3& v) { return v.y == 3 ? 1.0 : 0.0; });
        expect_agreement(scene, 64, 0.06);
    }
}

/// No path may weigh more than 3, the bound of one-sample spectral MIS.
TEST_F(VolumeTest, HundredToOneHasNoFireflies) {
    Scene scene = empty_scene(16);
    add_medium(scene, Rgb(0), {0.3, 3, 30}, 0.5);
    scene.media[0].density = Lattice{{-1, -1, 4}, {1, 1, 6}, {9, 9, 9}}.density(uneven);
    add_shape(scene, full_sphere(1), {.inside = 0}, translation({0, 0, 5}));
    add_infinite(scene);
    for (const Rgb& color : colors_of(render(scene, 1)))
        EXPECT_LE(std::max({color.r, color.g, color.b}), 3 * (1 + 1e-4));
    const Estimate seen = mean_of(scene, 256);
    for (int c = 0; c < 3; ++c)
        expect_mean(seen, 1, 1.05, c);
}

} // namespace
} // namespace tyndall::device_test

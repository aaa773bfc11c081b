#include "selftest/cases.h"

#include "scene/by_hand.h"
#include "volume/majorants.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace tyndall::selftest {
namespace {

using namespace by_hand;

constexpr float kHalfWidth = 1e4F; ///< Of slabs that are 1 thick.

/// A ball of radius 1, or other geometry, under a sky of radiance 1.
Scene lit_scene(int pixels = 16) {
    Scene scene = empty_scene(pixels, 1.2);
    scene.integrator.max_depth = std::numeric_limits<int>::max(); // paths end by physics
    scene.camera.world_from_camera = translation({0, 0, -4});
    add_infinite(scene);
    return scene;
}

Scene ball(double sigma_a, double sigma_s, double g) {
    Scene scene = lit_scene();
    add_shape(scene, full_sphere(1), {.inside = add_medium(scene, Rgb(sigma_a), Rgb(sigma_s), g)});
    return scene;
}

/// As hot as its surroundings.
Scene isothermal_ball() {
    Scene scene = ball(0.1, 0.9, 0.5);
    scene.media[0].emission = Rgb(1);
    return scene;
}

Scene absorbing_box(double depth) {
    Scene scene = lit_scene();
    add_shape(scene, box_mesh({-2, -2, 0}, {2, 2, 1}),
              {.inside = add_medium(scene, Rgb(depth), Rgb(0))});
    return scene;
}

/// A box that glows 36 orders of magnitude apart in its channels, before nothing.
Scene glowing_box() {
    Scene scene = absorbing_box(2);
    scene.lights.clear();
    scene.media[0].emission = {1e18, 1, 1e-18};
    return scene;
}

/// A density of 1 on voxels that fill the slab, with majorants of their own.
GridDensity constant_density() {
    constexpr glm::ivec3 count{4, 4, 12};
    GridDensity density;
    const glm::dvec3 size = glm::dvec3(count - 1) / glm::dvec3(2 * kHalfWidth, 2 * kHalfWidth, 1);
    density.index_from_medium = scaling(size) * translation({kHalfWidth, kHalfWidth, 0});
    density.upper = glm::dvec3(count - 1);
    const std::vector<float> ones(std::size_t{4} * 4 * 12, 1.0F);
    density.density = std::make_shared<const Grid>(make_dense_grid(ones, count));
    density.majorants = build_majorants(*density.density, 3);
    return density;
}

Scene grid_slab(const Slab& slab, Lit lit) {
    Scene scene = slab_scene(slab, lit);
    scene.media[0].density = constant_density();
    return scene;
}

Scene chromatic_slab() {
    Scene scene = slab_scene({0.9, 1, 0}, Lit::both_sides);
    scene.media[0].sigma_a = 0.1 * Rgb(1, 2, 10);
    scene.media[0].sigma_s = 0.9 * Rgb(1, 2, 10);
    return scene;
}

/// One scattering of the light of a point 5 ahead and 1 aside, before a black wall 10 away.
Scene point_light_in_fog() {
    Scene scene = empty_scene(16, 1e-6);
    scene.integrator.max_depth = 1;
    const int fog = add_medium(scene, Rgb(0), Rgb(0.2), 0.75);
    scene.camera.medium = fog;
    add_shape(scene, square_mesh(50, 10, -1), {.material = black, .inside = fog, .outside = fog});
    add_light(scene, PointLight{Rgb(1), {1, 0, 5}});
    return scene;
}

/// A grey wall under parallel light that comes in at 60 degrees.
Scene lambert_wall() {
    Scene scene = empty_scene(16);
    add_shape(scene, square_mesh(50, 10, -1), {.material = add_diffuse(scene, Rgb(0.5))});
    add_light(scene, DistantLight{Rgb(1), {std::sqrt(0.75), 0, 0.5}});
    return scene;
}

/// Nothing but a sky of 0.1: what a plain sum in float32 would drift away from.
Scene dim_sky() {
    Scene scene = empty_scene(4);
    add_infinite(scene, Rgb(0.1));
    return scene;
}

} // namespace

Scene slab_scene(const Slab& slab, Lit lit) {
    Scene scene = lit_scene();
    const int medium =
        add_medium(scene, Rgb(slab.tau * (1 - slab.albedo)), Rgb(slab.tau * slab.albedo), slab.g);
    const int glass = static_cast<int>(scene.materials.size());
    scene.materials.push_back({.kind = Material::Kind::dielectric, .eta = Rgb(slab.index)});
    const int surface = slab.index == 1 ? interface : glass;
    add_shape(scene, box_mesh({-kHalfWidth, -kHalfWidth, 0}, {kHalfWidth, kHalfWidth, 1}),
              {.material = surface, .inside = medium});
    if (lit != Lit::both_sides) // a screen, four times as wide
        add_shape(scene, square_mesh(4 * kHalfWidth, lit == Lit::far_side ? -9.0F : 9.0F, 1),
                  {.material = black});
    return scene;
}

Scene in_units(Scene scene, double factor) {
    for (Shape& shape : scene.shapes)
        shape.world_from_object = scaling(glm::dvec3(factor)) * shape.world_from_object;
    glm::dvec4& eye = scene.camera.world_from_camera[3];
    eye = glm::dvec4(factor * glm::dvec3(eye), 1);
    for (double& edge : scene.camera.screen_window)
        edge *= factor;
    for (Medium& medium : scene.media) {
        medium.sigma_a /= factor;
        medium.sigma_s /= factor;
    }
    return scene;
}

std::vector<Case> cases() {
    constexpr Slab van_de_hulst{0.9, 2, 0.75}; // 1980; digits by adding and doubling
    constexpr double reflected = 0.0973946, transmitted = 0.6609577;
    const double lambert = 0.25 / std::numbers::pi, depth_2 = std::exp(-2.0);
    return {
        {"film: 2^20 samples of 0.1", dim_sky(), 1u << 20, Rgb(0.1), 1e-6},
        {"absorption, depth 2", absorbing_box(2), 64, Rgb(depth_2)},
        {"absorption, depth 1e-8", absorbing_box(1e-8), 64, Rgb(1), 2e-7},
        {"glow of 1e18, 1 and 1e-18", glowing_box(), 64, (1 - depth_2) * Rgb(1e18, 1, 1e-18)},
        {"furnace: conservative ball, g 0.9", ball(0, 10, 0.9), 64, Rgb(1)},
        {"furnace: hot ball, albedo 0.9", isothermal_ball(), 64, Rgb(1), 1e-5},
        {"slab, reflected and transmitted", slab_scene(van_de_hulst, Lit::both_sides), 2048,
         Rgb(reflected + transmitted)},
        {"slab in units of 1e-6", in_units(slab_scene(van_de_hulst, Lit::both_sides), 1e6), 2048,
         Rgb(reflected + transmitted)},
        {"slab in units of 1e6", in_units(slab_scene(van_de_hulst, Lit::both_sides), 1e-6), 2048,
         Rgb(reflected + transmitted)},
        {"slab, reflected", slab_scene(van_de_hulst, Lit::near_side), 2048, Rgb(reflected)},
        {"slab on voxels, transmitted", grid_slab(van_de_hulst, Lit::far_side), 512,
         Rgb(transmitted)},
        {"slab of glass, reflected", slab_scene({1, 10, 0, 1.5}, Lit::near_side), 256,
         Rgb(0.7756944), 1e-5},
        {"slab by channel, depths 1, 2, 10",
         chromatic_slab(),
         2048,
         {0.8590354, 0.7181496, 0.4205471}},
        {"point light in fog, one scattering", point_light_in_fog(), 1024, Rgb(0.020095438946)},
        {"grey wall at 60 degrees", lambert_wall(), 16, Rgb(lambert)},
    };
}

} // namespace tyndall::selftest

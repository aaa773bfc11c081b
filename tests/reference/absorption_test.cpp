// Absorption and emission without scattering: closed forms, pixel by pixel, without noise.
#include "support/estimates.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace tyndall::reference {
namespace {

using support::add_infinite;
using support::add_medium;
using support::add_shape;
using support::empty_scene;
using support::translation;

constexpr int pixels = 16;

/// Distance of a pixel centre from the axis, for a picture of [-half, half]^2.
double off_axis(int pixel, double half) {
    const double x = (pixel % pixels + 0.5) / pixels * 2 - 1,
                 y = (pixel / pixels + 0.5) / pixels * 2 - 1;
    return half * std::hypot(x, y);
}

double chord(double radius, double distance) {
    return distance < radius ? 2 * std::sqrt(radius * radius - distance * distance) : 0;
}

/// Everything that the camera sees along its axis is at z around 5.
Scene centered_scene(double half) {
    Scene scene = empty_scene(pixels, half);
    support::trace_pixel_centers(scene);
    return scene;
}

const Rgb sigma(0.1, 1, 3);

TEST(Absorption, SphereTransmitsExactly) {
    Scene scene = centered_scene(1.1);
    const int medium = add_medium(scene, sigma, Rgb(0));
    add_shape(scene, support::full_sphere(1), {.inside = medium}, translation({0, 0, 5}));
    add_infinite(scene, Rgb(2));
    const auto image = support::render(scene, 1);
    for (int i = 0; i < pixels * pixels; ++i) {
        for (int c = 0; c < 3; ++c) {
            const double expected = 2 * std::exp(-sigma[c] * chord(1, off_axis(i, 1.1)));
            EXPECT_NEAR(image[static_cast<std::size_t>(i)][c], expected, 1e-11 * expected);
        }
    }
}

/// Any shape will do as a boundary: a box, two squares, a patch as the lid.
TEST(Absorption, SlabsTransmitExactly) {
    const auto expect_slab = [](const Scene& scene, double length, double tolerance = 1e-12) {
        for (const Rgb& color : support::render(scene, 2))
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(color[c], std::exp(-sigma[c] * length), tolerance);
    };
    Scene base = centered_scene(1);
    const int medium = add_medium(base, sigma, Rgb(0));
    add_infinite(base);
    Scene box = base, squares = base, mixed = base, thin = base;
    add_shape(box, support::box_mesh({-2, -2, 1}, {2, 2, 3}), {.inside = medium});
    expect_slab(box, 2);
    support::add_slab(squares, medium, 1, 3, 10);
    expect_slab(squares, 2);
    Mesh patch;
    patch.positions = {{-9, -9, 1}, {9, -9, 1}, {-9, 9, 1}, {9, 9, 1}};
    patch.patches = {{0, 1, 2, 3}};
    add_shape(mixed, patch, {.inside = -1, .outside = medium}); // Its normal is +z.
    Disk disk;
    disk.radius = 5;
    add_shape(mixed, disk, {.inside = medium}, translation({0, 0, 3}));
    expect_slab(mixed, 2);
    add_shape(thin, support::box_mesh({-1e4f, -1e4f, 1}, {1e4f, 1e4f, 1.5f}), {.inside = medium});
    expect_slab(thin, 0.5, 1e-9); // Rays leave a surface by 64 roundings of its coordinates.
}

TEST(Absorption, NestedMediaAddUp) {
    Scene scene = centered_scene(0.7);
    const int outer = add_medium(scene, sigma, Rgb(0));
    const int inner = add_medium(scene, 2.0 * sigma, Rgb(0));
    add_shape(scene, support::full_sphere(2), {.inside = outer}, translation({0, 0, 5}));
    add_shape(scene, support::full_sphere(0.5), {.inside = inner, .outside = outer},
              translation({0, 0, 5.5}));
    // A surface with the same medium on both sides changes nothing.
    add_shape(scene, support::full_sphere(0.2), {.inside = outer, .outside = outer},
              translation({0, 0, 4}));
    add_infinite(scene);
    const auto image = support::render(scene, 1);
    for (int i = 0; i < pixels * pixels; ++i) {
        const double in = chord(0.5, off_axis(i, 0.7)), out = chord(2, off_axis(i, 0.7)) - in;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(image[static_cast<std::size_t>(i)][c], std::exp(-sigma[c] * (out + 2 * in)),
                        1e-11);
    }
}

TEST(Absorption, CameraInsideStartsInItsMedium) {
    Scene scene = centered_scene(1);
    scene.camera.kind = Camera::Kind::perspective;
    scene.camera.world_from_camera = translation({3, 4, 5});
    scene.camera.medium = add_medium(scene, sigma, Rgb(0));
    add_shape(scene, support::full_sphere(2), {.inside = scene.camera.medium},
              translation({3, 4, 5}));
    add_infinite(scene);
    for (const Rgb& color : support::render(scene, 1))
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(color[c], std::exp(-2 * sigma[c]), 1e-12);
}

/// Le (1 - exp(-sigma_a d)) + background exp(-sigma_a d), also for depths that 1 - exp would lose.
TEST(Emission, HomogeneousSlabMatchesItsClosedForm) {
    Scene scene = centered_scene(1);
    const int medium = add_medium(scene, {1e-9, 0.5, 40}, Rgb(0));
    scene.media[0].emission = {1e9, 3, 2};
    support::add_slab(scene, medium, 1, 3, 10);
    add_infinite(scene, Rgb(0.25));
    const Rgb depth = 2.0 * scene.media[0].sigma_a;
    for (const Rgb& color : support::render(scene, 1)) {
        EXPECT_NEAR(color.x, 0.25 + 2 - 2e-9 * (1 + 0.25), 1e-11);
        for (int c = 1; c < 3; ++c)
            EXPECT_NEAR(color[c],
                        -scene.media[0].emission[c] * std::expm1(-depth[c]) +
                            0.25 * std::exp(-depth[c]),
                        1e-12);
    }
}

TEST(Absorption, UnboundedMediaHideTheSky) {
    Scene scene = centered_scene(1);
    scene.camera.medium = add_medium(scene, {0, 1, 1e-9}, Rgb(0));
    scene.media[0].emission = {5, 2, 3};
    add_infinite(scene, Rgb(7));
    for (const Rgb& color : support::render(scene, 1))
        EXPECT_EQ(color, Rgb(7, 2, 3));
}

TEST(Absorption, PathIntegratorIgnoresMedia) {
    Scene scene = centered_scene(1);
    scene.integrator.kind = Integrator::Kind::path;
    scene.camera.medium = add_medium(scene, sigma, Rgb(2));
    support::add_slab(scene, scene.camera.medium, 1, 3);
    add_infinite(scene, Rgb(7));
    for (const Rgb& color : support::render(scene, 2))
        EXPECT_EQ(color, Rgb(7));
}

} // namespace
} // namespace tyndall::reference

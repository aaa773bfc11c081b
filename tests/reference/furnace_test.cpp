// Uniform illumination: furnaces, mean path lengths, and spheres.
#include "support/estimates.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace tyndall::reference {
namespace {

using support::add_infinite;
using support::add_medium;
using support::add_shape;
using support::empty_scene;
using support::Estimate;
using support::image_mean;
using support::pass;
using support::reject;
using support::translation;

/// A ball of radius 1 before the camera, in a picture that it fills up to the corners.
Scene ball_scene(const Rgb& sigma_a, const Rgb& sigma_s, double g) {
    Scene scene = empty_scene(8);
    const int medium = add_medium(scene, sigma_a, sigma_s, g);
    add_shape(scene, support::full_sphere(1), {.inside = medium}, translation({0, 0, 5}));
    return scene;
}

/// The disc's share of the picture.
constexpr double disc = std::numbers::pi / 4;

TEST(Furnace, EverySampleIsOneWithoutAbsorption) {
    for (const double g : {-0.9, 0.0, 0.99}) {
        for (const bool inside : {false, true}) {
            Scene scene = ball_scene(Rgb(0), Rgb(5), g);
            if (inside) scene.camera.world_from_camera = translation({0, 0, 5});
            if (inside) scene.camera.medium = 0;
            // A second, nested medium and a thin, wide one.
            add_medium(scene, Rgb(0), Rgb(40), 0.5);
            add_shape(scene, support::full_sphere(0.5), {.inside = 1, .outside = 0},
                      translation({0, 0.2, 5}));
            add_shape(scene, support::box_mesh({-1e4f, -1e4f, 7}, {1e4f, 1e4f, 7.1f}),
                      {.inside = 1});
            add_infinite(scene);
            for (const Rgb& color : support::render(scene, 1))
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(color[c], 1, 1e-11);
        }
    }
}

TEST(Furnace, ChromaticScatteringKeepsOneOnAverage) {
    Scene scene = ball_scene(Rgb(0), {0.3, 3, 30}, 0.5);
    add_infinite(scene);
    const Estimate estimate = image_mean(scene, 32, 200);
    for (int c = 0; c < 3; ++c) {
        EXPECT_LT(estimate.z(1, c), pass);
        EXPECT_GT(estimate.z(1.02, c), reject);
    }
}

/// Emission sigma_a B in surroundings of radiance B: nothing is to be seen.
TEST(Furnace, IsothermalMediaAreInvisible) {
    for (const Rgb& sigma_s : {Rgb(0), Rgb(2), Rgb(0.2, 2, 9)}) {
        Scene scene = ball_scene({3, 0.5, 1}, sigma_s, 0.6);
        scene.media[0].emission = Rgb(1.5);
        add_infinite(scene, Rgb(1.5));
        const Estimate estimate = image_mean(scene, 32, 60);
        for (int c = 0; c < 3; ++c) {
            EXPECT_LT(estimate.z(1.5, c), pass) << sigma_s.x << ' ' << c;
            if (sigma_s.x != 2) continue;
            EXPECT_GT(estimate.z(1.52, c), reject);
        }
    }
}

/// Blanco and Fournier 2003: the mean length of paths through a body in uniform light is 4 V / S,
/// whatever it scatters. A body that emits 1 per length and hardly absorbs shows the length.
TEST(PathLength, IsFourVolumesOverSurface) {
    for (const auto& [sigma_s, g] :
         {std::pair(0.0, 0.0), std::pair(4.0, 0.0), std::pair(10.0, 0.9)}) {
        Scene scene = ball_scene(Rgb(1e-9), Rgb(sigma_s), g);
        scene.media[0].emission = Rgb(1e9);
        const Estimate estimate = image_mean(scene, 32, 100);
        EXPECT_LT(estimate.z(disc * 4 / 3), pass) << estimate.mean.x;
        EXPECT_GT(estimate.z(1.05 * disc * 4 / 3), reject);
    }
}

/// Absorbed share of isotropic light, from the Peierls integral equation; [albedo][radius].
TEST(Sphere, AbsorbsWhatTheIntegralEquationSays) {
    struct Row {
        double albedo, radius, absorbed;
    };
    for (const Row& row : {Row{0, 1, 0.7030029248549}, Row{0.5, 1, 0.4577429},
                           Row{0.9, 5, 0.3765154}, Row{0.99, 2, 0.0260805}}) {
        Scene scene =
            ball_scene(Rgb((1 - row.albedo) * row.radius), Rgb(row.albedo * row.radius), 0);
        add_infinite(scene);
        const Estimate estimate = image_mean(scene, 32, 100);
        EXPECT_LT(estimate.z(1 - disc * row.absorbed), pass) << row.albedo << ' ' << row.radius;
        EXPECT_GT(estimate.z(1 - disc * (row.absorbed + 0.02)), reject);
    }
}

} // namespace
} // namespace tyndall::reference

// Phase functions in scenes: a beam, and the weights of chromatic scattering.
#include "reference/phase.h"
#include "reference/quadrature.h"
#include "support/estimates.h"
#include "support/phases.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace tyndall::reference {
namespace {

using support::Estimate;
using support::image_mean;

int add_medium(Scene& scene, const Rgb& sigma_a, const Rgb& sigma_s,
               std::vector<PhaseFunction> phases) {
    const int index = support::add_medium(scene, sigma_a, sigma_s);
    scene.media.back().phases = std::move(phases);
    return index;
}

std::vector<PhaseFunction> chromatic_haze() {
    return {support::weighted(0.4, support::rayleigh()),
            support::weighted(0.6, support::mie({3, 5, 9}, 1.333))};
}

/// What a camera that looks along +z through a slab of thickness 1 sees of light at the angle theta
/// to its view, scattered once.
Estimate beam(double theta, double sigma, const std::vector<PhaseFunction>& phases) {
    Scene scene = support::empty_scene(8, 1e-6);
    scene.integrator.max_depth = 1;
    scene.camera.world_from_camera = support::look_at({0, 0, -1}, {0, 0, 0}, {0, 1, 0});
    support::add_slab(scene, add_medium(scene, Rgb(0), Rgb(sigma), phases), 0, 1, 1e4);
    // Light travels against the direction in which it is seen.
    support::add_light(scene, DistantLight{Rgb(1), {0, -std::sin(theta), -std::cos(theta)}});
    return image_mean(scene, 32, 100);
}

/// Light that is ahead is seen by forward scattering, by each channel with its own phase function.
TEST(PhaseScene, BeamsGoForward) {
    constexpr double sigma = 0.2;
    for (const auto& phases : {chromatic_haze(), {support::schlick(0.8)}, {support::mie(50, 1.4)}})
        for (const double theta : {0.1, 1.0, 2.5}) {
            const double mu = std::cos(theta);
            const double column = integrate(
                [&](double z) {
                    return sigma * std::exp(-sigma * (z + (mu > 0 ? (1 - z) / mu : z / -mu)));
                },
                0, 1);
            const Estimate seen = beam(theta, sigma, phases);
            for (int c = 0; c < 3; ++c) {
                const auto expected = [&](double angle) {
                    return column * evaluate_phase(phases, 1 - std::cos(angle))[c];
                };
                EXPECT_LT(seen.z(expected(theta), c), support::pass) << theta << ' ' << c;
                EXPECT_GT(seen.z(expected(pi - theta), c), support::reject) << "no teeth";
            }
        }
}

/// Lit from everywhere, a medium that only scatters is invisible; the hero's weights must average
/// to 1.
TEST(PhaseScene, ChromaticScatteringKeepsTheFurnace) {
    Scene scene = support::empty_scene(8, 0.5);
    support::add_infinite(scene);
    support::add_shape(scene, support::full_sphere(1),
                       {.inside = add_medium(scene, Rgb(0), Rgb(2, 1, 0.5), chromatic_haze())},
                       support::translation({0, 0, 3}));
    const Estimate e = image_mean(scene, 32, 200);
    for (int c = 0; c < 3; ++c) {
        EXPECT_LT(e.z(1, c), support::pass) << e.mean[c];
        EXPECT_GT(e.z(1.02, c), support::reject) << "no teeth";
    }
}

/// An emitter in the haze is found by light sampling and by chance; without scattering onto it by
/// chance (a point light of the same power far from it all) there is only light sampling.
TEST(PhaseScene, BothWaysToAnEmitterAgree) {
    const auto scene_with = [](bool sampled) {
        Scene scene = support::empty_scene(8, 0.2);
        scene.integrator.max_depth = 3;
        scene.camera.medium = add_medium(scene, Rgb(0.05), Rgb(0.3, 0.2, 0.1), chromatic_haze());
        if (sampled) {
            support::add_light(scene, PointLight{Rgb(pi * 0.01 * 0.01), {1, 0, 5}});
        } else {
            const int light = support::add_area_light(scene, Rgb(1));
            support::add_shape(scene, support::full_sphere(0.01),
                               {.material = support::black, .area_light = light},
                               support::translation({1, 0, 5}));
        }
        return image_mean(scene, 32, 400);
    };
    const Estimate a = scene_with(true), b = scene_with(false);
    for (int c = 0; c < 3; ++c) {
        const double error = std::hypot(a.standard_error[c], b.standard_error[c]);
        EXPECT_LT(std::abs(a.mean[c] - b.mean[c]), support::pass * error);
        EXPECT_GT(std::abs(a.mean[c] - 1.3 * b.mean[c]), support::reject * error) << "no teeth";
    }
}

} // namespace
} // namespace tyndall::reference

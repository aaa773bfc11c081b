// One scattering event between a light and the camera: closed forms and quadratures of 30 digits.
#include "support/estimates.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace tyndall::reference {
namespace {

using support::add_light;
using support::add_medium;
using support::add_shape;
using support::empty_scene;
using support::Estimate;
using support::image_mean;
using support::pass;
using support::reject;

struct Airlight {
    double sigma_s, sigma_t, g, distance, along, length, expected;
};

/// An isotropic point light of intensity 1 beside the line of sight, in fog that ends at a wall.
TEST(SingleScattering, AirlightMatchesItsQuadrature) {
    for (const Airlight& row : {Airlight{0.2, 0.2, 0, 1, 5, 10, 0.012125968538925},
                                Airlight{0.2, 0.2, 0.75, 1, 5, 10, 0.020095438946198},
                                Airlight{0.2, 0.2, -0.5, 1, 5, 10, 0.010190605923703},
                                Airlight{0.5, 1, 0, 0.1, 2, 4, 0.13634116884132}}) {
        Scene scene = empty_scene(16, 1e-6);
        scene.integrator.max_depth = 1;
        scene.camera.medium =
            add_medium(scene, Rgb(row.sigma_t - row.sigma_s), Rgb(row.sigma_s), row.g);
        add_shape(scene, support::square_mesh(100, static_cast<float>(row.length), -1),
                  {.material = support::black});
        add_light(scene, PointLight{Rgb(1), {row.distance, 0, row.along}});
        const Estimate estimate = image_mean(scene, 32, 150);
        EXPECT_LT(estimate.z(row.expected), pass) << estimate.mean.x << " for " << row.expected;
        EXPECT_GT(estimate.z(1.1 * row.expected), reject);
    }
}

TEST(SingleScattering, NothingScattersWithoutScattering) {
    Scene scene = empty_scene(4);
    scene.camera.medium = add_medium(scene, Rgb(1), Rgb(0));
    add_light(scene, PointLight{Rgb(1), {1, 0, 5}});
    for (const Rgb& color : support::render(scene, 4))
        EXPECT_EQ(color, Rgb(0));
}

/// Camera that looks along a direction with cosine mu to +z at a slab 0 <= z <= 1 around the
/// origin.
Scene slab_scene(double mu, bool from_below) {
    Scene scene = empty_scene(8, 1e-6);
    scene.integrator.max_depth = 1;
    const double sine = std::sqrt(1 - mu * mu);
    const glm::dvec3 direction(sine, 0, from_below ? -mu : mu);
    const glm::dvec3 entry(0, 0, from_below ? 1 : 0);
    scene.camera.world_from_camera = support::look_at(entry - direction, entry, {0, 1, 0});
    support::add_slab(scene, add_medium(scene, Rgb(0), Rgb(1)), 0, 1, 1e4);
    return scene;
}

struct Direct {
    double mu0, mu, reflected, transmitted;
};

/// Irradiance 1 on a plane across the beam; isotropic, albedo 1, tau 1.
TEST(SingleScattering, SlabUnderADistantLightMatchesItsClosedForm) {
    for (const Direct& row : {Direct{1, 0.999999999, 0.0344039159475, 0.0292749157622},
                              Direct{1, 0.5, 0.0504103616864, 0.0370105522225},
                              Direct{0.5, 0.5, 0.0390599796567, 0.0215392793018},
                              Direct{0.1, 0.5, 0.0132628304342, 0.00269150670983}}) {
        const DistantLight light{Rgb(1), {0, std::sqrt(1 - row.mu0 * row.mu0), row.mu0}};
        Scene above = slab_scene(row.mu, false), below = slab_scene(row.mu, true);
        add_light(above, light);
        add_light(below, light);
        const Estimate r = image_mean(above, 32, 200), t = image_mean(below, 32, 200);
        EXPECT_LT(r.z(row.reflected), pass) << r.mean.x << " for " << row.reflected;
        EXPECT_LT(t.z(row.transmitted), pass) << t.mean.x << " for " << row.transmitted;
        EXPECT_GT(r.z(1.05 * row.reflected), reject);
        EXPECT_GT(t.z(1.05 * row.transmitted), reject);
    }
}

/// Scattering straight ahead is no scattering: no light may be sampled, and what is hit counts
/// whole.
TEST(SingleScattering, ForwardDeltaIsTransparent) {
    Scene scene = empty_scene(4, 0.1);
    support::add_slab(scene, add_medium(scene, Rgb(0), Rgb(3), 1), 1, 3, 10);
    const int light = support::add_area_light(scene, Rgb(2, 3, 4), true);
    add_shape(scene, support::square_mesh(1, 5, 1),
              {.material = support::black, .area_light = light});
    for (const Rgb& color : support::render(scene, 4))
        EXPECT_EQ(color, Rgb(2, 3, 4));
}

} // namespace
} // namespace tyndall::reference

// Density that falls off exponentially, above a plane and around a sphere; emission of tracked
// media.
#include "reference/exponential.h"
#include "reference/quadrature.h"
#include "reference/sampling.h"
#include "scene/blackbody.h"
#include "scene/spectrum.h"
#include "support/estimates.h"
#include "support/scenes.h"
#include "support/volumes.h"

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

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Column {
    double rise, t, column;
};

/// ORACLES: sigma 1, scale height 2, start 0.5.
const std::vector<Column> columns = {{1, 3, 1.21005367924192},         {0.5, 3, 1.64368536759985},
                                     {0.1, 3, 2.16961474071531},       {0.001, 3, 2.33465092327473},
                                     {0, 3, 2.33640234921421},         {-0.5, 3, 3.47968195051489},
                                     {0.1, infinity, 15.5760156614281}};

TEST(ExponentialLine, MatchesKnownColumnsAndInvertsThem) {
    for (const Column& row : columns) {
        const ExponentialLine line{0.5, row.rise, 2};
        EXPECT_NEAR(line.column(row.t), row.column, 1e-13 * row.column);
        EXPECT_GT(std::abs(ExponentialLine{0.51, row.rise, 2}.column(row.t) - row.column),
                  1e-3); // Control.
        if (row.t < infinity) {
            EXPECT_NEAR(line.distance(row.column), row.t, 1e-12);
        }
        if (row.rise > 0) {
            EXPECT_EQ(line.distance(1.0001 * line.column(infinity)), infinity);
        }
    }
}

/// From far above to far below the plane, level and nearly so: finite where the truth is, and never
/// a NaN.
TEST(ExponentialLine, IsStableAtExtremes) {
    for (const double start : {-1e4, -700.0, 0.0, 700.0, 1e4}) {
        for (const double rise : {-1.0, -1e-300, 0.0, 1e-300, 1e-12, 1.0}) {
            const ExponentialLine line{start, rise, 1};
            double before = 0;
            for (const double t : {0.0, 1e-300, 1.0, 1e4, 1e300, infinity}) {
                EXPECT_GE(line.column(t), before) << start << ' ' << rise << ' ' << t;
                before = line.column(t);
            }
            before = 0;
            for (const double column : {0.0, 1e-300, 1e-9, 1.0, 20.0, infinity}) {
                EXPECT_GE(line.distance(column), before) << start << ' ' << rise << ' ' << column;
                before = line.distance(column);
            }
        }
    }
    // Straight down from where the density itself is out of range.
    EXPECT_NEAR((ExponentialLine{1e4, -1, 1}.distance(1)), 1e4, 1e-9);
    EXPECT_NEAR((ExponentialLine{1e4, -1, 1}.column(1e4 + 1)), std::exp(1.0), 1e-9);
    EXPECT_NEAR((ExponentialLine{0, 1e-9, 1}.column(3)), 3 - 4.5e-9, 1e-15);
}

/// Camera at height 0.5 that looks along a line that rises by `rise`, to a white wall at t = 3.
Scene plane_scene(double rise, const Rgb& sigma_a, const Rgb& sigma_s) {
    Scene scene = empty_scene(8, 1e-9);
    scene.integrator.max_depth = 0;
    const dvec3 direction(0, rise, std::sqrt(1 - rise * rise)), eye(7, 0.5, 11);
    scene.camera.world_from_camera = support::look_at(eye, eye + direction, {1, 0, 0});
    scene.camera.medium = add_medium(scene, sigma_a, sigma_s);
    scene.media[0].density = ExponentialDensity{.up = {0, 1, 0}, .scale_height = 2};
    add_shape(
        scene, support::square_mesh(1, 3, 1),
        {.material = support::black, .area_light = support::add_area_light(scene, Rgb(1), true)},
        scene.camera.world_from_camera);
    return scene;
}

TEST(ExponentialPlane, AbsorbsAndEmitsInClosedForm) {
    for (const Column& row : columns) {
        if (row.t == infinity) continue;
        Scene scene = plane_scene(row.rise, {1, 0.1, 3}, Rgb(0));
        scene.media[0].emission = {0, 2, 5};
        const Rgb color = support::render(scene, 1)[0];
        for (int c = 0; c < 3; ++c) {
            const double depth = scene.media[0].sigma_a[c] * row.column;
            const double expected =
                std::exp(-depth) - scene.media[0].emission[c] * std::expm1(-depth);
            EXPECT_NEAR(color[c], expected, 1e-8); // The picture is 2e-9 wide.
        }
    }
}

TEST(ExponentialPlane, FlightsFollowTheColumn) {
    for (const double rise : {0.5, -0.5, 0.0}) {
        const Scene scene = plane_scene(rise, Rgb(0), {0.3, 0.6, 1});
        const Estimate estimate = image_mean(scene, 32, 200);
        const double column = ExponentialLine{0.5, rise, 2}.column(3);
        for (int c = 0; c < 3; ++c) {
            const double expected = std::exp(-scene.media[0].sigma_s[c] * column);
            EXPECT_LT(estimate.z(expected, c), pass) << rise << ' ' << c;
            EXPECT_GT(estimate.z(1.15 * expected, c), reject) << rise << ' ' << c;
        }
    }
}

constexpr double planet = 6.36e6, scale_height = 8000;

/// Column of the atmosphere from a height of the planet, in a direction with this cosine to the
/// zenith.
double atmosphere_column(double height, double cosine) {
    const double start = planet + height;
    return integrate_halves(
        [&](double t) {
            const double r = std::sqrt(start * start + t * t + 2 * start * t * cosine);
            return std::exp(-(r - planet) / scale_height);
        },
        0, 6e6, 1, 1e-9, 40);
}

Scene atmosphere_scene(double height, double cosine, double sigma_a, double sigma_s) {
    Scene scene = empty_scene(8, 1e-3);
    scene.integrator.max_depth = 0;
    const dvec3 eye(0, height, 0), direction(std::sqrt(1 - cosine * cosine), cosine, 0);
    scene.camera.world_from_camera = support::look_at(eye, eye + direction, {0, 0, 1});
    scene.camera.medium = add_medium(scene, Rgb(sigma_a), Rgb(sigma_s));
    scene.media[0].density = ExponentialDensity{.is_spherical = true,
                                                .origin = {0, -planet, 0},
                                                .radius = planet,
                                                .scale_height = scale_height};
    add_infinite(scene);
    return scene;
}

/// Planet scale in metres: to the zenith, aslant, along the horizon, and from space.
TEST(Atmosphere, TransmitsItsColumn) {
    struct View {
        double height, cosine, sigma;
    };
    for (const View& view :
         {View{0, 1, 1e-4}, View{0, 0.2, 2e-5}, View{10, 0, 2e-6}, View{4e5, -0.338, 2e-6}}) {
        const double column = atmosphere_column(view.height, view.cosine);
        const double expected = std::exp(-view.sigma * column);
        for (const bool scatters : {false, true}) {
            const Scene scene = atmosphere_scene(
                view.height, view.cosine, scatters ? 0 : view.sigma, scatters ? view.sigma : 0);
            const Estimate estimate = image_mean(scene, 32, 40);
            EXPECT_LT(estimate.z(expected), pass)
                << view.height << ' ' << estimate.mean.x << ' ' << expected;
            EXPECT_GT(estimate.z(std::exp(-1.25 * view.sigma * column)), reject)
                << view.height << ' ' << expected;
        }
    }
    EXPECT_NEAR(atmosphere_column(0, 1), scale_height,
                20); // 2 H / R of it more than above a plane.
}

/// A camera far out gets there in few steps, and what it looks past is not there.
TEST(Atmosphere, IsEmptyFarOut) {
    for (const auto& [height, cosine] :
         {std::pair(1e12, 1.0), std::pair(1e12, -0.9999), std::pair(1e6, 0.5)}) {
        for (const Rgb& color : support::render(atmosphere_scene(height, cosine, 1, 1), 1))
            EXPECT_EQ(color, Rgb(1));
    }
}

/// Emission and absorption in grids: Le (1 - T) + background T, through slabs and balls.
TEST(EmissiveGrid, MatchesSlabAndSphere) {
    const Rgb sigma(0.2, 1, 2), emission(3, 2, 1);
    const support::Lattice lattice{{-1, -1, 4}, {1, 1, 6}, {5, 5, 5}};
    for (const bool sphere : {false, true}) {
        Scene scene = empty_scene(16, 0.9);
        const int medium = add_medium(scene, sigma, Rgb(0));
        scene.media[0].density = lattice.density([](const glm::ivec3&) { return 1; });
        scene.media[0].emission = emission;
        if (sphere)
            add_shape(scene, support::full_sphere(0.9), {.inside = medium}, translation({0, 0, 5}));
        else
            support::add_slab(scene, medium, 3, 7);
        add_infinite(scene, Rgb(0.5));
        const Estimate estimate = image_mean(scene, 32, 60);
        for (int c = 0; c < 3; ++c) {
            // Mean transmittance of a disc's chords of a ball: 2 (1 - (1 + x) exp(-x)) / x^2, x = 2
            // sigma r.
            const double x = (sphere ? 1.8 : 2) * sigma[c];
            const double disc = (1 - (1 + x) * std::exp(-x)) * 2 / (x * x);
            const double t = sphere ? 1 - pi / 4 * (1 - disc) : std::exp(-x);
            const double expected = emission[c] * (1 - t) + 0.5 * t;
            EXPECT_LT(estimate.z(expected, c), pass)
                << sphere << ' ' << c << ' ' << estimate.mean[c] << ' ' << expected;
            EXPECT_GT(estimate.z(1.02 * expected, c), reject) << sphere << ' ' << c;
        }
    }
}

TEST(EmissiveGrid, RadiatesAsABlackBody) {
    for (const double kelvin : {90.0, 101.0, 900.0, 1500.0, 6500.0, 2e5, 3e6}) {
        const Rgb fast = blackbody_radiance(kelvin),
                  exact = kelvin > 100 ? blackbody_emission(kelvin) : Rgb(0);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(fast[c], exact[c], 2e-6 * std::max({exact.x, exact.y, exact.z})) << kelvin;
    }
    Scene scene = empty_scene(8, 0.9);
    const int medium = add_medium(scene, Rgb(50), Rgb(0));
    const support::Lattice lattice{{-1, -1, 4}, {1, 1, 6}, {5, 5, 5}};
    GridDensity density = lattice.density([](const glm::ivec3&) { return 1; });
    density.temperature = lattice.grid([](const glm::ivec3&) { return 1500; });
    density.emission_scale = lattice.grid([](const glm::ivec3&) { return 3; });
    scene.media[0].density = density;
    scene.media[0].emission = Rgb(0.5); // Lescale of nanovdb
    support::add_slab(scene, medium, 3, 7);
    const Rgb expected = 1.5 * blackbody_emission(1500); // Opaque: exp(-100).
    const Rgb color = image_mean(scene, 2, 1).mean;
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(color[c], expected[c], 2e-6 * expected.x);
}

} // namespace
} // namespace tyndall::reference

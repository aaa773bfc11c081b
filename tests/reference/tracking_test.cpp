// Tracking through grids: taps, closed forms, spectral weights, transforms.
#include "reference/tracking.h"
#include "support/estimates.h"
#include "support/scenes.h"
#include "support/volumes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace tyndall::reference {
namespace {

using support::add_infinite;
using support::add_medium;
using support::add_shape;
using support::empty_scene;
using support::Estimate;
using support::image_mean;
using support::Lattice;
using support::pass;
using support::reject;
using support::scaling;
using support::translation;

double one(const glm::ivec3&) {
    return 1;
}

/// Uniform numbers, evenly spread over the words: each corner must come up with its trilinear
/// weight.
TEST(Tap, CornersComeUpWithTheirTrilinearWeights) {
    const dvec3 index(-3.3, 4.0, 5.9375);
    constexpr int n = 1 << 18;
    std::array<int, 8> counts{};
    for (int i = 0; i < n; ++i) {
        const glm::ivec3 corner = choose_corner(index, (i + 0.5) / n) - glm::ivec3(-4, 4, 5);
        ASSERT_TRUE(corner.x >> 1 == 0 && corner.y >> 1 == 0 && corner.z >> 1 == 0);
        ++counts[static_cast<std::size_t>(corner.x + 2 * corner.y + 4 * corner.z)];
    }
    for (std::size_t i = 0; i < 8; ++i) {
        const dvec3 upper(0.7, 0, 0.9375);
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis)
            weight *= i >> axis & 1 ? upper[axis] : 1 - upper[axis];
        EXPECT_NEAR(counts[i], weight * n, 4)
            << i; // The ends of at most four intervals are rounded.
        if (weight == 0) continue;
        EXPECT_GT(std::abs(counts[i] - 1.01 * weight * n), 4); // Control.
    }
}

/// A wide slab 1 <= z <= 3 on voxels, with one interface each side, and a black wall before or
/// behind.
Scene slab_scene(const Rgb& sigma_a, const Rgb& sigma_s, double g, bool reflectance) {
    Scene scene = empty_scene(8);
    const int medium = add_medium(scene, sigma_a, sigma_s, g);
    scene.media[0].density = Lattice{{-1e3, -1e3, 1}, {1e3, 1e3, 3}, {4, 5, 12}}.density(one);
    support::add_slab(scene, medium, 0.5, 3.5);
    add_shape(scene, support::square_mesh(1e6f, reflectance ? 4 : -1, 1),
              {.material = support::black});
    add_infinite(scene);
    return scene;
}

/// Oracles of homogeneous slabs (ORACLES 1.2), from a grid of density 1.
TEST(ConstantGrid, EqualsTheHomogeneousSlab) {
    const auto [a, b] = std::pair(Rgb(0.1), Rgb(0.9)); // tau 2, albedo 0.9
    const Estimate r = image_mean(slab_scene(a, b, 0.75, true), 32, 60);
    const Estimate t = image_mean(slab_scene(a, b, 0.75, false), 32, 60);
    EXPECT_LT(r.z(0.0973946), pass) << r.mean.x;
    EXPECT_LT(t.z(0.6609577), pass) << t.mean.x;
    EXPECT_GT(t.z(0.6609577 * 1.03), reject);
}

/// Light sampling goes through the grid, too: order 1 under a distant light.
TEST(ConstantGrid, ShadowRaysAreAttenuatedAsInTheHomogeneousSlab) {
    Scene scene = slab_scene(Rgb(0), Rgb(0.5), 0, true);
    scene.lights.clear();
    scene.integrator.max_depth = 1;
    support::add_light(scene, DistantLight{Rgb(1), {0, 0, 1}});
    const Estimate r = image_mean(scene, 32, 300);
    EXPECT_LT(r.z(0.0344039159475), pass) << r.mean.x;
    EXPECT_GT(r.z(0.0344039159475 * 1.04), reject);
}

/// Density that grows linearly along the ray: trilinear taps are exact. Scattering is fatal
/// (maxdepth 0), so that what is seen is the transmittance.
TEST(Grid, LinearDensityTransmitsItsClosedForm) {
    for (const bool scatters : {false, true}) {
        const Rgb sigma = {0.2, 1, 2};
        Scene scene = empty_scene(8);
        scene.integrator.max_depth = 0;
        const int medium = add_medium(scene, scatters ? Rgb(0) : sigma, scatters ? sigma : Rgb(0));
        const Lattice lattice{{-2, -2, 1}, {2, 2, 4}, {3, 4, 31}};
        scene.media[0].density = lattice.density(
            [&](const glm::ivec3& v) { return 0.5 + 0.2 * (lattice.place(v).z - 1); });
        support::add_slab(scene, medium, 1, 4);
        add_infinite(scene);
        const Estimate estimate = image_mean(scene, 32, 300);
        for (int c = 0; c < 3; ++c) {
            const double expected = std::exp(-sigma[c] * 2.4); // 0.0907179532894125 for sigma 1
            EXPECT_LT(estimate.z(expected, c), pass)
                << c << ' ' << estimate.mean[c] << ' ' << expected;
            EXPECT_GT(estimate.z(1.2 * expected, c), reject) << c;
        }
    }
}

/// Empty cells, and voxels of 0 and 1 in turn: the mean density along rays between voxel centres is
/// known.
TEST(Grid, SparseDensityIsIntegratedCellByCell) {
    Scene scene = empty_scene(8, 0.9);
    const int medium = add_medium(scene, Rgb(0), Rgb(3));
    scene.integrator.max_depth = 0;
    // Along z: 1 at the voxels 10 and 21 of 0 ... 40, so two triangles of the width of two
    // intervals.
    scene.media[0].density = Lattice{{-1, -1, 1}, {1, 1, 5}, {2, 2, 41}}.density(
        [](const glm::ivec3& v) { return v.z == 10 || v.z == 21 ? 1 : 0; }, 2);
    support::add_slab(scene, medium, 0.5, 5.5);
    add_infinite(scene);
    const Estimate estimate = image_mean(scene, 32, 300);
    const double expected = std::exp(-3 * 2 * 0.1);
    EXPECT_LT(estimate.z(expected), pass) << estimate.mean.x;
    EXPECT_GT(estimate.z(std::exp(-3.2 * 2 * 0.1)), reject);
}

TEST(Grid, ShadowRaysThroughTwoGridsMultiply) {
    const Estimate estimate = image_mean(support::scene_behind_two_grids(), 32, 100);
    EXPECT_LT(estimate.z(support::kBehindTwoGrids), pass);
    EXPECT_GT(estimate.z(1.05 * support::kBehindTwoGrids), reject);
}

/// No path may weigh more than 3: the bound of one-sample spectral MIS with three heroes.
TEST(ChromaticGrid, HasNoFirefliesAtHundredToOne) {
    Scene scene = empty_scene(16);
    const int medium = add_medium(scene, Rgb(0), {0.3, 3, 30}, 0.5);
    scene.media[0].density = Lattice{{-1, -1, 4}, {1, 1, 6}, {9, 9, 9}}.density(
        [](const glm::ivec3& v) { return (v.x + v.y + v.z) % 3 / 2.0; });
    add_shape(scene, support::full_sphere(1), {.inside = medium}, translation({0, 0, 5}));
    add_infinite(scene);
    for (const Rgb& color : support::render(scene, 1))
        for (int c = 0; c < 3; ++c)
            EXPECT_LE(color[c], 3 * (1 + 1e-9));
    const Estimate estimate = image_mean(scene, 32, 30);
    for (int c = 0; c < 3; ++c) {
        EXPECT_LT(estimate.z(1, c), pass) << c << ' ' << estimate.mean[c];
        EXPECT_GT(estimate.z(1.05, c), reject);
    }
}

TEST(ChannelGrids, EqualTheHomogeneousChannels) {
    const Rgb sigma_a(0.1, 0.5, 0.2), sigma_s(0.2, 0.1, 1);
    Scene scene = empty_scene(8);
    scene.integrator.max_depth = 0;
    const int medium = add_medium(scene, Rgb(0), Rgb(0));
    support::set_channel_grids(
        scene.media[0], {{-2, -2, 1}, {2, 2, 3}}, [&](const glm::ivec3&) { return sigma_a; },
        [&](const glm::ivec3&) { return sigma_s; });
    support::add_slab(scene, medium, 0.5, 3.5);
    add_infinite(scene);
    const Estimate estimate = image_mean(scene, 32, 300);
    for (int c = 0; c < 3; ++c) {
        const double depth = 2 * (sigma_a[c] + sigma_s[c]);
        EXPECT_LT(estimate.z(std::exp(-depth), c), pass) << c << ' ' << estimate.mean[c];
        EXPECT_GT(estimate.z(std::exp(-1.1 * depth), c), reject);
    }
}

/// A cloud, lit by the sky and a lamp; scaled and turned as a whole. It does not emit: grids that
/// do are sampled as lights, but not those of instances.
Scene cloud_scene(double scale, double sigma_scale, const dmat4& turn, bool instanced) {
    Scene scene = empty_scene(12);
    scene.camera.kind = Camera::Kind::perspective;
    scene.camera.fov = 40;
    scene.integrator.max_depth = 30;
    const dmat4 place = turn * scaling(dvec3(scale));
    const auto point = [&](const dvec3& p) { return dvec3(place * glm::dvec4(p, 1)); };
    const dmat4 look = support::look_at({0, 1, -4}, {0, 0, 0}, {0, 1, 0});
    scene.camera.world_from_camera = translation(point({0, 1, -4})) * turn * dmat4(dmat3(look));
    const int medium =
        add_medium(scene, sigma_scale * Rgb(0.1, 0.3, 0.2), sigma_scale * Rgb(2, 5, 8), 0.5);
    const Lattice lattice{{-1, -1.5, -1}, {1, 1, 1}, {9, 7, 12}};
    scene.media[0].density =
        lattice.density([](const glm::ivec3& v) { return (v.x * v.y + 3 * v.z) % 5 / 4.0; }, 4);
    if (instanced) {
        scene.objects.push_back(
            {"cloud", {support::make_shape(support::full_sphere(1.4), {.inside = medium})}});
        scene.instances.push_back({0, place});
    } else {
        scene.media[0].world_from_medium = place;
        add_shape(scene, support::full_sphere(1.4), {.inside = medium}, place);
    }
    support::add_light(scene, PointLight{Rgb(20) * scale * scale, point({2, 3, -2})});
    add_infinite(scene, Rgb(0.3, 0.4, 0.5));
    return scene;
}

double largest_difference(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 3; ++c)
            largest = std::max(largest, std::abs(a[i][c] - b[i][c]));
    return largest;
}

/// The same paths, so the same pixels up to rounding. Sigma counts in the world: a medium that is
/// scaled by s keeps its looks with sigma / s.
TEST(Transforms, MoveMediaWithTheirShapes) {
    const auto base = support::render(cloud_scene(1, 1, dmat4(1), false), 4);
    const auto difference = [](const std::vector<Rgb>& image, const Scene& scene) {
        return largest_difference(image, support::render(scene, 4));
    };
    EXPECT_LT(difference(base, cloud_scene(1, 1, dmat4(1), true)), 1e-9);
    EXPECT_LT(difference(base, cloud_scene(100, 0.01, dmat4(1), false)), 1e-9);
    const dmat4 turn = translation({3, -7, 2}) * glm::rotate(dmat4(1), 1.1, dvec3(1, 2, 3));
    const auto turned = support::render(cloud_scene(100, 0.01, turn, false), 4);
    EXPECT_LT(difference(turned, cloud_scene(100, 0.01, turn, true)), 1e-9);
    EXPECT_GT(difference(base, cloud_scene(100, 1, dmat4(1), false)), 0.01); // Control.
}

} // namespace
} // namespace tyndall::reference

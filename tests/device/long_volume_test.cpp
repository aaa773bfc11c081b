// Media on voxels over 1e8 paths (label "long"): a grid that is 1 everywhere against the
// homogeneous medium, and densities whose optical depth has a closed form.
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "support/volumes.h"

#include <cmath>

namespace tyndall::device_test {
namespace {

using namespace support;

constexpr int kPixels = 64; ///< Along an edge.
constexpr std::uint32_t kSamples = 100'000'000 / (kPixels * kPixels) + 1;

/// A cube of edge 2 about the origin, optical depth 5 across, seen along z.
Scene cube_scene(bool on_grid) {
    Scene scene = empty_scene(kPixels);
    scene.integrator.max_depth = 1000;
    scene.camera.world_from_camera = translation({0, 0, -2});
    const int medium = add_medium(scene, Rgb(0.5), Rgb(2), 0.5);
    if (on_grid)
        scene.media[0].density = Lattice{{-1, -1, -1}, {1, 1, 1}, {9, 12, 17}}.density(
            [](const glm::ivec3&) { return 1; });
    add_shape(scene, box_mesh(glm::vec3(-1), glm::vec3(1)), {.inside = medium});
    return scene;
}

void report(const char* what, const Estimate& seen, double expected, double error) {
    std::printf("%s: %.7f, expected %.7f, off by %+.4f %% and %+.2f standard errors\n", what,
                seen.mean.g, expected, 100 * (seen.mean.g / expected - 1),
                (seen.mean.g - expected) / error);
}

class LongVolumeTest : public DeviceTest {
  protected:
    /// A grid of ones agrees with the homogeneous medium; one that is brighter by 0.3 % would not.
    template<typename Light>
    static void expect_homogeneous(const Light& light) {
        const auto seen = [&](bool on_grid) {
            Scene scene = cube_scene(on_grid);
            scene.seed = on_grid; // other random numbers
            light(scene);
            return mean_of(scene, kSamples);
        };
        const Estimate grid = seen(true), homogeneous = seen(false);
        const double error = std::hypot(grid.standard_error.g, homogeneous.standard_error.g);
        report("grid", grid, homogeneous.mean.g, error);
        EXPECT_LT(std::abs(grid.mean.g - homogeneous.mean.g) / error, support::pass);
        EXPECT_GT(std::abs(1.003 * grid.mean.g - homogeneous.mean.g) / error, support::reject)
            << "no teeth";
    }

    static void expect_closed_form(const char* what, const Scene& scene, double depth) {
        const Estimate seen = mean_of(scene, kSamples);
        const double truth = std::exp(-depth);
        report(what, seen, truth, seen.standard_error.g);
        expect_mean(seen, truth, std::exp(-1.005 * depth));
    }
};

TEST_F(LongVolumeTest, FlightsInAConstantGridAreThoseOfAHomogeneousMedium) {
    expect_homogeneous([](Scene& scene) { add_infinite(scene); });
}

TEST_F(LongVolumeTest, ShadowRaysInAConstantGridAreThoseOfAHomogeneousMedium) {
    expect_homogeneous([](Scene& scene) {
        add_light(scene, DistantLight{Rgb(1), glm::normalize(glm::dvec3(1, -1, 1))});
    });
}

/// The grid is a light as well, and sampled as one; the homogeneous medium is not.
TEST_F(LongVolumeTest, EmissionOfAConstantGridIsThatOfAHomogeneousMedium) {
    expect_homogeneous([](Scene& scene) { scene.media[0].emission = Rgb(1); });
}

/// What is left of the sky behind a slab 1 <= z <= 4; scattering is fatal.
Scene transmission_scene(const Rgb& sigma_a, const Rgb& sigma_s) {
    Scene scene = empty_scene(kPixels, 1e-4);
    scene.integrator.max_depth = 0;
    const int medium = add_medium(scene, sigma_a, sigma_s);
    add_shape(scene, box_mesh({-2, -2, 1}, {2, 2, 4}), {.inside = medium});
    add_infinite(scene);
    return scene;
}

/// 0.5 + 0.2 s over a length of 3: by flights, and by weights.
TEST_F(LongVolumeTest, LinearDensityTransmitsItsClosedForm) {
    const Lattice lattice{{-2, -2, 1}, {2, 2, 4}, {3, 4, 31}};
    for (const bool scatters : {false, true}) {
        Scene scene = transmission_scene(Rgb(scatters ? 0 : 1), Rgb(scatters ? 1 : 0));
        scene.media[0].density = lattice.density(
            [&](const glm::ivec3& v) { return 0.5 + 0.2 * (lattice.place(v).z - 1); });
        expect_closed_form(scatters ? "scattered" : "absorbed", scene, 2.4);
    }
}

/// The same with emission instead of a sky: 1 - T.
TEST_F(LongVolumeTest, LinearDensityEmitsItsClosedForm) {
    const Lattice lattice{{-2, -2, 1}, {2, 2, 4}, {3, 4, 31}};
    Scene scene = transmission_scene(Rgb(1), Rgb(0));
    scene.lights.clear();
    scene.media[0].emission = Rgb(1);
    scene.media[0].density =
        lattice.density([&](const glm::ivec3& v) { return 0.5 + 0.2 * (lattice.place(v).z - 1); });
    const Estimate seen = mean_of(scene, kSamples);
    const double truth = -std::expm1(-2.4);
    report("emitted", seen, truth, seen.standard_error.g);
    expect_mean(seen, truth, -std::expm1(-2.4 * 1.005));
}

/// h = 0.5 where the ray enters, at a slope m; scale height 2.
TEST_F(LongVolumeTest, ExponentialDensityTransmitsItsClosedForm) {
    const struct {
        double m, depth;
    } cases[] = {{1, 1.21005367924192}, {0.1, 2.16961474071531}, {0, 2.33640234921421}};
    for (const auto& [m, depth] : cases) {
        ExponentialDensity density;
        density.up = {std::sqrt(1 - m * m), 0, m};
        density.origin = glm::dvec3(0, 0, 1) - 0.5 * density.up;
        density.scale_height = 2;
        Scene scene = transmission_scene(Rgb(0), Rgb(1));
        scene.media[0].density = density;
        expect_closed_form("exponential", scene, depth);
    }
}

/// The same fall-off on voxels, which are trilinear between their centres: 64 of them differ from
/// the exponential by 5e-5 of the depth.
TEST_F(LongVolumeTest, ExponentialDensityOnVoxelsTransmitsItsClosedForm) {
    const Lattice lattice{{-2, -2, 1}, {2, 2, 4}, {3, 3, 65}};
    Scene scene = transmission_scene(Rgb(0), Rgb(1));
    scene.media[0].density = lattice.density(
        [&](const glm::ivec3& v) { return std::exp(-(lattice.place(v).z - 0.5) / 2); });
    expect_closed_form("on voxels", scene, 1.21005367924192);
}

} // namespace
} // namespace tyndall::device_test

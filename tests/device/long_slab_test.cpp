// Tables of slabs, to 0.2 % and within three standard errors (label "long").
//
// Rays of the camera meet a slab 0 <= z <= 1; by reciprocity a pixel is the fraction of such a beam
// that leaves the slab towards a sky of radiance 1. A black disk hides the sky on one side, so that
// no light need be sampled.
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "support/materials.h"
#include "support/phases.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

namespace tyndall::device_test {
namespace {

using namespace support;

constexpr float kHalfWidth = 1e4F; ///< Of a slab that is 1 thick.
constexpr double kWithin = 0.002;  ///< Asked for, relative.

enum class Side { reflected, transmitted };

struct Row {
    double albedo, depth, g, reflectance, transmittance; ///< 0: not asked for.
    double n = 1;                                        ///< Refractive index of the slab.
    double cosine = 1;                                   ///< Of the angle of incidence.
};

/// Camera, sky, and the disk beyond the slab or behind the camera.
Scene lit_scene(Side side, double cosine) {
    Scene scene = empty_scene(64, 0.01);
    scene.integrator.max_depth = 1'000'000;
    scene.camera.world_from_camera =
        glm::rotate(glm::dmat4(1), std::acos(cosine), {0, 1, 0}) * translation({0, 0, -1 / cosine});
    add_infinite(scene);
    add_shape(scene, Disk{.radius = 8 * kHalfWidth}, {.material = black},
              translation({0, 0, side == Side::reflected ? 2 : -3}));
    return scene;
}

Scene slab_scene(const Row& row, Side side, const PhaseFunction& phase) {
    Scene scene = lit_scene(side, row.cosine);
    const int medium =
        add_medium(scene, Rgb(row.depth * (1 - row.albedo)), Rgb(row.depth * row.albedo));
    scene.media[0].phases = {phase};
    add_shape(
        scene, box_mesh({-kHalfWidth, -kHalfWidth, 0}, {kHalfWidth, kHalfWidth, 1}),
        {.material = row.n == 1 ? interface : add_dielectric(scene, Rgb(row.n)), .inside = medium});
    return scene;
}

/// Samples a pixel that bring three standard errors down to 0.9 of what is asked for, by the
/// variance of a short render.
std::uint32_t samples_needed(const Scene& scene, double truth) {
    constexpr std::uint32_t pilot = 128;
    const double error = 3 * mean_of(scene, pilot).standard_error.g / (0.9 * kWithin * truth);
    return static_cast<std::uint32_t>(std::max(512.0, std::ceil(pilot * error * error)));
}

void expect_table(Scene scene, double truth) {
    const std::uint32_t samples = samples_needed(scene, truth);
    scene.seed = 1; // none of the random numbers that chose how many
    const Estimate seen = mean_of(scene, samples);
    std::printf("%.7f: seen %.7f, off by %+.4f %% and %+.2f standard errors, %.2g paths\n", truth,
                seen.mean.g, 100 * (seen.mean.g / truth - 1),
                (seen.mean.g - truth) / seen.standard_error.g, 64.0 * 64 * samples);
    EXPECT_LT(seen.z(truth, 1), 3) << seen.mean.g << " is not " << truth;
    EXPECT_LT(3 * seen.standard_error.g, kWithin * truth) << "no teeth";
}

void expect_row(const Row& row, const PhaseFunction& phase) {
    if (row.reflectance > 0) expect_table(slab_scene(row, Side::reflected, phase), row.reflectance);
    if (row.transmittance > 0)
        expect_table(slab_scene(row, Side::transmitted, phase), row.transmittance);
}

class LongSlabTest : public DeviceTest {
  protected:
    static void expect_rows(const std::vector<Row>& rows) {
        for (const Row& row : rows)
            expect_row(row, henyey_greenstein(row.g));
    }
};

// Numbers: van de Hulst (1980), Giovanelli (1955), and adding and doubling with streams enough for
// all digits, checked by a second solver.

TEST_F(LongSlabTest, IsotropicScattering) {
    expect_rows({{0.5, 1, 0, 0.0991192, 0.4460584},
                 {0.9, 2, 0, 0.3616489, 0.3565007},
                 {0.99, 2, 0, 0.4974888, 0.4656992},
                 {1, 1, 0, 0.3413288, 0.6586712},
                 {1, 10, 0, 0.8530046, 0.1469954},
                 {1, 64, 0, 0.9743381, 0},
                 {0.99, 1, 0, 0.4865183, 0.4916277, 1, 0.5}});
}

TEST_F(LongSlabTest, HenyeyGreenstein) {
    expect_rows({{0.9, 2, 0.5, 0.2045074, 0.5232734},
                 {0.99, 4, 0.5, 0.6199593, 0.3060509, 1, 0.5},
                 {0.9, 2, 0.75, 0.0973946, 0.6609577},
                 {1, 8, 0.75, 0.5064150, 0.4935850},
                 {0.9, 2, -0.5, 0.4627721, 0.2760717},
                 {1, 8, -0.5, 0.8725635, 0.1274365},
                 {0.99, 10, 0.9, 0.2476276, 0.5890815},
                 {1, 64, 0.9, 0.7833133, 0},
                 {0.999, 64, 0.99, 0, 0.7311184}});
}

TEST_F(LongSlabTest, RayleighScattering) {
    for (const Row& row : std::vector<Row>{{0.5, 1, 0, 0.1030693, 0.4503163},
                                           {0.9, 1, 0, 0.2688598, 0.5943997},
                                           {1, 10, 0, 0.8523949, 0.1476051}})
        expect_row(row, rayleigh());
}

/// Depths of 60 and 300 stand for infinite ones: less than 1e-7 of the light comes from beyond.
TEST_F(LongSlabTest, IndexMismatchedBoundaries) {
    expect_rows({{0.9, 60, 0, 0.2599186, 0, 1.5},
                 {0.99, 300, 0, 0.6529579, 0, 1.33},
                 {1, 10, 0, 0.7756944, 0.2243056, 1.5},
                 {0.9, 2, 0.75, 0.1162129, 0.5270250, 1.4},
                 {0.99, 10, 0.9, 0.2550080, 0.4876606, 1.33}});
}

/// The sample of MCML (Wang and Jacques 1995): three layers of index 1.37; absorption, scattering
/// and thickness per centimetre.
TEST_F(LongSlabTest, ThreeLayers) {
    const struct {
        double sigma_a, sigma_s, g, z0, z1;
    } layers[] = {{1, 100, 0.9, 0, 0.1}, {1, 10, 0, 0.1, 0.2}, {2, 10, 0.7, 0.2, 0.4}};
    for (const Side side : {Side::reflected, Side::transmitted}) {
        Scene scene = lit_scene(side, 1);
        const int glass = add_dielectric(scene, Rgb(1.37));
        for (const auto& layer : layers)
            add_medium(scene, Rgb(layer.sigma_a), Rgb(layer.sigma_s), layer.g);
        const auto add_plane = [&](double z, int material, int before, int beyond) {
            add_shape(scene, square_mesh(kHalfWidth, static_cast<float>(z), -1),
                      {.material = material, .inside = beyond, .outside = before});
        };
        add_plane(0, glass, -1, 0);
        add_plane(0.1, interface, 0, 1);
        add_plane(0.2, interface, 1, 2);
        // The far face looks to +z, so that the index rises against it.
        add_shape(scene, square_mesh(kHalfWidth, 0.4F, 1), {.material = glass, .inside = 2});
        expect_table(scene, side == Side::reflected ? 0.0243729 + 0.237856 : 0.0960477);
    }
}

} // namespace
} // namespace tyndall::device_test

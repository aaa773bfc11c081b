// The plane-parallel slab: albedo and transmittance for normal incidence, to more digits than a
// renderer needs.
//
// Rays of the camera meet the slab at right angles. By reciprocity a pixel is the fraction of such
// a beam that leaves the slab on the sides from which light of radiance 1 comes: under a sky that a
// black screen covers on one side, the plane albedo or the transmittance; under the whole sky,
// their sum.
//
// Numbers: adding and doubling, with streams enough for all digits, and a second solver; the case
// with albedo 0.9 and g = 0.75 is van de Hulst's (1980). The orders of scattering likewise.
#include "device/device_test.h"
#include "device/test_scenes.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::device_test {
namespace {

using namespace support;

constexpr double kHalfWidth = 10000; ///< Of a slab that is 1 thick.

enum class Lit { near_side, far_side, both_sides };
enum class Boundary { quads, box };

struct SlabCase {
    double albedo, optical_thickness, g;
    double reflectance, transmittance;
};
constexpr SlabCase kVanDeHulst{0.9, 2, 0.75, 0.0973946, 0.6609577};
constexpr SlabCase kConservative{1, 10, 0, 0.8530046, 0.1469954};
constexpr SlabCase kBackward{0.9, 1, -0.5, 0.3672903, 0.5018472};
constexpr SlabCase kForward{0.99, 10, 0.9, 0.2476276, 0.5890815};

Scene slab(const SlabCase& c, Boundary boundary, Lit lit) {
    Scene scene = empty_scene(16, 1);
    scene.camera.world_from_camera = translation({0, 0, -1});
    add_infinite(scene);
    const double sigma_t = c.optical_thickness;
    const int medium =
        add_medium(scene, Rgb(sigma_t * (1 - c.albedo)), Rgb(sigma_t * c.albedo), c.g);
    const float half = kHalfWidth;
    if (boundary == Boundary::quads)
        add_slab(scene, medium, 0, 1, kHalfWidth);
    else
        add_shape(scene, box_mesh({-half, -half, 0}, {half, half, 1}), {.inside = medium});
    // The screen, behind the camera or behind the slab, four times as wide.
    if (lit != Lit::both_sides)
        add_shape(scene, square_mesh(4 * half, lit == Lit::far_side ? -2.0F : 3.0F, 1),
                  {.material = black});
    return scene;
}

double truth(const SlabCase& c, Lit lit) {
    return lit == Lit::near_side  ? c.reflectance
           : lit == Lit::far_side ? c.transmittance
                                  : c.reflectance + c.transmittance;
}

constexpr double kWithin = 0.003; // asked for

void expect_slab(const SlabCase& c, Boundary boundary, Lit lit, std::uint32_t samples,
                 const glm::dmat4& by = glm::dmat4(1)) {
    const support::Estimate mean = mean_of(moved(slab(c, boundary, lit), by), samples);
    const double expected = truth(c, lit);
    // The control is what origins do that are offset by the error of far vertices: 2 % off.
    expect_mean(mean, expected, 0.98 * expected);
    expect_mean(mean, expected, 1.02 * expected);
    EXPECT_NEAR(mean.mean.g / expected, 1, kWithin);
}

class SlabTest : public DeviceTest {};

TEST_F(SlabTest, VanDeHulstAlbedo) {
    expect_slab(kVanDeHulst, Boundary::quads, Lit::near_side, 16384);
}
TEST_F(SlabTest, VanDeHulstTransmittance) {
    expect_slab(kVanDeHulst, Boundary::quads, Lit::far_side, 2048);
    expect_slab(kVanDeHulst, Boundary::box, Lit::far_side, 2048);
}
TEST_F(SlabTest, VanDeHulstBoxWithoutAHierarchy) {
    const Scene scene = slab(kVanDeHulst, Boundary::box, Lit::both_sides);
    EXPECT_EQ(compute_effects(scene).features.geometry, shared::GEOMETRY_BOX);
    expect_slab(kVanDeHulst, Boundary::box, Lit::both_sides, 4096);
}
TEST_F(SlabTest, ConservativeAlbedo) {
    expect_slab(kConservative, Boundary::quads, Lit::near_side, 2048);
    expect_slab(kConservative, Boundary::box, Lit::near_side, 2048);
}
TEST_F(SlabTest, BackwardScattering) {
    expect_slab(kBackward, Boundary::quads, Lit::near_side, 4096);
    expect_slab(kBackward, Boundary::box, Lit::far_side, 4096);
}
TEST_F(SlabTest, StronglyForwardScattering) {
    expect_slab(kForward, Boundary::box, Lit::near_side, 4096);
    expect_slab(kForward, Boundary::quads, Lit::far_side, 2048);
}

TEST_F(SlabTest, TurnedAndMoved) {
    const glm::dmat4 by =
        glm::rotate(translation({31.7, -12.3, 55.1}), 0.83, glm::dvec3(0.3, -1, 0.45));
    expect_slab(kVanDeHulst, Boundary::quads, Lit::far_side, 2048, by);
    expect_slab(kConservative, Boundary::box, Lit::near_side, 2048, by);
}

/// A red emitter shines on the near face, a green one on the far face: what scattering hits and
/// what light sampling finds add up. These are the numbers of scenes/slab.pbrt.
TEST_F(SlabTest, BetweenEmittingPlanes) {
    Scene scene = slab(kVanDeHulst, Boundary::quads, Lit::both_sides);
    scene.lights.clear();
    const float half = 10 * kHalfWidth;
    add_shape(scene, square_mesh(half, -2, 1),
              {.material = black, .area_light = add_area_light(scene, {1, 0, 0})});
    add_shape(scene, square_mesh(half, 3, -1),
              {.material = black, .area_light = add_area_light(scene, {0, 1, 0})});
    const support::Estimate mean = mean_of(scene, 2048);
    expect_mean(mean, kVanDeHulst.reflectance, 1.05 * kVanDeHulst.reflectance, 0);
    expect_mean(mean, kVanDeHulst.transmittance, 1.02 * kVanDeHulst.transmittance, 1);
    EXPECT_EQ(mean.mean.b, 0);
}

/// Paths with exactly n = 0 ... 5 scatterings, isotropic, optical thickness 1, albedo 1.
constexpr double kOrderReflected[] = {0,          0.14201535, 0.07888152,
                                      0.04668661, 0.02832607, 0.01737144};
constexpr double kOrderTransmitted[] = {0.36787944, 0.10617289, 0.06862215,
                                        0.04360838, 0.02738659, 0.01708273};

TEST_F(SlabTest, OrdersOfScattering) {
    const SlabCase c{1, 1, 0, 0, 0};
    double reflected = 0, transmitted = 0;
    for (int n = 0; n <= 5; ++n) {
        reflected += kOrderReflected[n];
        transmitted += kOrderTransmitted[n];
        Scene both = slab(c, Boundary::box, Lit::both_sides);
        both.integrator.max_depth = n;
        // One order more or less is the wrong answer.
        const double sum = reflected + transmitted;
        expect_mean(mean_of(both, 512), sum, sum - kOrderReflected[n] - kOrderTransmitted[n]);
        if (n == 0 || n == 4) continue;
        Scene near = slab(c, Boundary::quads, Lit::near_side);
        near.integrator.max_depth = n;
        expect_mean(mean_of(near, 512), reflected, reflected - kOrderReflected[n]);
    }
}

/// Single scattering of a distant light has a closed form: with perpendicular irradiance 1, light
/// and view at right angles to a slab of optical thickness 1, isotropic, albedo 1.
TEST_F(SlabTest, SingleScatteringOfADistantLight) {
    constexpr double kBack = 0.0344039159475, kThrough = 0.0292749157622;
    for (Boundary boundary : {Boundary::box, Boundary::quads}) {
        for (bool from_behind : {false, true}) {
            Scene scene = slab({1, 1, 0, 0, 0}, boundary, Lit::both_sides);
            scene.lights.clear();
            add_light(scene, DistantLight{Rgb(1), {0, 0, from_behind ? -1.0 : 1.0}});
            scene.integrator.max_depth = 1;
            const support::Estimate mean = mean_of(scene, 1024);
            expect_mean(mean, from_behind ? kThrough : kBack, from_behind ? kBack : kThrough);
        }
    }
}

} // namespace
} // namespace tyndall::device_test

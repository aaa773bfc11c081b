// Boundaries of dielectrics and metals against closed forms: Fresnel's equations, panes and stacks
// of them, furnaces, total reflection.
//
// A wide screen of radiance 1 is on the one side of a slab; the camera on the other side sees what
// the slab transmits, on the same side what it reflects.
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "support/materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::device_test {
namespace {

using namespace support;

constexpr double kPi = 3.14159265358979323846;
constexpr double kUnit = 1.0 / (1 << 24); ///< Rounding error of a float operation, relative.

enum class Seen { transmitted, reflected };

/// A wide plane across the z axis; its normal, and so its outside, is towards -z.
void add_plane(Scene& scene, int material, float z, MediumInterface media = {}) {
    add_shape(scene, square_mesh(1e5F, z, -1),
              {.material = material, .inside = media.inside, .outside = media.outside});
}

/// A camera that looks at the origin from 4 units before the plane z = 0, turned by the angle
/// (radians).
glm::dmat4 turned_camera(double angle) {
    return glm::rotate(glm::dmat4(1), angle, glm::dvec3(0, 1, 0)) *
           translation({0, 0, -4 / std::abs(std::cos(angle))});
}

/// Camera and screen for boundaries within 0 <= z <= 1.
Scene lit_slab(double angle, Seen seen) {
    Scene scene = empty_scene(16, 0.5);
    scene.camera.world_from_camera = turned_camera(angle);
    const int light = add_area_light(scene, Rgb(1), true);
    add_shape(scene, square_mesh(1e6F, seen == Seen::reflected ? -100.0F : 100.0F, 1),
              {.material = black, .area_light = light});
    return scene;
}

/// One interface, unpolarised.
double fresnel(double eta, double cosine) {
    const double sine2 = (1 - cosine * cosine) / (eta * eta);
    if (sine2 >= 1) return 1;
    const double beyond = std::sqrt(1 - sine2);
    const double s = (cosine - eta * beyond) / (cosine + eta * beyond);
    const double p = (eta * cosine - beyond) / (eta * cosine + beyond);
    return (s * s + p * p) / 2;
}

/// Cosine beyond an interface.
double refracted(double eta, double cosine) {
    return std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
}

class BoundaryTest : public DeviceTest {};

TEST_F(BoundaryTest, ASlabReflectsBackAndForth) {
    for (const double degrees : {0.0, 60.0, 85.0}) {
        const double angle = degrees * kPi / 180, r = fresnel(1.5, std::cos(angle));
        const double both = 2 * r / (1 + r);
        for (const Seen seen : {Seen::reflected, Seen::transmitted}) {
            Scene scene = lit_slab(angle, seen);
            const int glass = add_dielectric(scene, Rgb(1.5));
            add_shape(scene, box_mesh({-1e5F, -1e5F, 0}, {1e5F, 1e5F, 1}), {.material = glass});
            const Estimate mean = mean_of(scene, 128);
            const bool reflected = seen == Seen::reflected;
            expect_mean(mean, reflected ? both : 1 - both, reflected ? r : 1 - r); // one face alone
        }
    }
}

TEST_F(BoundaryTest, AThinPaneIsASlabThatDoesNotShift) {
    const double angle = kPi / 3, r = fresnel(1.5, 0.5), both = 2 * r / (1 + r);
    for (const Seen seen : {Seen::reflected, Seen::transmitted}) {
        Scene scene = lit_slab(angle, seen);
        add_plane(scene, add_thin_dielectric(scene, Rgb(1.5)), 0);
        const Estimate mean = mean_of(scene, 128);
        const bool reflected = seen == Seen::reflected;
        expect_mean(mean, reflected ? both : 1 - both, reflected ? r : 1 - r);
    }
}

TEST_F(BoundaryTest, AbsorptionIsThatOfTheWayInTheGlass) {
    const double angle = kPi / 4, c = std::cos(angle), r = fresnel(1.5, c), sigma = 0.7;
    const double t = std::exp(-sigma / refracted(1.5, c)); // thickness 1
    const double ways = (1 - r) * (1 - r) / (1 - r * r * t * t);
    for (const Seen seen : {Seen::reflected, Seen::transmitted}) {
        Scene scene = lit_slab(angle, seen);
        const int glass = add_dielectric(scene, Rgb(1.5));
        const int smoke = add_medium(scene, Rgb(sigma), Rgb(0));
        add_shape(scene, box_mesh({-1e5F, -1e5F, 0}, {1e5F, 1e5F, 1}),
                  {.material = glass, .inside = smoke});
        const double truth = seen == Seen::reflected ? r + r * ways * t * t : ways * t;
        // The control: the way is not that of light that goes straight on.
        const double straight = std::exp(-sigma / c);
        const double wrong = seen == Seen::reflected ? r : ways * straight;
        expect_mean(mean_of(scene, 256), truth, wrong);
    }
}

/// Glass, water, glass: boundaries that touch are one surface, with the index of the one over the
/// other.
TEST_F(BoundaryTest, NestedDielectricsInTouch) {
    const std::array<double, 5> index{1, 1.5, 1.33, 1.6, 1};
    for (const double degrees : {0.0, 70.0}) {
        const double angle = degrees * kPi / 180;
        // Incoherent layers that do not absorb: R / T of the stack is the sum over its faces.
        double odds = 0, c = std::cos(angle);
        for (std::size_t i = 0; i + 1 < index.size(); ++i) {
            const double eta = index[i + 1] / index[i], r = fresnel(eta, c);
            odds += r / (1 - r);
            c = refracted(eta, c);
        }
        for (const Seen seen : {Seen::reflected, Seen::transmitted}) {
            Scene scene = lit_slab(angle, seen);
            for (std::size_t i = 0; i + 1 < index.size(); ++i)
                add_plane(scene, add_dielectric(scene, Rgb(index[i + 1] / index[i])),
                          static_cast<float>(i) / 3);
            const double reflected = odds / (1 + odds), face = fresnel(1.5, std::cos(angle));
            const bool r = seen == Seen::reflected;
            expect_mean(mean_of(scene, 1024), r ? reflected : 1 - reflected, r ? face : 1 - face);
        }
    }
}

TEST_F(BoundaryTest, ChannelsThatAreBentDifferentlyAreEachRight) {
    const double angle = kPi / 3;
    const Rgb eta(1.3, 1.5, 2.2);
    for (const Seen seen : {Seen::reflected, Seen::transmitted}) {
        Scene scene = lit_slab(angle, seen);
        add_shape(scene, box_mesh({-1e5F, -1e5F, 0}, {1e5F, 1e5F, 1}),
                  {.material = add_dielectric(scene, eta)});
        const Estimate mean = mean_of(scene, 512);
        for (int i = 0; i < 3; ++i) {
            const double r = fresnel(eta[i], 0.5), both = 2 * r / (1 + r);
            const double grey = fresnel(1.4, 0.5), wrong = 2 * grey / (1 + grey);
            const bool reflected = seen == Seen::reflected;
            expect_mean(mean, reflected ? both : 1 - both, reflected ? wrong : 1 - wrong, i);
        }
    }
}

/// Whole pixels, not their mean: no sample is off. Each crossing rounds the throughput four times.
void expect_every_pixel(const Scene& scene, std::uint32_t samples, const Rgb& value,
                        int crossings) {
    const double tolerance = 4 * crossings * kUnit;
    for (const Rgb& pixel : colors_of(render(scene, samples)))
        for (int i = 0; i < 3; ++i)
            ASSERT_NEAR(pixel[i] / value[i], 1, tolerance) << "channel " << i;
}

TEST_F(BoundaryTest, FurnacesOfSmoothGlassAreExact) {
    for (const bool is_thin : {false, true})
        for (const double eta : {1.0001, 1.33, 1.5, 2.4, 0.7}) {
            Scene scene = empty_scene(16, 1.2);
            scene.camera.world_from_camera = look_at({1, 2, -4}, {0, 0, 0}, {0, 1, 0});
            add_infinite(scene, Rgb(1));
            const int glass =
                is_thin ? add_thin_dielectric(scene, Rgb(eta)) : add_dielectric(scene, Rgb(eta));
            add_shape(scene, full_sphere(1), {.material = glass});
            expect_every_pixel(scene, 16, Rgb(1), 64);
        }
}

TEST_F(BoundaryTest, InsideGlassLightIsDenser) {
    // Radiance over eta^2 is what refraction keeps (Nicodemus): within the ball it is 2.25.
    Scene scene = empty_scene(16);
    scene.camera.kind = Camera::Kind::perspective;
    scene.camera.fov = 100;
    scene.camera.world_from_camera = look_at({0, 0.3, 0.4}, {1, 0, 0}, {0, 1, 0});
    add_infinite(scene, Rgb(1));
    add_shape(scene, full_sphere(1), {.material = add_dielectric(scene, Rgb(1.5))});
    expect_every_pixel(scene, 16, Rgb(2.25), 64);
}

/// The camera in glass, below a flat boundary to air; a screen below lights it.
Scene under_the_surface(double angle, double eta) {
    Scene scene = empty_scene(16, 0.5);
    scene.camera.world_from_camera = turned_camera(kPi - angle);
    add_plane(scene, add_dielectric(scene, Rgb(eta)), 0); // glass is at z > 0
    add_shape(scene, square_mesh(1e6F, 100, 1),
              {.material = black, .area_light = add_area_light(scene, Rgb(1), true)});
    return scene;
}

TEST_F(BoundaryTest, TotalReflectionIsTotal) {
    const double critical = std::asin(1 / 1.5);
    for (const double angle : {critical + 1e-3, 0.9, 1.4, 1.57})
        expect_every_pixel(under_the_surface(angle, 1.5), 64, Rgb(1), 4);
    // At the critical angle itself, to rounding, there is no number but those between 0 and 1.
    for (const Rgb& pixel : colors_of(render(under_the_surface(critical, 1.5), 64)))
        ASSERT_TRUE(pixel.g >= 0 && pixel.g <= 1 + 4 * kUnit);
    // The control: short of it, some is lost.
    const double r = fresnel(1 / 1.5, std::cos(critical - 0.05));
    expect_mean(mean_of(under_the_surface(critical - 0.05, 1.5), 128), r, 1);
}

TEST_F(BoundaryTest, MetalReflectsWhatFresnelSays) {
    const Rgb eta(0.2, 0.92, 1.1), k(3.9, 2.45, 2.1);
    Rgb expected;
    for (int i = 0; i < 3; ++i)
        expected[i] = ((eta[i] - 1) * (eta[i] - 1) + k[i] * k[i]) /
                      ((eta[i] + 1) * (eta[i] + 1) + k[i] * k[i]);
    for (const float side : {-1.0F, 1.0F}) { // both reflect
        Scene scene = lit_slab(0, Seen::reflected);
        add_shape(scene, square_mesh(10, 0, side), {.material = add_conductor(scene, eta, k)});
        expect_every_pixel(scene, 4, expected, 8);
    }
}

/// Scattering slabs in air, normal incidence, reflection at the surface included: adding and
/// doubling with Fresnel's equations at both sides, confirmed by Monte Carlo.
TEST_F(BoundaryTest, ScatteringSlabsOfAnotherIndex) {
    const struct {
        double albedo, optical_thickness, g, eta, reflectance, transmittance;
        std::uint32_t samples;
    } cases[] = {{0.9, 2, 0.75, 1.5, 0.1268222, 0.4931464, 1024},
                 {0.99, 10, 0.9, 1.4, 0.2590745, 0.4629940, 512},
                 {1, 10, 0, 1.33, 0.8014883, 0.1985117, 512}};
    for (const auto& c : cases)
        for (const Seen seen : {Seen::reflected, Seen::transmitted}) {
            Scene scene = lit_slab(0, seen);
            const int milk = add_medium(scene, Rgb(c.optical_thickness * (1 - c.albedo)),
                                        Rgb(c.optical_thickness * c.albedo), c.g);
            add_shape(scene, box_mesh({-1e4F, -1e4F, 0}, {1e4F, 1e4F, 1}),
                      {.material = add_dielectric(scene, Rgb(c.eta)), .inside = milk});
            const double truth = seen == Seen::reflected ? c.reflectance : c.transmittance;
            expect_mean(mean_of(scene, c.samples), truth, 0.95 * truth);
        }
}

/// Crossing such a boundary changes nothing: not the direction, nor the medium, which is the same
/// on both sides. Here it absorbs, so that a pixel is a length of way, without noise.
TEST_F(BoundaryTest, AnIndexOfOneIsNoBoundary) {
    Scene scene = plain_scene();
    scene.media.front().sigma_s = Rgb(0);
    const std::vector<Rgb> expected = colors_of(render(scene, 4));
    for (const double alpha : {0.0, 0.3})
        for (const double eta : {1.0, 1.01}) {
            Scene with_ball = scene;
            add_shape(with_ball, full_sphere(0.8),
                      {.material = add_dielectric(with_ball, Rgb(eta), alpha)});
            const std::vector<Rgb> found = colors_of(render(with_ball, 4));
            double worst = 0;
            for (std::size_t i = 0; i < expected.size(); ++i)
                worst = std::max(worst, glm::length(found[i] / expected[i] - 1.0));
            if (eta == 1)
                EXPECT_LT(worst, 1e-5)
                    << alpha; // a part in 10^6 of a way of 3.5, for each of three
            else
                EXPECT_GT(worst, 1e-3) << "no teeth";
        }
}

} // namespace
} // namespace tyndall::device_test

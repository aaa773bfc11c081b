// Boundaries of dielectrics and metal in scenes, against closed forms.
#include "reference/fresnel.h"
#include "support/estimates.h"
#include "support/materials.h"
#include "support/scenes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace tyndall::reference {
namespace {

using support::add_dielectric;
using support::add_infinite;
using support::add_medium;
using support::add_shape;
using support::box_mesh;
using support::empty_scene;
using support::Estimate;
using support::image_mean;
using support::pass;
using support::reject;

enum class Seen { transmitted, reflected };

/// A wide boundary across the z axis; its outside is towards -z.
void add_plane(Scene& scene, int material, float z) {
    add_shape(scene, support::square_mesh(1e5f, z, -1), {.material = material});
}

/// A camera that looks at the origin from before the plane z = 0, turned by `angle`.
dmat4 turned_camera(double angle) {
    return glm::rotate(dmat4(1), angle, dvec3(0, 1, 0)) *
           support::translation({0, 0, -4 / std::abs(std::cos(angle))});
}

/// Camera and a screen of radiance 1, for boundaries within 0 <= z <= 1.
Scene lit_slab(double angle, Seen seen) {
    Scene scene = empty_scene(8, 0.5);
    scene.camera.world_from_camera = turned_camera(angle);
    add_shape(
        scene, support::square_mesh(1e6f, seen == Seen::reflected ? -100.0f : 100.0f, 1),
        {.material = support::black, .area_light = support::add_area_light(scene, Rgb(1), true)});
    return scene;
}

void expect_seen(const Scene& scene, const Rgb& expected, const Rgb& wrong,
                 std::uint32_t samples = 60) {
    const Estimate estimate = image_mean(scene, 32, samples);
    for (int c = 0; c < 3; ++c) {
        EXPECT_LT(estimate.z(expected[c], c), pass) << estimate.mean[c] << " for " << expected[c];
        EXPECT_GT(estimate.z(wrong[c], c), reject) << estimate.mean[c] << " for " << wrong[c];
    }
}

/// Both faces and all that goes back and forth: R' = 2 R / (1 + R), T' = 1 - R'. Channels that are
/// bent differently are each right.
TEST(Boundary, SlabsAndPanesReflectBackAndForth) {
    for (const double angle : {0.0, 1.0}) {
        for (const Rgb& eta : {Rgb(1.5), Rgb(1.3, 1.5, 2.2)}) {
            for (const bool is_thin : {false, true}) {
                for (const Seen seen : {Seen::reflected, Seen::transmitted}) {
                    Scene scene = lit_slab(angle, seen);
                    if (is_thin)
                        add_plane(scene, support::add_thin_dielectric(scene, eta), 0);
                    else
                        add_shape(scene, box_mesh({-1e5f, -1e5f, 0}, {1e5f, 1e5f, 1}),
                                  {.material = add_dielectric(scene, eta)});
                    Rgb face;
                    for (int c = 0; c < 3; ++c)
                        face[c] = fresnel_dielectric(eta[c], std::cos(angle));
                    const Rgb both = 2.0 * face / (1.0 + face);
                    if (seen == Seen::reflected)
                        expect_seen(scene, both, face);
                    else
                        expect_seen(scene, 1.0 - both, 1.0 - face);
                }
            }
        }
    }
}

TEST(Boundary, AbsorptionCountsTheWayInTheGlass) {
    const double angle = 0.8, r = fresnel_dielectric(1.5, std::cos(angle)), sigma = 0.7;
    const double sine = std::sin(angle) / 1.5, t = std::exp(-sigma / std::sqrt(1 - sine * sine));
    Scene scene = lit_slab(angle, Seen::transmitted);
    const int smoke = add_medium(scene, Rgb(sigma), Rgb(0));
    add_shape(scene, box_mesh({-1e5f, -1e5f, 0}, {1e5f, 1e5f, 1}),
              {.material = add_dielectric(scene, Rgb(1.5)), .inside = smoke});
    const double ways = (1 - r) * (1 - r) / (1 - r * r * t * t);
    expect_seen(scene, Rgb(ways * t), Rgb(ways * std::exp(-sigma / std::cos(angle))));
}

/// Boundaries in touch are one surface with the index of one over the other. R / T of layers that
/// do not absorb is the sum of those of the faces.
TEST(Boundary, NestedDielectricsInTouch) {
    const std::array<double, 5> index{1, 1.5, 1.33, 1.6, 1};
    for (const double angle : {0.0, 1.2}) {
        Scene scene = lit_slab(angle, Seen::transmitted);
        double odds = 0, sine = std::sin(angle);
        for (std::size_t i = 0; i + 1 < index.size(); ++i) {
            const double eta = index[i + 1] / index[i],
                         r = fresnel_dielectric(eta, std::sqrt(1 - sine * sine));
            odds += r / (1 - r);
            sine /= eta;
            add_plane(scene, add_dielectric(scene, Rgb(eta)), static_cast<float>(i) / 3);
        }
        expect_seen(scene, Rgb(1 / (1 + odds)), Rgb(1 - fresnel_dielectric(1.5, std::cos(angle))),
                    100);
    }
}

void expect_every_pixel(const Scene& scene, const Rgb& expected) {
    for (const Rgb& color : support::render(scene, 8))
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(color[c] / expected[c], 1, 1e-12);
}

TEST(Boundary, FurnacesOfGlassAreExact) {
    for (const double eta : {1.0001, 1.5, 2.4, 0.7}) {
        for (const bool is_thin : {false, true}) {
            Scene scene = empty_scene(16, 1.2);
            scene.camera.world_from_camera = support::look_at({1, 2, -4}, {0, 0, 0}, {0, 1, 0});
            add_infinite(scene);
            const int glass = is_thin ? support::add_thin_dielectric(scene, Rgb(eta))
                                      : add_dielectric(scene, Rgb(eta));
            add_shape(scene, support::full_sphere(1), {.material = glass});
            expect_every_pixel(scene, Rgb(1));
        }
    }
}

/// Radiance over eta^2 is what refraction keeps.
TEST(Boundary, InsideGlassRadianceIsGreater) {
    Scene scene = empty_scene(16);
    scene.camera.kind = Camera::Kind::perspective;
    scene.camera.fov = 100;
    scene.camera.world_from_camera = support::look_at({0, 0.3, 0.4}, {1, 0, 0}, {0, 1, 0});
    add_infinite(scene);
    add_shape(scene, support::full_sphere(1), {.material = add_dielectric(scene, Rgb(1.5))});
    expect_every_pixel(scene, Rgb(2.25));
}

/// The camera in glass, z > 0, below a flat boundary to air, lit from below.
Scene under_the_surface(double angle) {
    Scene scene = empty_scene(16, 0.5);
    scene.camera.world_from_camera = turned_camera(pi - angle);
    add_plane(scene, add_dielectric(scene, Rgb(1.5)), 0);
    add_shape(
        scene, support::square_mesh(1e6f, 100, 1),
        {.material = support::black, .area_light = support::add_area_light(scene, Rgb(1), true)});
    return scene;
}

TEST(Boundary, TotalReflectionIsTotal) {
    const double critical = std::asin(1 / 1.5);
    for (const double angle : {critical + 1e-6, 0.9, 1.4, 1.57})
        expect_every_pixel(under_the_surface(angle), Rgb(1));
    for (const Rgb& color : support::render(under_the_surface(critical), 8))
        ASSERT_TRUE(color.g >= 0 && color.g <= 1);
    expect_seen(under_the_surface(critical - 0.05),
                Rgb(fresnel_dielectric(1 / 1.5, std::cos(critical - 0.05))), Rgb(1));
}

TEST(Boundary, BothSidesOfMetalReflect) {
    const Rgb eta(0.2, 0.92, 1.1), k(3.9, 2.45, 2.1);
    for (const float side : {-1.0f, 1.0f}) {
        Scene scene = lit_slab(0, Seen::reflected);
        add_shape(scene, support::square_mesh(10, 0, side),
                  {.material = support::add_conductor(scene, eta, k)});
        expect_every_pixel(scene, fresnel_conductor(eta, k, 1));
    }
}

/// Light that is sampled and light that is run into must add up to what arrives from infinity,
/// which is not sampled.
TEST(Boundary, RoughSurfacesWeighLightsConsistently) {
    for (const bool is_metal : {false, true}) {
        Scene scene = empty_scene(8, 0.9);
        scene.camera.world_from_camera = support::translation({0, 0, -3});
        const int material = is_metal ? support::add_conductor(scene, Rgb(0.2), Rgb(3), 0.3)
                                      : add_dielectric(scene, Rgb(1.5), 0.3);
        add_shape(scene, support::full_sphere(1), {.material = material});
        Scene sampled = scene;
        add_infinite(scene);
        add_shape(sampled, support::full_sphere(10),
                  {.material = support::black,
                   .area_light = support::add_area_light(sampled, Rgb(1), true)});
        const Estimate a = image_mean(scene, 32, 30), b = image_mean(sampled, 32, 60);
        const double error = std::hypot(a.standard_error.x, b.standard_error.x);
        EXPECT_LT(std::abs(a.mean.x - b.mean.x), pass * error)
            << is_metal << ' ' << a.mean.x << ' ' << b.mean.x;
        EXPECT_GT(std::abs(1.05 * a.mean.x - b.mean.x), reject * error) << is_metal;
    }
}

/// ORACLES 1.3: adding and doubling with Fresnel's equations at both faces, normal incidence.
TEST(Boundary, ScatteringSlabsOfAnotherIndex) {
    struct Row {
        double albedo, depth, g, eta, reflected, transmitted;
    };
    for (const Row& row : {Row{0.9, 2, 0.75, 1.5, 0.1268222, 0.4931464},
                           Row{1, 10, 0, 1.33, 0.8014883, 0.1985117}}) {
        for (const Seen seen : {Seen::reflected, Seen::transmitted}) {
            Scene scene = lit_slab(0, seen);
            const int milk = add_medium(scene, Rgb(row.depth * (1 - row.albedo)),
                                        Rgb(row.depth * row.albedo), row.g);
            add_shape(scene, box_mesh({-1e4f, -1e4f, 0}, {1e4f, 1e4f, 1}),
                      {.material = add_dielectric(scene, Rgb(row.eta)), .inside = milk});
            const double expected = seen == Seen::reflected ? row.reflected : row.transmitted;
            expect_seen(scene, Rgb(expected), Rgb(1.08 * expected), 20);
        }
    }
}

} // namespace
} // namespace tyndall::reference

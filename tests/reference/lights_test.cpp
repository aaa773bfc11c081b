// Light sampling: probabilities, densities and what arrives.
#include "reference/lights.h"
#include "support/estimates.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace tyndall::reference {
namespace {

using support::add_light;
using support::add_shape;
using support::scaling;
using support::translation;

glm::uvec4 words(std::uint32_t i) {
    return RandomPath{{3, 0}, 0, i}.words(1, shared::BLOCK_LIGHT);
}

TEST(AliasTable, DrawsInProportionToTheWeights) {
    const std::vector<double> weights = {1, 0, 5, 0.25, 3, 0.75};
    const AliasTable table(weights);
    std::vector<double> counts(weights.size());
    constexpr std::uint32_t n = 1000000; // Evenly spaced words: exact up to their spacing.
    for (std::uint32_t i = 0; i < n; ++i)
        counts[table.choose(static_cast<std::uint32_t>((i + 0.5) * 4294.967296))] += 1.0 / n;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        EXPECT_NEAR(counts[i], weights[i] / 10, 1e-5);
        EXPECT_NEAR(table.probability(i), weights[i] / 10, 1e-15);
    }
    EXPECT_EQ(counts[1], 0);
    EXPECT_TRUE(AliasTable({0, 0}).empty());
    EXPECT_TRUE(AliasTable({}).empty());
    EXPECT_EQ(AliasTable({7}).choose(0xffffffffu), 0u);
}

/// A scene whose only light is one emitting, two-sided shape.
struct EmitterScene {
    EmitterScene(const std::variant<Mesh, Sphere, Disk>& shape, const glm::dmat4& place)
        : scene(make(shape, place)), geometry(scene, dvec3(0)), lights(scene, geometry, dvec3(0)) {}

    static Scene make(const std::variant<Mesh, Sphere, Disk>& geometry, const glm::dmat4& place) {
        Scene scene = support::empty_scene(1);
        const int light = support::add_area_light(scene, Rgb(1), true);
        add_shape(scene, geometry, {.material = support::black, .area_light = light}, place);
        return scene;
    }

    Scene scene;
    Geometry geometry;
    Lights lights;
};

/// The mean of 1 / density is the solid angle, if all of the surface is seen; and the density of a
/// sample is the one that a ray which hits that point is told.
support::Estimate solid_angle(const EmitterScene& emitter, const dvec3& place) {
    constexpr std::uint32_t n = 100000;
    double sum = 0, squares = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
        const auto sample = emitter.lights.sample(place, words(i), {});
        if (!sample) continue;
        sum += 1 / sample->probability;
        squares += 1 / (sample->probability * sample->probability);
        if (i % 100) continue;
        const auto hit = emitter.geometry.intersect({place, sample->direction}, 1e9);
        if (!hit) return {}; // Which no solid angle matches.
        EXPECT_NEAR(emitter.lights.density(place, *hit) / sample->probability, 1, 1e-6);
    }
    const double mean = sum / n;
    return {Rgb(mean), Rgb(std::sqrt(std::max(0.0, squares / n - mean * mean) / n))};
}

void expect_solid_angle(const std::variant<Mesh, Sphere, Disk>& geometry, const glm::dmat4& place,
                        const dvec3& from, double expected) {
    const auto estimate = solid_angle(EmitterScene(geometry, place), from);
    EXPECT_LT(estimate.z(expected), support::pass) << estimate.mean.x << " expected " << expected;
    EXPECT_GT(estimate.z(1.05 * expected), support::reject);
}

/// Van Oosterom and Strackee 1983.
double triangle_solid_angle(dvec3 a, dvec3 b, dvec3 c) {
    a = glm::normalize(a), b = glm::normalize(b), c = glm::normalize(c);
    const double d = 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a);
    return 2 * std::atan2(std::abs(glm::dot(a, glm::cross(b, c))), d);
}

TEST(AreaLights, SampleTheirSolidAngle) {
    const glm::dmat4 same(1);
    const dvec3 origin(0);
    Mesh triangle;
    triangle.positions = {{1, 0, 1}, {2, 1.5f, 0.5f}, {-1, 2, 1}};
    triangle.triangles = {{0, 1, 2}};
    expect_solid_angle(triangle, same, origin,
                       triangle_solid_angle({1, 0, 1}, {2, 1.5, 0.5}, {-1, 2, 1}));
    Disk disk;
    disk.height = 0.7;
    disk.radius = 1.2;
    expect_solid_angle(disk, same, origin, 2 * pi * (1 - 0.7 / std::hypot(0.7, 1.2)));
    // Outside of a ball; inside of one; the middle of a distorted one; cut, from the centre.
    expect_solid_angle(support::full_sphere(2), same, {0, 0, 2.5}, 2 * pi * (1 - 0.6));
    expect_solid_angle(support::full_sphere(2), same, {0, 0.3, 1.2}, 4 * pi);
    expect_solid_angle(support::full_sphere(1), translation({1, 0, 0}) * scaling({2, 1, 3}),
                       {1, 0, 0}, 4 * pi);
    Sphere cut = support::full_sphere(2);
    cut.z_min = -0.5;
    cut.phi_max = 1.5;
    expect_solid_angle(cut, same, origin, 1.5 * 2.5 / 2);
}

TEST(AreaLights, PatchesSampleTheirSolidAngle) {
    Mesh patch; // Not planar, and seen from one side only: its edges bound the solid angle.
    patch.positions = {{-1, -1, 2}, {1, -1, 2.6f}, {-1, 1, 2.4f}, {1, 1, 2}};
    patch.patches = {{0, 1, 2, 3}};
    constexpr int n = 100;
    double expected = 0;
    const auto at = [](double u, double v) {
        return dvec3(2 * u - 1, 2 * v - 1,
                     glm::mix(glm::mix(2.0, 2.6, u), glm::mix(2.4, 2.0, u), v));
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const double u0 = i / 100.0, u1 = (i + 1) / 100.0, v0 = j / 100.0, v1 = (j + 1) / 100.0;
            expected += triangle_solid_angle(at(u0, v0), at(u1, v0), at(u0, v1)) +
                        triangle_solid_angle(at(u1, v0), at(u1, v1), at(u0, v1));
        }
    }
    expect_solid_angle(patch, glm::dmat4(1), dvec3(0), expected);
}

TEST(AreaLights, OnlyTheFrontEmitsUnlessTwoSided) {
    for (const bool two_sided : {false, true}) {
        Scene scene = support::empty_scene(1);
        const int light = support::add_area_light(scene, Rgb(1), two_sided);
        add_shape(scene, Disk{}, {.material = support::black, .area_light = light});
        const Geometry geometry(scene, dvec3(0));
        const Lights lights(scene, geometry, dvec3(0));
        const auto front = geometry.intersect({{0.5, 0, 2}, {0, 0, -1}}, 9);
        const auto back = geometry.intersect({{0.5, 0, -2}, {0, 0, 1}}, 9);
        EXPECT_EQ(lights.emitted(*front, {0, 0, -1}), Rgb(1));
        EXPECT_EQ(lights.emitted(*back, {0, 0, 1}), Rgb(two_sided ? 1 : 0));
        EXPECT_TRUE(lights.sample({0.5, 0, 2}, words(0), {}).has_value());
        EXPECT_EQ(lights.sample({0.5, 0, -2}, words(0), {}).has_value(), two_sided);
    }
}

TEST(AreaLights, PowerIsThatOfEachPrimitive) {
    Scene scene = support::empty_scene(1);
    const int light = support::add_area_light(scene, Rgb(0));
    scene.area_lights[0].power_radiance = Rgb(6);
    add_shape(scene, support::square_mesh(1, 0, 1),
              {.material = support::black, .area_light = light});
    const Geometry geometry(scene, dvec3(0));
    const Lights lights(scene, geometry, dvec3(0));
    const auto hit = geometry.intersect({{0.5, 0.2, 2}, {0, 0, -1}}, 9);
    EXPECT_NEAR(lights.emitted(*hit, {0, 0, -1}).x, 3, 1e-13); // Each triangle has the area 2.
}

TEST(Lights, DeltaLightsGiveWhatTheyShould) {
    Scene scene = support::empty_scene(1);
    add_shape(scene, support::full_sphere(0.01), {});
    scene.camera.world_from_camera = translation({0, 0, 1});
    const auto arriving = [&](const auto& light, const dvec3& world_place) {
        scene.lights.clear();
        add_light(scene, light);
        const dvec3 camera(0, 0, 1);
        const Geometry geometry(scene, camera);
        const auto sample =
            Lights(scene, geometry, camera).sample(world_place - camera, words(0), {});
        return sample ? sample->radiance.x : 0;
    };
    EXPECT_NEAR(arriving(PointLight{Rgb(8), {0, 0, 4}}, {0, 0, 2}), 2, 1e-14);
    EXPECT_NEAR(arriving(DistantLight{Rgb(3), {0, 1, 0}}, {5, 5, 5}), 3, 1e-14);
    const SpotLight spot{Rgb(4), {0, 0, 0}, {1, 0, 0}, 0.9, 0.5};
    EXPECT_NEAR(arriving(spot, {2, 0, 0}), 1, 1e-14);
    EXPECT_NEAR(arriving(spot, {0.7 * 2, std::sqrt(1 - 0.49) * 2, 0}), 0.5, 1e-12); // Halfway.
    EXPECT_EQ(arriving(spot, {0.49, std::sqrt(1 - 0.49 * 0.49), 0}), 0);
    EXPECT_EQ(arriving(spot, {-1, 0, 0}), 0);
}

TEST(Lights, InfiniteOnesAreNotSampled) {
    Scene scene = support::empty_scene(1);
    support::add_infinite(scene, Rgb(1));
    support::add_infinite(scene, Rgb(2));
    const Geometry geometry(scene, dvec3(0));
    const Lights lights(scene, geometry, dvec3(0));
    EXPECT_FALSE(lights.can_sample());
    EXPECT_EQ(lights.background(), Rgb(3));
}

} // namespace
} // namespace tyndall::reference

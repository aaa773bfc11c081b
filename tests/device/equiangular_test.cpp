// Light of point and spot lights that paths look for where they pass (wavefront/passing.glsl):
// right, the same as without it, less noisy, and sound where lights are in the way.
#include "device/device_test.h"
#include "device/test_scenes.h"

#include <cmath>

namespace tyndall::device_test {
namespace {

using namespace support;

class EquiangularTest : public DeviceTest {};

Renderer make_renderer(const Scene& scene, bool looks) {
    Effects effects = compute_effects(scene);
    EXPECT_EQ(effects.features.has_equiangular, 1) << "no teeth";
    effects.features.has_equiangular = looks;
    return Renderer(context(), scene, effects, {});
}

Estimate estimate(const Scene& scene, std::uint32_t samples, bool looks = true) {
    Renderer renderer = make_renderer(scene, looks);
    renderer.render(0, samples);
    return mean_of(renderer.read_film());
}

/// An isotropic point light of intensity 1 beside the line of sight, in fog that ends at a wall.
struct Airlight {
    double sigma_s, sigma_t, g, distance, along, length, expected;
};

Scene fog_before_wall(const Airlight& row) {
    Scene scene = empty_scene(16, 1e-6);
    scene.integrator.max_depth = 1;
    scene.camera.medium =
        add_medium(scene, Rgb(row.sigma_t - row.sigma_s), Rgb(row.sigma_s), row.g);
    add_shape(scene, square_mesh(100, static_cast<float>(row.length), -1), {.material = black});
    add_light(scene, PointLight{Rgb(1), {row.distance, 0, row.along}});
    return scene;
}

/// What collisions bring if they are not weighed, beside what is found in passing: the integral
/// with the weight of the latter added once more, by the midpoint rule.
double counted_twice(const Airlight& row) {
    const double begin = std::atan(-row.along / row.distance);
    const double angle = std::atan((row.length - row.along) / row.distance) - begin;
    const double passing = std::exp(-row.sigma_s * row.length);
    double sum = 0;
    const int steps = 20000;
    for (int i = 0; i < steps; ++i) {
        const double theta = begin + angle * (i + 0.5) / steps;
        const double t = row.along + row.distance * std::tan(theta);
        const double away = row.distance / std::cos(theta); // dt = away^2 / distance dtheta
        const double collision = row.sigma_s * std::exp(-row.sigma_s * t);
        const double chosen = passing * row.distance / (angle * away * away);
        const double mu = (row.along - t) / away;
        const double phase =
            (1 - row.g * row.g) /
            (4 * 3.14159265358979 * std::pow(1 + row.g * row.g - 2 * row.g * mu, 1.5));
        sum += row.sigma_s * std::exp(-row.sigma_t * (t + away)) * phase / row.distance *
               (1 + chosen / (collision + chosen));
    }
    return sum * angle / steps;
}

TEST_F(EquiangularTest, AirlightIsThatOfItsQuadrature) {
    for (const Airlight& row : {Airlight{0.2, 0.2, 0, 1, 5, 10, 0.012125968538925},
                                Airlight{0.2, 0.2, 0.75, 1, 5, 10, 0.020095438946198},
                                Airlight{0.2, 0.2, -0.5, 1, 5, 10, 0.010190605923703},
                                Airlight{0.5, 1, 0, 0.1, 2, 4, 0.13634116884132}})
        expect_mean(estimate(fog_before_wall(row), 2048), row.expected, counted_twice(row));
}

TEST_F(EquiangularTest, HasLessNoise) {
    const Scene scene = fog_before_wall({0.02, 0.02, 0, 0.1, 2, 4, 0});
    EXPECT_LT(4 * estimate(scene, 512).standard_error[1],
              estimate(scene, 512, false).standard_error[1]);
}

/// Two boxes of thin media, of which the channels may differ, on a floor; a point light and two
/// spot lights, one of which is as wide as the half space.
Scene thin_media(const Rgb& sigma_s) {
    Scene scene = empty_scene(16);
    scene.integrator.max_depth = 6;
    scene.camera.world_from_camera = look_at({0, 1, -6}, {0, 0, 0}, {0, 1, 0});
    add_shape(scene, box_mesh({-9, -1.4f, -9}, {9, -1.2f, 9}),
              {.material = add_diffuse(scene, Rgb(0.4))});
    const int fog = add_medium(scene, {0.02, 0.01, 0.03}, sigma_s, 0.4);
    const int mist = add_medium(scene, Rgb(0), 2.0 * sigma_s);
    add_shape(scene, box_mesh({-2, -1.1f, -2}, {0.2f, 2, 2}), {.inside = fog});
    add_shape(scene, full_sphere(1), {.inside = mist}, translation({1.3, 0, 0}));
    add_light(scene, PointLight{Rgb(2, 3, 4), {-0.7, 0.3, 0.2}});
    const auto spot = [&](const Rgb& intensity, const glm::dvec3& from, const glm::dvec3& to,
                          double start, double width) {
        add_light(scene, SpotLight{intensity, from, glm::normalize(to - from), start, width});
    };
    spot({300, 200, 100}, {5, 6, -2}, {-0.5, 0, 0}, 0.998, 0.995);
    spot({4, 5, 6}, {1.2, 1.5, 0}, {1.3, 0, 0.1}, 0.5, 0);
    return scene;
}

TEST_F(EquiangularTest, ChangesNoImageButItsNoise) {
    for (const Rgb& sigma_s : {Rgb(0.1), Rgb(0.03, 0.1, 0.3)}) {
        const Scene scene = thin_media(sigma_s);
        const auto batches = [&](bool looks) {
            Renderer renderer = make_renderer(scene, looks);
            std::vector<stats::PixelSums> sums;
            for (std::uint32_t i = 0; i < 16; ++i) {
                renderer.render(64 * i, 64 * (i + 1));
                sums.push_back(renderer.read_sums());
            }
            return sums;
        };
        expect_agreement(batches(true), batches(false), 16, 0.1);
    }
}

TEST_F(EquiangularTest, AgreesWithTheReference) {
    for (const Rgb& sigma_s : {Rgb(0.1), Rgb(0.03, 0.1, 0.3)})
        expect_agreement(thin_media(sigma_s), 16);
    Scene region = plain_scene(); // without a hierarchy
    region.media[0].sigma_s = Rgb(0.2);
    add_light(region, PointLight{Rgb(3), {0.2, 0.3, -0.4}});
    expect_agreement(region, 16);
}

/// Some light is exactly on a ray, where the camera is, far away, or next to a segment of no
/// length: all of it finite, and nothing counted as wrong.
TEST_F(EquiangularTest, IsSoundWhereLightsAreInTheWay) {
    for (const glm::dvec3& at : {glm::dvec3(0, 0, 2), glm::dvec3(0, 0, 0), glm::dvec3(0, 0, 4),
                                 glm::dvec3(1e7, 0, 2), glm::dvec3(1e-7, 0, 2)}) {
        for (const double length : {4.0, 1e-5, 1e6}) {
            Scene scene = fog_before_wall({0.2, 0.3, 0.5, 0, 0, length, 0});
            trace_pixel_centers(scene);
            scene.integrator.max_depth = 4;
            scene.lights[0].emitter = PointLight{Rgb(1), at};
            add_light(scene, SpotLight{Rgb(1), at, {0, 0, 1}, 0.9999, 0.999});
            Renderer renderer = make_renderer(scene, true);
            renderer.render(0, 256);
            EXPECT_TRUE(renderer.health().is_good()) << at.x << ' ' << at.z << ' ' << length;
        }
    }
}

TEST_F(EquiangularTest, IsForSmallLightsInHomogeneousMedia) {
    const auto looks = [](const Scene& scene) {
        return compute_effects(scene).features.has_equiangular == 1;
    };
    const Scene scene = thin_media(Rgb(0.1));
    EXPECT_TRUE(looks(scene));
    Scene sun = scene;
    sun.lights.clear();
    add_light(sun, DistantLight{Rgb(1), {0, -1, 0}});
    Scene clear = scene, air = scene, analog = scene, march = scene;
    for (Medium& medium : clear.media)
        medium.sigma_s = Rgb(0);
    for (Medium& medium : air.media)
        medium.density = ExponentialDensity{};
    analog.integrator.absorption = Integrator::Absorption::analog;
    march.integrator.kind = Integrator::Kind::singlescatter;
    for (const Scene& other : {sun, clear, air, analog, march})
        EXPECT_FALSE(looks(other));
    // Built in where nothing calls for it, it changes no bit.
    const auto sums = [&](bool forced) {
        Effects effects = compute_effects(air);
        effects.features.has_equiangular = forced;
        Renderer renderer(context(), air, effects, {});
        renderer.render(0, 4);
        return renderer.read_sums();
    };
    EXPECT_EQ(sums(true), sums(false));
}

} // namespace
} // namespace tyndall::device_test

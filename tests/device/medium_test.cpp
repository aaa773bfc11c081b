// Media with closed forms: emission, and the light of a lamp in fog.
#include "device/device_test.h"
#include "device/test_scenes.h"

#include <cmath>
#include <functional>

namespace tyndall::device_test {
namespace {

using namespace support;

constexpr double kPi = 3.14159265358979323846;

class MediumTest : public DeviceTest {};

/// A slab of depth 1 across the whole view, under a sky of this radiance.
Scene slab_view(double sigma_a, double emission, double sky) {
    Scene scene = empty_scene(4, 0.5);
    scene.camera.world_from_camera = translation({0, 0, -2});
    const int medium = add_medium(scene, Rgb(sigma_a), Rgb(0));
    scene.media[static_cast<std::size_t>(medium)].emission = Rgb(emission);
    add_shape(scene, box_mesh({-5, -5, 0}, {5, 5, 1}), {.inside = medium});
    if (sky > 0) add_infinite(scene, Rgb(sky));
    return scene;
}

TEST_F(MediumTest, EmissionAndAbsorption) {
    for (bool hierarchy : {false, true}) {
        for (double sigma : {1e-6, 0.3, 4.0}) {
            Scene scene = slab_view(sigma, 3, 0);
            if (hierarchy) add_shape(scene, Disk{}, {.material = black}, translation({90, 0, 0}));
            // 1 - exp(-x) keeps its digits where x is small. The box is cut to seven digits in
            // float32, and its front is 2 away.
            const double truth = -3 * std::expm1(-sigma);
            const double seen = render(scene, 8).at(1, 2, 0);
            EXPECT_NEAR(seen / truth, 1, 1e-5) << sigma;
            EXPECT_GT(std::abs(seen / (truth * 1.001) - 1), 1e-5); // the control
            Scene lit = slab_view(sigma, 3, 2);
            EXPECT_NEAR(render(lit, 8).at(1, 2, 0), truth + 2 * std::exp(-sigma), 3e-5);
        }
    }
}

TEST_F(MediumTest, EmissionOfMediaThatScatterAgreesWithTheReference) {
    for (Scene scene : {plain_scene(), busy_scene()}) {
        scene.lights.clear();
        scene.media[0].emission = {1, 2, 0.5};
        if (scene.media.size() > 1) scene.media[1].emission = {0, 0, 3};
        expect_agreement(scene, 16);
    }
}

/// Single scattering of a point light in an unbounded medium, by the equiangular substitution: the
/// light is `offset` beside the ray, at `depth` along it; the ray ends at `end`.
struct Airlight {
    double sigma_s, sigma_t, g, offset, depth, end;
    std::function<double(double)> intensity = [](double) {
        return 1;
    }; ///< Of the angle off the ray.

    double radiance() const {
        const double from = std::atan(-depth / offset), to = std::atan((end - depth) / offset);
        constexpr int steps = 200000;
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            const double theta = from + (to - from) * (i + 0.5) / steps;
            const double cosine = -std::sin(theta); // between the directions of travel
            const double way = depth + offset * std::tan(theta) + offset / std::cos(theta);
            const double base = 1 + g * g - 2 * g * cosine;
            const double phase = (1 - g * g) / (4 * kPi * base * std::sqrt(base));
            sum += std::exp(-sigma_t * way) * phase * intensity(theta);
        }
        return sigma_s / offset * sum * (to - from) / steps;
    }

    /// Camera in the fog, looking at a black wall.
    Scene scene() const {
        Scene result = empty_scene(16, 1e-6);
        result.integrator.max_depth = 1;
        const int fog = add_medium(result, Rgb(sigma_t - sigma_s), Rgb(sigma_s), g);
        result.camera.medium = fog;
        add_shape(result, square_mesh(50, static_cast<float>(end), -1),
                  {.material = black, .inside = fog, .outside = fog});
        return result;
    }
    glm::dvec3 light() const { return {offset, 0, depth}; }
};

/// Reference values to 30 digits; see Airlight.
struct Row {
    Airlight airlight;
    double radiance;
};
const Row kRows[] = {{{0.2, 0.2, 0, 1, 5, 10}, 0.012125968538925},
                     {{0.2, 0.2, 0.75, 1, 5, 10}, 0.020095438946198},
                     {{0.2, 0.2, -0.5, 1, 5, 10}, 0.010190605923703}};

TEST_F(MediumTest, AirlightOfAPointLight) {
    for (const Row& row : kRows) {
        EXPECT_NEAR(row.airlight.radiance() / row.radiance, 1, 1e-8);
        Scene scene = row.airlight.scene();
        add_light(scene, PointLight{Rgb(1), row.airlight.light()});
        Airlight wrong = row.airlight; // 10 % further
        wrong.offset *= 1.1;
        expect_mean(mean_of(scene, 512), row.radiance, wrong.radiance());
    }
    // Nothing scatters where nothing can.
    Airlight dark = kRows[0].airlight;
    dark.sigma_s = 0;
    Scene scene = dark.scene();
    add_light(scene, PointLight{Rgb(1), dark.light()});
    EXPECT_EQ(mean_of(scene, 4).mean, Rgb(0));
}

TEST_F(MediumTest, AirlightOfASpotLight) {
    Airlight airlight = kRows[1].airlight;
    const double start = std::cos(glm::radians(25.0)), end = std::cos(glm::radians(35.0));
    airlight.intensity = [&](double theta) { // the axis is perpendicular to the ray
        const double x = std::clamp((std::cos(theta) - end) / (start - end), 0.0, 1.0);
        return x * x * (3 - 2 * x);
    };
    Scene scene = airlight.scene();
    add_light(scene, SpotLight{Rgb(1), airlight.light(), {-1, 0, 0}, start, end});
    Airlight wrong = airlight; // falls off at once
    wrong.intensity = [&](double theta) { return std::cos(theta) > end; };
    expect_mean(mean_of(scene, 1024), airlight.radiance(), wrong.radiance());
}

TEST_F(MediumTest, NothingArrivesThroughAnUnboundedMedium) {
    Scene scene = kRows[0].airlight.scene();
    scene.integrator.max_depth = 100;
    add_light(scene, DistantLight{Rgb(1), {0, 0, 1}});
    add_infinite(scene);
    EXPECT_EQ(mean_of(scene, 16).mean, Rgb(0));
    scene.shapes.clear(); // nor without a wall
    EXPECT_EQ(mean_of(scene, 16).mean, Rgb(0));
    scene.media[0].sigma_s = scene.media[0].sigma_a = Rgb(0); // the control
    EXPECT_EQ(mean_of(scene, 16).mean, Rgb(1));
}

/// An isotropically scattering ball in a white furnace: what it absorbs, averaged over a parallel
/// view of its disk (Peierls' integral equation, 800 nodes; and a second Monte Carlo program).
TEST_F(MediumTest, AbsorptionOfAScatteringBall) {
    struct Case {
        double albedo, radius, absorbed;
    };
    for (const Case& c :
         {Case{0.5, 1, 0.4577429}, Case{0.9, 5, 0.3765154}, Case{0.99, 10, 0.1061810}}) {
        for (bool hierarchy : {false, true}) {
            Scene scene = empty_scene(32, 1);
            scene.camera.world_from_camera = translation({0, 0, -3});
            add_infinite(scene);
            const Rgb sigma_t(c.radius);
            add_shape(scene, full_sphere(1),
                      {.inside = add_medium(scene, (1 - c.albedo) * sigma_t, c.albedo * sigma_t)});
            if (hierarchy) add_shape(scene, Disk{}, {.material = black}, translation({90, 0, 0}));
            const Estimate film = mean_of(scene, 256);
            // The disk is pi / 4 of the picture; beside it, radiance is 1.
            const auto mean = [](double absorbed) { return 1 - kPi / 4 * absorbed; };
            // Which rays meet the disk is noise, too: it is in the standard error.
            expect_mean(film, mean(c.absorbed), mean(0.98 * c.absorbed));
        }
    }
}

} // namespace
} // namespace tyndall::device_test

// Lights without a shape, many lights, many kinds of lights.
#include "device/device_test.h"
#include "device/test_scenes.h"

#include <functional>

namespace tyndall::device_test {
namespace {

using namespace support;

class LightTest : public DeviceTest {};

Scene lit_by(const std::function<void(Scene&)>& add) {
    Scene scene = dark_scene();
    add(scene);
    return scene;
}

TEST_F(LightTest, LightsWithoutAShapeAgreeWithTheReference) {
    expect_agreement(lit_by([](Scene& s) {
                         add_light(s, PointLight{{9, 8, 7}, {0.5, 2, -1}});
                     }),
                     16);
    expect_agreement(lit_by([](Scene& s) {
                         add_light(s, SpotLight{{40, 30, 20},
                                                {2, 4, -2},
                                                glm::normalize(glm::dvec3(-2, -4, 2)),
                                                0.97,
                                                0.93});
                     }),
                     16);
    expect_agreement(
        lit_by([](Scene& s) {
            add_light(s, DistantLight{{3, 2, 1}, glm::normalize(glm::dvec3(1, -3, 2))});
        }),
        16);
    expect_agreement(lit_by([](Scene& s) { add_infinite(s, {1, 0.5, 0.25}); }), 16);
}

TEST_F(LightTest, ManyKindsTogetherAgreeWithTheReference) {
    Scene scene = busy_scene();
    add_light(scene, PointLight{{9, 8, 7}, {0.5, 2, -1}});
    add_light(
        scene,
        SpotLight{{40, 30, 20}, {2, 2.5, -2}, glm::normalize(glm::dvec3(-1, -1, 1)), 0.95, 0.9});
    add_light(scene, DistantLight{{1, 2, 1}, glm::normalize(glm::dvec3(1, -3, 2))});
    expect_agreement(scene, 16);
}

/// Numbers in [0, 1) without any pattern that matters.
class Scatter {
  public:
    double next() {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<double>(state_ >> 11) * 0x1p-53;
    }
    glm::dvec3 point(const glm::dvec3& lower, const glm::dvec3& upper) {
        const double x = next(), y = next(), z = next();
        return lower + (upper - lower) * glm::dvec3(x, y, z);
    }

  private:
    std::uint64_t state_ = 1;
};

TEST_F(LightTest, AThousandPointLights) {
    expect_agreement(
        lit_by([](Scene& scene) {
            Scatter scatter;
            for (int i = 0; i < 1000; ++i) {
                const glm::dvec3 at = scatter.point({-2.5, 0.5, -2.5}, {2.5, 2.8, 2.5});
                add_light(scene, PointLight{0.05 * scatter.point({0, 0, 0}, {1, 1, 1}), at});
            }
        }),
        16);
}

/// Power alone chooses without bias, too.
TEST_F(LightTest, ChoiceByPlaceLeavesThePicture) {
    Scene scene = dark_scene();
    Scatter scatter;
    for (int i = 0; i < 12; ++i) {
        const int light = add_area_light(scene, scatter.point(glm::dvec3(1), glm::dvec3(9)));
        add_shape(scene, full_sphere(0.15),
                  {.material = black, .inside = 0, .outside = 0, .area_light = light},
                  translation(scatter.point({-2, 1, -2}, {2, 2.8, 2})));
    }
    Effects effects = compute_effects(scene);
    ASSERT_GE(effects.features.light_candidates, 12) << "no teeth";
    const auto mean_with = [&](std::uint32_t candidates) {
        effects.features.light_candidates = candidates;
        Renderer renderer(context(), scene, effects, {});
        renderer.render(0, 2048);
        return mean_of(renderer.read_film());
    };
    Estimate by_place = mean_with(effects.features.light_candidates);
    const Estimate by_power = mean_with(1);
    EXPECT_LT(by_place.standard_error.y, by_power.standard_error.y);
    by_place.standard_error =
        glm::length(glm::dvec2(by_place.standard_error.y, by_power.standard_error.y)) * Rgb(1);
    expect_mean(by_place, by_power.mean.y, 0.95 * by_power.mean.y);
}

TEST_F(LightTest, TwoHundredEmittingTriangles) {
    for (bool by_power : {false, true}) {
        expect_agreement(
            lit_by([&](Scene& scene) {
                Scatter scatter;
                Mesh mesh;
                for (std::uint32_t i = 0; i < 200; ++i) {
                    const glm::vec3 at = scatter.point({-2.5, 2, -2.5}, {2.5, 2.8, 2.5});
                    for (int corner = 0; corner < 3; ++corner)
                        mesh.positions.push_back(
                            at + glm::vec3(scatter.point(glm::dvec3(-0.2), glm::dvec3(0.2))));
                    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
                }
                const int light = add_area_light(scene, {8, 4, 2}, true);
                if (by_power)
                    scene.area_lights[static_cast<std::size_t>(light)] = {
                        Rgb(0), {0.1, 0.2, 0.1}, true};
                add_shape(scene, mesh,
                          {.material = black, .inside = 0, .outside = 0, .area_light = light});
            }),
            16);
    }
}

TEST_F(LightTest, TheWholeSceneAgreesWithTheReference) {
    expect_agreement(busy_scene(), 16);
    expect_agreement(plain_scene(), 16);
}

} // namespace
} // namespace tyndall::device_test

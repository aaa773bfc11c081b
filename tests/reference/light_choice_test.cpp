// Choice among lights by what they bring to a place: whatever it is led by, nothing is lost.
#include "reference/lights.h"
#include "support/estimates.h"
#include "support/scenes.h"

#include <gtest/gtest.h>
#include <numeric>

namespace tyndall::reference {
namespace {

using namespace support;

constexpr std::uint32_t kSamples = 200000;

RandomPath path_of(Sampler sampler, std::uint32_t sample) {
    return {{3, 0}, 0, sample, sampler};
}

Estimate estimate_of(double sum, double squares) {
    const double mean = sum / kSamples;
    return {Rgb(mean), Rgb(std::sqrt(std::max(0.0, squares / kSamples - mean * mean) / kSamples))};
}

/// Lights whose powers, importances and contributions have nothing to do with each other.
struct Case {
    std::vector<double> powers{1, 0, 4, 0.5, 2, 3, 0.1, 1, 1};
    std::vector<double> importances{2, 5, 0, 1, 0.01, 3, 40, 1, 0.5};
    std::vector<double> contributions{1, 0, 0, 2, 1, 3, 0.5, 2, 1};
    double truth = std::accumulate(contributions.begin(), contributions.end(), 0.0);

    LightChoice choice(std::uint32_t candidates) const {
        std::vector<LightReach> reaches;
        for (const double importance : importances)
            reaches.push_back({importance});
        return {powers, reaches, candidates};
    }
};

/// Mean of what is chosen, over the probability that it is told to have.
Estimate sum_of_contributions(const Case& lights, std::uint32_t candidates, Sampler sampler,
                              bool is_weighed = true) {
    const LightChoice choice = lights.choice(candidates);
    double sum = 0, squares = 0;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const auto chosen =
            choice.choose(dvec3(0), path_of(sampler, i).words(1, shared::BLOCK_LIGHT));
        if (!chosen) continue;
        const double value = lights.contributions[chosen->light] *
                             (is_weighed ? chosen->weight : 1) /
                             choice.mis_probability(chosen->light);
        sum += value;
        squares += value * value;
    }
    return estimate_of(sum, squares);
}

TEST(LightChoice, LosesNothing) {
    const Case lights;
    for (const Sampler sampler : {Sampler::independent, Sampler::sobol, Sampler::zsobol})
        for (const std::uint32_t candidates : {1u, 2u, 5u, 9u, 16u}) {
            const Estimate estimate = sum_of_contributions(lights, candidates, sampler);
            EXPECT_LT(estimate.z(lights.truth), pass) << candidates << ": " << estimate.mean.x;
            EXPECT_GT(estimate.z(1.1 * lights.truth), reject) << "no teeth";
            if (candidates == 1) continue;
            const Estimate wrong = sum_of_contributions(lights, candidates, sampler, false);
            EXPECT_GT(wrong.z(lights.truth), reject) << "no teeth without weights";
        }
}

/// Importance that is right leaves no noise but that of which lights are candidates.
TEST(LightChoice, LeavesLessNoiseTheMoreCandidates) {
    Case lights;
    lights.importances = lights.contributions;
    for (std::size_t i = 0; i < lights.powers.size(); ++i)
        lights.importances[i] /= std::max(lights.powers[i], 1e-3);
    double before = sum_of_contributions(lights, 1, Sampler::independent).standard_error.x;
    for (const std::uint32_t candidates : {4u, 16u}) {
        const double error =
            sum_of_contributions(lights, candidates, Sampler::independent).standard_error.x;
        EXPECT_LT(error, 0.6 * before) << candidates;
        before = error;
    }
}

/// Two of each kind of light, near the place and far from it.
Scene scene_of_all_kinds() {
    Scene scene = empty_scene(1);
    const int lamp = add_area_light(scene, Rgb(3)), pane = add_area_light(scene, Rgb(2), true);
    for (const double x : {-1.5, 4.0}) {
        const glm::dmat4 place = translation({x, 2, 0.5});
        add_light(scene, PointLight{Rgb(2), {x, 1, 1}});
        add_light(scene,
                  SpotLight{Rgb(9), {x, 3, 0}, glm::normalize(dvec3(-x, -3, 0.2)), 0.9, 0.7});
        add_shape(scene, Disk{}, {.material = black, .area_light = lamp}, place);
        add_shape(scene, full_sphere(0.4), {.material = black, .area_light = lamp}, place);
        Sphere cut = full_sphere(0.5);
        cut.z_max = 0.2;
        add_shape(scene, cut, {.material = black, .area_light = lamp}, place);
        Mesh mesh = square_mesh(1, 0, -1);
        mesh.patches = {{0, 1, 3, 2}};
        add_shape(scene, mesh, {.material = black, .area_light = pane}, place);
        add_shape(scene, mesh, {.material = black, .area_light = lamp}, place);
    }
    add_light(scene, DistantLight{Rgb(0.3), {0, -1, 0}});
    return scene;
}

/// What arrives at a place in all, with nothing in between.
Estimate light_at(const Lights& lights, const dvec3& place) {
    double sum = 0, squares = 0;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const auto words = path_of(Sampler::independent, i).words(1, shared::BLOCK_LIGHT);
        const auto sample = lights.sample(place, words, {});
        if (!sample) continue;
        const double value = sample->radiance.x / sample->probability;
        sum += value;
        squares += value * value;
    }
    return estimate_of(sum, squares);
}

/// Each light on its own is there whatever choice says. A single light is chosen without.
TEST(LightChoice, EachKindOfLightArrives) {
    const Scene scene = scene_of_all_kinds();
    for (const dvec3& place : {dvec3(0), dvec3(-1.2, 2.1, 0.7), dvec3(3, 1, -2)}) {
        double truth = 0, variance = 0;
        Scene one = scene;
        const auto add_alone = [&] {
            const Geometry geometry(one, dvec3(0));
            const Estimate alone = light_at(Lights(one, geometry, dvec3(0)), place);
            truth += alone.mean.x;
            variance += alone.standard_error.x * alone.standard_error.x;
        };
        one.shapes.clear();
        for (const Light& light : scene.lights)
            one.lights = {light}, add_alone();
        one.lights.clear();
        for (const Shape& shape : scene.shapes)
            one.shapes = {shape}, add_alone();
        const Geometry geometry(scene, dvec3(0));
        Estimate all = light_at(Lights(scene, geometry, dvec3(0)), place);
        all.standard_error.x = std::sqrt(variance + all.standard_error.x * all.standard_error.x);
        EXPECT_LT(all.z(truth), pass) << all.mean.x << " of " << truth;
        EXPECT_GT(all.z(1.05 * truth), reject) << "no teeth";
    }
}

} // namespace
} // namespace tyndall::reference

// Hard cases that are no row of the table: rays that must not leak, sample indices next to their
// end, flights of next to no length.
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "selftest/cases.h"
#include "selftest/evaluator.h"

#include <algorithm>
#include <cmath>

namespace tyndall::stability {
namespace {

using namespace support;
using device_test::dark_tube;
using device_test::DeviceTest;
using device_test::mean_of;
using device_test::render;

class Leaks : public DeviceTest {};

TEST_F(Leaks, MillionsOfRaysStayInAClosedMesh) {
    EXPECT_EQ(mean_of(render(dark_tube(), 5'000'000 / (256 * 256))).mean, Rgb(0));
    Scene open = dark_tube(); // the control
    auto& triangles = std::get<Mesh>(open.shapes[0].geometry).triangles;
    triangles.erase(triangles.begin() + 24, triangles.begin() + 48); // the second ring's
    EXPECT_GT(mean_of(render(open, 1)).mean.g, 0);
}

class Samples : public DeviceTest {};

/// The last samples that there are.
TEST_F(Samples, LargeIndicesAreRendered) {
    Scene scene = empty_scene(4);
    add_infinite(scene, Rgb(0.75));
    constexpr std::uint32_t last = 0x7FFFFFFF, count = 1000;
    const auto sums = device_test::render_sums(scene, last - count, last);
    for (const glm::dvec4& sum : sums)
        EXPECT_EQ(sum, glm::dvec4(glm::dvec3(0.75 * count), count));
    EXPECT_NE(device_test::render_sums(scene, last - count - 1, last)[0], sums[0]) << "no teeth";
}

/// An average of 2^26 samples into one pixel converges on, where plain sums in float32 have come to
/// stand long before.
TEST_F(Samples, OnePixelTakes2To26Samples) {
    Scene scene = empty_scene(1);
    add_infinite(scene, Rgb(0.1));
    const Estimate mean = mean_of(scene, 1u << 26);
    EXPECT_NEAR(mean.mean.g, 0.1, 1e-7);
}

class Flights : public DeviceTest {};

/// At an optical depth of 1e-8 the probability of a collision is 1e-8: 43 of the 2^32 words, those
/// next to the upper end, give shorter flights. As -log(1 - u) of 24 bits it would be 0 or 256.
TEST_F(Flights, CollideInNextToNothing) {
    selftest::Evaluator evaluator(device_test::context());
    std::vector<glm::vec4> words;
    for (std::uint32_t i = 0; i < 4096; ++i)
        words.emplace_back(0xFFFF, 0xFFFF - i, 0, 0);
    const auto flights = evaluator.evaluate(shared::FUNCTION_EXPONENTIAL, words);
    const auto shorter = [&](float depth) {
        return std::count_if(flights.begin(), flights.end(),
                             [&](const glm::vec4& f) { return f.x < depth; });
    };
    EXPECT_NEAR(static_cast<double>(shorter(1e-8F)), 1e-8 * 0x1p32, 1);
    EXPECT_NEAR(static_cast<double>(shorter(5e-7F)), 5e-7 * 0x1p32, 1);
}

/// In a medium so dense that no flight moves a path, it leaves where it came in, as soon as its
/// direction lets it. (Not by the reference: there a path that has crossed a boundary stands behind
/// it by a rounding, which is 1e15 mean free paths.)
TEST_F(Flights, OfNoLengthComeToAnEnd) {
    Scene scene = selftest::slab_scene({1, 1e30, 0}, selftest::Lit::both_sides);
    EXPECT_NEAR(mean_of(scene, 16).mean.g, 1, 2e-6);
    scene.media[0].sigma_a = scene.media[0].sigma_s; // the control
    EXPECT_LT(mean_of(scene, 16).mean.g, 0.9);
}

} // namespace
} // namespace tyndall::stability

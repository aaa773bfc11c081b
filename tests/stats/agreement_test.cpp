// The test must stay quiet when two renderers agree, however heavy the tails, and must speak up for
// a small bias, wherever it hides.
#include "core/error.h"
#include "stats/agreement.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace tyndall::stats {
namespace {

constexpr int width = 40, height = 24, batch_count = 16;

using Batches = std::vector<PixelSums>;
using Draw = std::function<double(std::mt19937_64&)>;

/// Batches of four samples a pixel around 1.
Batches noise(std::uint64_t seed, const Draw& draw) {
    std::mt19937_64 engine(seed);
    Batches batches(batch_count, PixelSums(width * height));
    for (PixelSums& batch : batches)
        for (glm::dvec4& pixel : batch)
            pixel = {4 + draw(engine), 4 + draw(engine), 4 + draw(engine), 4};
    return batches;
}

double normal(std::mt19937_64& engine) {
    return std::normal_distribution<>(0, 1)(engine);
}

/// Most paths agree to the last bit; a few went different ways and differ by a lot.
double rarely_large(std::mt19937_64& engine) {
    const bool differs = std::bernoulli_distribution(2e-3)(engine);
    return differs ? std::exponential_distribution<>(0.1)(engine) : 0;
}

Batches scaled(Batches batches, double factor, int x0, int x1) {
    for (PixelSums& batch : batches)
        for (int y = 0; y < height; ++y)
            for (int x = x0; x < x1; ++x)
                batch[static_cast<std::size_t>(y * width + x)].y *= factor;
    return batches;
}

TEST(Agreement, EqualBatchesHaveProbabilityOne) {
    const Batches a = noise(1, normal);
    const Agreement result = test_agreement(a, a, width);
    EXPECT_TRUE(result.agrees);
    EXPECT_EQ(result.p_value, 1);
    EXPECT_EQ(result.tests, 5 * 3 * 3);
    EXPECT_NEAR(result.mean_a[0], 1, 0.01);
}

/// Rejections at a rate of 5 %: as many as promised, with light and with heavy tails.
TEST(Agreement, KeepsItsFalseAlarmRate) {
    constexpr int runs = 300;
    for (const Draw& draw : {Draw(normal), Draw(rarely_large)}) {
        int rejected = 0;
        for (std::uint64_t run = 0; run < runs; ++run)
            rejected += !test_agreement(noise(2 * run, draw), noise(2 * run + 1, draw), width,
                                        {.false_alarm_rate = 0.05})
                             .agrees;
        const double expected = 0.05 * runs;
        EXPECT_LT(rejected, expected + 4.5 * std::sqrt(expected));
    }
}

TEST(Agreement, RejectsABiasOfTheWholeImage) {
    const Batches a = noise(1, normal), b = scaled(noise(2, normal), 1.03, 0, width);
    const Agreement result = test_agreement(a, b, width);
    EXPECT_FALSE(result.agrees);
    EXPECT_LT(result.p_means, 1e-6);
    EXPECT_LT(result.mean_t[1], 0);
}

TEST(Agreement, RejectsABiasOfOneBlockAndNamesIt) {
    const Batches a = noise(1, normal), b = scaled(noise(2, normal), 1.3, 16, 24);
    const Agreement result = test_agreement(a, b, width);
    EXPECT_FALSE(result.agrees);
    EXPECT_EQ(result.worst_x, 16);
    EXPECT_EQ(result.worst_channel, 1);
    EXPECT_LT(result.worst_t, 0);
}

TEST(Agreement, ToleratesRoundingButNothingMore) {
    const Batches a(batch_count, PixelSums(width * height, glm::dvec4(1, 2, 3, 4)));
    EXPECT_TRUE(test_agreement(a, scaled(a, 1 + 9e-6, 0, width), width).agrees);
    EXPECT_FALSE(test_agreement(a, scaled(a, 1 + 2e-5, 0, width), width).agrees);
}

TEST(Agreement, OneOutlierIsNoEvidence) {
    const Batches a(batch_count, PixelSums(width * height, glm::dvec4(1, 1, 1, 1)));
    Batches b = a;
    b[3][100].x += 1e6;
    EXPECT_TRUE(test_agreement(a, b, width).agrees);
}

TEST(Agreement, NotANumberIsADisagreement) {
    const Batches a(batch_count, PixelSums(width * height, glm::dvec4(1)));
    Batches b = a;
    b[0][0].z = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(test_agreement(a, b, width).agrees);
}

TEST(Agreement, SizesMustFit) {
    const Batches a = noise(1, normal);
    EXPECT_THROW(test_agreement(a, Batches(a.begin(), a.begin() + 3), width), Error);
    EXPECT_THROW(test_agreement(a, a, width + 1), Error);
    const Batches one(a.begin(), a.begin() + 1);
    EXPECT_THROW(test_agreement(one, one, width), Error);
}

} // namespace
} // namespace tyndall::stats

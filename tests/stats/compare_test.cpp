// Error measures by hand, and z-tests that must accept equal means and reject a small bias.
#include "core/error.h"
#include "stats/compare.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace tyndall::stats {
namespace {

const std::vector<std::string> with_variance = {"R",          "G",          "B",
                                                "variance.R", "variance.G", "variance.B"};

Image filled(const std::vector<float>& values) {
    Image image(2, 1, {"R", "G", "B"});
    image.pixels = values;
    return image;
}

/// Normal noise of a known variance around a mean.
Image noisy(std::uint64_t seed, double mean, double sigma) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<> normal(mean, sigma);
    Image image(64, 48, with_variance);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                image.at(x, y, c) = static_cast<float>(normal(engine));
                image.at(x, y, c + 3) = static_cast<float>(sigma * sigma);
            }
        }
    }
    return image;
}

TEST(Compare, MeasuresByHand) {
    const Comparison result = compare(filled({1, 2, 3, 1, 2, 5}), filled({1, 2, 3, 2, 2, 3}));
    EXPECT_NEAR(result.all.mse, 5.0 / 6, 1e-12);
    EXPECT_NEAR(result.all.rmse, std::sqrt(5.0 / 6), 1e-12);
    EXPECT_NEAR(result.all.relmse, (1 / 4.01 + 4 / 9.01) / 6, 1e-12);
    EXPECT_NEAR(result.channels[0].mse, 0.5, 1e-12);
    EXPECT_EQ(result.channels[1].mse, 0);
    EXPECT_NEAR(result.channels[0].mean_ratio, 2.0 / 3, 1e-12);
    EXPECT_NEAR(result.channels[2].mean_ratio, 8.0 / 6, 1e-12);
    EXPECT_FALSE(result.test.has_value());
    EXPECT_EQ(result.difference.pixels, (std::vector<float>{0, 0, 0, -1, 0, 2}));
}

TEST(Compare, BlackImagesHaveRatioOne) {
    const Image black = filled({0, 0, 0, 0, 0, 0});
    EXPECT_EQ(compare(black, black).all.mean_ratio, 1);
}

TEST(Compare, AcceptsEqualMeansAndRejectsABias) {
    const Image a = noisy(1, 1, 0.2);
    const auto same = compare(a, noisy(2, 1, 0.2)).test;
    ASSERT_TRUE(same.has_value());
    EXPECT_GT(same->p_means, 1e-3);
    EXPECT_GT(same->p_blocks, 1e-3);
    EXPECT_LT(same->blocks_beyond_3, 0.03);
    const auto biased = compare(a, noisy(2, 1.03, 0.2)).test;
    EXPECT_LT(biased->p_means, 1e-6);
    EXPECT_LT(biased->mean_z[0], 0);
}

TEST(Compare, OneImageMayBeExact) {
    Image exact(64, 48, {"R", "G", "B"});
    std::fill(exact.pixels.begin(), exact.pixels.end(), 1.0f);
    EXPECT_GT(compare(noisy(1, 1, 0.2), exact).test->p_means, 1e-3);
    EXPECT_LT(compare(noisy(1, 1.03, 0.2), exact).test->p_means, 1e-6);
}

TEST(Compare, FindsTheWorstBlock) {
    Image a = noisy(1, 1, 0.2);
    for (int y = 16; y < 24; ++y)
        for (int x = 40; x < 48; ++x)
            a.at(x, y, 2) += 0.5f;
    const auto test = compare(a, noisy(2, 1, 0.2)).test;
    EXPECT_LT(test->p_blocks, 1e-6);
    EXPECT_EQ(test->worst_x, 40);
    EXPECT_EQ(test->worst_y, 16);
    EXPECT_EQ(test->worst_channel, 2);
}

TEST(Compare, WithoutNoiseOnlyRoundingIsAllowed) {
    Image a = noisy(1, 1, 0), b = a;
    EXPECT_EQ(compare(a, b).test->p_blocks, 1);
    b.at(3, 3, 1) += 0.1f;
    EXPECT_EQ(compare(a, b).test->p_blocks, 0);
}

TEST(Compare, DifferentSizesAndMissingChannelsAreErrors) {
    EXPECT_THROW(compare(filled({1, 2, 3, 4, 5, 6}), noisy(1, 1, 1)), Error);
    EXPECT_THROW(compare(Image(2, 1, {"Y"}), Image(2, 1, {"Y"})), Error);
}

} // namespace
} // namespace tyndall::stats

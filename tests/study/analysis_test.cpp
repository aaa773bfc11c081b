// What follows from measurements, on made-up ones.
#include "study/analysis.h"
#include "study/cost.h"

#include <cmath>
#include <gtest/gtest.h>

namespace tyndall::study {
namespace {

/// Levels 1, 2, 4 ... 1024 of a technique whose noise is 1 / sqrt(samples).
TechniqueResult technique(const std::string& name, double bias, double seconds_per_sample,
                          bool is_unbiased) {
    TechniqueResult t{.name = name, .title = name, .family = "estimators"};
    t.is_unbiased = is_unbiased;
    t.seconds_per_sample = seconds_per_sample;
    for (std::uint32_t n = 1; n <= 1024; n *= 2) {
        const std::uint32_t slice = n == 1 ? 1 : n / 2;
        const double noise = 1.0 / n;
        t.levels.push_back({.samples = n,
                            .seconds = n * seconds_per_sample,
                            .clock_seconds = 2 * n * seconds_per_sample,
                            .error = {noise + bias * bias, 0.01 * noise},
                            .noise = {noise, 0.01 * noise},
                            .bias = {bias * bias, 0.01 * noise},
                            .slice_samples = slice,
                            .slice_noise = {1.0 / slice, 0.01 / slice}});
    }
    return t;
}

TEST(Analysis, PricesSamplesAndRenders) {
    TechniqueResult t;
    double sum = 0;
    for (std::uint32_t n = 1; n <= 64; n *= 2) {
        const std::uint32_t slice = n == 1 ? 1 : n / 2;
        sum += 0.05 + 0.01 * slice;
        t.levels.push_back({.samples = n, .seconds = sum, .slice_samples = slice});
    }
    t.equal_time = {.samples = 100, .seconds = 1.05};
    price(t);
    EXPECT_NEAR(t.seconds_per_render, 0.05, 1e-9);
    EXPECT_NEAR(t.seconds_per_sample, 0.01, 1e-9);
    for (const Level& level : t.levels)
        EXPECT_NEAR(level.seconds, 0.05 + 0.01 * level.samples, 1e-9);
}

TEST(Analysis, FitsTheSlopeOfNoise) {
    const auto fit = fit_noise(technique("a", 0, 0.1, true));
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->slope, -0.5, 1e-9);
    EXPECT_GT(fit->slope_sd, 0);
    EXPECT_LT(fit->slope_sd, 0.01);
    EXPECT_FALSE(fit_noise(TechniqueResult{}));
}

TEST(Analysis, PredictsTimes) {
    const TechniqueResult exact = technique("a", 0, 0.1, true);
    EXPECT_EQ(time_to(exact, 0.1).kind, TimeTo::Kind::measured);
    EXPECT_NEAR(time_to(exact, 0.1).seconds, 10, 1e-9); // 100 samples
    EXPECT_EQ(time_to(exact, 0.01).kind, TimeTo::Kind::extrapolated);
    EXPECT_NEAR(time_to(exact, 0.01).seconds, 1000, 1e-6);

    const TechniqueResult biased = technique("b", 0.08, 0.1, false);
    EXPECT_EQ(time_to(biased, 0.05).kind, TimeTo::Kind::never);
    EXPECT_NEAR(time_to(biased, 0.1).samples, std::ceil(1 / (0.01 - 0.0064)), 1);

    const TechniqueResult untold = technique("c", 0, 0.1, false);
    EXPECT_EQ(time_to(untold, 0.05).kind, TimeTo::Kind::measured);
    EXPECT_EQ(time_to(untold, 0.001).kind, TimeTo::Kind::unknown);
}

TEST(Analysis, ChoosesTheCheapest) {
    Results results;
    results.techniques = {technique(kBaseline, 0, 0.1, true), technique("fast", 0.02, 0.01, false),
                          technique("close", 0, 0.095, true)};
    results.techniques.push_back(technique("without-media", 0.001, 0.001, false));
    results.techniques.back().family = "without";
    const std::vector<Choice> choices = choose(results);
    EXPECT_EQ(choices[0].technique->name, "fast"); // 10 %
    EXPECT_EQ(choices[1].technique->name, "fast"); // 3 %
    EXPECT_EQ(choices[2].technique->name, kBaseline);
    EXPECT_NEAR(choices[0].baseline.seconds, 10, 1e-9);
}

TEST(Analysis, TestsUnbiasedTechniques) {
    Results results;
    results.techniques = {technique(kBaseline, 0, 0.1, true), technique("a", 0, 0.1, true),
                          technique("biased", 0.2, 0.1, false)};
    for (TechniqueResult& t : results.techniques)
        t.brightness = {0.001, 0.001};
    EXPECT_TRUE(test_unbiased(results).agrees);
    EXPECT_EQ(test_unbiased(results).techniques.size(), 2u);
    results.techniques[1].brightness = {0.01, 0.001};
    EXPECT_FALSE(test_unbiased(results).agrees);
    results.techniques[1] = technique("a", 0.05, 0.1, true);
    EXPECT_FALSE(test_unbiased(results).agrees);
}

} // namespace
} // namespace tyndall::study

// The line of progress, and what the limits of a render foresee.
#include "cli/limits.h"
#include "cli/progress_text.h"

#include <gtest/gtest.h>
#include <limits>

namespace tyndall::cli {
namespace {

TEST(ProgressText, TellsErrorPaceAndGoal) {
    ProgressFigures f{.samples = 312,
                      .error = stats::ErrorEstimate{0.0084, 0.0080, 0.0089},
                      .paths_per_second = 4.1e6,
                      .target_error = 0.005,
                      .target_seconds = 38,
                      .elapsed = 26,
                      .left = 38};
    EXPECT_EQ(progress_text(f), "312 spp  0.84 % error (0.80-0.89)  4.1 Mpaths/s  0.5 % in 38 s "
                                "[41%, 0:26, 0:38 left]");
    f.target_error.reset();
    f.target_seconds = 3;
    f.left = std::numeric_limits<double>::infinity();
    EXPECT_EQ(progress_text(f),
              "312 spp  0.84 % error (0.80-0.89)  4.1 Mpaths/s  half in 3.0 s [0:26]");
    f.error.reset();
    f.left = 7500;
    EXPECT_EQ(progress_text(f), "312 spp  4.1 Mpaths/s [0%, 0:26, 2:05:00 left]");
}

TEST(ProgressText, FitsOneLineOfHundredColumns) {
    const ProgressFigures f{.samples = 131072,
                            .error = stats::ErrorEstimate{0.00084, 0.00080, 0.00089},
                            .paths_per_second = 45e6,
                            .target_error = 0.0005,
                            .target_seconds = 7000,
                            .elapsed = 3600,
                            .left = 7000};
    EXPECT_LT(progress_text(f).size(), 100u);
}

TEST(ProgressText, PercentagesKeepTwoDigits) {
    EXPECT_EQ(format_percent(0), "0.00");
    EXPECT_EQ(format_percent(1.2345), "123");
    EXPECT_EQ(format_percent(0.12345), "12.3");
    EXPECT_EQ(format_percent(0.012345), "1.23");
    EXPECT_EQ(format_percent(0.0012345), "0.12");
    EXPECT_EQ(format_percent(0.00012345), "0.012");
    EXPECT_EQ(format_percent(1.2345e-6), "0.00012");
}

Progress look(std::uint32_t samples, std::uint32_t batches, double error) {
    return {.samples = samples,
            .error = stats::ErrorEstimate{error, error / 1.1, error * 1.1},
            .is_look = true,
            .batches = batches};
}

TEST(Limits, TheTargetIsMetAtALookByTheUpperEnd) {
    const Limits limits{.end_samples = 1000, .target_error = 0.1};
    EXPECT_TRUE(limits.meets_target(look(16, 8, 0.09)));
    EXPECT_FALSE(limits.meets_target(look(16, 8, 0.095))); // as like as not
    EXPECT_FALSE(limits.meets_target(look(12, 7, 0.01)));  // too early
    Progress between = look(16, 8, 0.09);
    between.is_look = false;
    EXPECT_FALSE(limits.meets_target(between));
    EXPECT_FALSE(Limits{.end_samples = 1000}.meets_target(look(16, 8, 1e-9)));
}

TEST(Limits, TheFirstOfThemIsForeseen) {
    const Pace pace{.seconds = 2, .samples = 20, .samples_per_second = 10};
    const Progress now = look(16, 8, 0.4); // upper end 0.44
    // (0.44 / 0.1)^2 * 16 = 309.8 samples: the look with 320.
    const Prediction target =
        foresee_end({.end_samples = 1000, .target_error = 0.1}, now, pace, 1).value();
    EXPECT_EQ(target.stopped_by, "target-error");
    EXPECT_EQ(target.samples, 320);
    EXPECT_DOUBLE_EQ(target.seconds, 32);
    EXPECT_NEAR(target.relative_rmse, 0.4 / std::sqrt(20.0), 1e-12);
    const Prediction spp =
        foresee_end({.end_samples = 100, .target_error = 0.1}, now, pace, 1).value();
    EXPECT_EQ(spp.stopped_by, "spp");
    EXPECT_DOUBLE_EQ(spp.seconds, 10);
    EXPECT_FALSE(foresee_end({.end_samples = 100}, now, {.samples = 20, .is_steady = false}, 1));
    // 15 seconds of the program, of which 1 was over before the rendering.
    const Prediction time =
        foresee_end({.end_samples = 1000, .time = 15, .target_error = 0.1}, now, pace, 1).value();
    EXPECT_EQ(time.stopped_by, "time");
    EXPECT_DOUBLE_EQ(time.seconds, 14);
    EXPECT_DOUBLE_EQ(time.samples, 140);
}

/// Looks at 192, 256, 320 and 384 samples are as far apart as is allowed, or too far.
TEST(Limits, WhatIsUncertainIsNotForeseen) {
    Progress now = look(16, 8, 0.4);
    const auto target_for = [&](double samples) { return 0.44 / std::sqrt(samples / 16); };
    EXPECT_EQ(samples_to_target(now, target_for(225)), 256);
    now.error->variation = 0.02;
    EXPECT_EQ(samples_to_target(now, target_for(225)), 256);
    EXPECT_EQ(samples_to_target(now, target_for(315)), 320);
    EXPECT_FALSE(samples_to_target(now, target_for(195))); // 192 or 256?
    now.error->variation = 0.13;
    EXPECT_EQ(samples_to_half(now), 64);
    now.error->variation = 0.14;
    EXPECT_FALSE(samples_to_half(now));
    EXPECT_FALSE(foresee_end({.end_samples = 100}, now, {.samples_per_second = 1}, 1));
    now.error->variation = 0;
    now.has_heavy_tail = true;
    EXPECT_FALSE(samples_to_half(now));
    now.has_heavy_tail = false;
    now.error->high = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(samples_to_target(now, 0.1));
}

} // namespace
} // namespace tyndall::cli

// Henyey-Greenstein against values computed with 50 digits, and the sampler against its density.
#include "reference/phase.h"
#include "reference/quadrature.h"
#include "stats/distributions.h"
#include "support/estimates.h"

#include <array>
#include <gtest/gtest.h>

namespace tyndall::reference {
namespace {

PhaseFunction hg(double g) {
    return {.kind = PhaseFunction::Kind::henyey_greenstein, .g = g};
}

struct Known {
    double g, xi, cosine, one_minus_cosine, sine;
};

TEST(HenyeyGreenstein, MatchesKnownValues) {
    const double last = 1 - 0x1p-24;
    for (const Known& k :
         {Known{0, 0.25, -0.5, 1.5, 0.8660254038}, Known{0, 0.5, 0, 1, 1},
          Known{1e-8, 0.5, 1.4999999999999999e-8, 0.999999985, 1},
          Known{1e-4, 0.75, 0.50011249250009376, 0.4998875075, 0.8659604465},
          Known{0.5, 0.25, 0.25, 0.75, 0.9682458366},
          Known{0.5, last, 0.99999998013178389, 1.986821611e-8, 0.0001993399905},
          Known{0.9, 1e-7, -0.99999278001949395, 1.99999278, 0.003799988011},
          Known{0.9, 0.75, 0.9960166468489893, 0.003983353151, 0.08916747837},
          Known{0.999, 0.5, 0.9999985005, 1.4995e-6, 0.001731761459},
          Known{-0.999, 0.25, -0.9999996110185, 1.999999611, 0.0008820220228},
          Known{0.99999, 0.75, 0.99999999996111102, 3.888898148e-11, 8.819181536e-6},
          Known{0.99999, last, 1, 5.960494813e-18, 3.452678616e-9}}) {
        const ScatteringAngle angle = sample_angle(hg(k.g), k.xi);
        EXPECT_NEAR(angle.cosine, k.cosine, 1e-15) << k.g << ' ' << k.xi;
        // 1 - g is itself only known to 2^-53, so its relative error limits the others.
        const double relative = 1e-9 + 1e-15 / (1 - std::abs(k.g));
        EXPECT_NEAR(angle.one_minus_cosine, k.one_minus_cosine, relative * k.one_minus_cosine);
        EXPECT_NEAR(angle.sine, k.sine, relative * k.sine);
    }
}

TEST(HenyeyGreenstein, EndsAreExact) {
    for (double g : {-0.999, -0.5, 0.0, 1e-8, 0.5, 0.99999}) {
        EXPECT_EQ(sample_angle(hg(g), 0).cosine, -1);
        EXPECT_EQ(sample_angle(hg(g), 0).sine, 0);
        EXPECT_EQ(sample_angle(hg(g), 1).cosine, 1);
        EXPECT_EQ(sample_angle(hg(g), 1).sine, 0);
    }
    EXPECT_EQ(sample_angle(hg(1), 0.3).cosine, 1);
    EXPECT_EQ(sample_angle(hg(-1), 0.3).cosine, -1);
}

TEST(HenyeyGreenstein, PeaksMatchTheirClosedForms) {
    EXPECT_NEAR(4 * pi * evaluate_phase(hg(0.5), 0), 6, 1e-13);
    EXPECT_NEAR(4 * pi * evaluate_phase(hg(0.9), 0), 190, 1e-10);
    EXPECT_NEAR(4 * pi * evaluate_phase(hg(0.99), 0), 19900, 1e-6);
    EXPECT_NEAR(4 * pi * evaluate_phase(hg(0.9), 2), 0.0277008, 1e-7);
    EXPECT_NEAR(4 * pi * evaluate_phase(hg(-0.5), 2), 6, 1e-13);
    EXPECT_NEAR(4 * pi * evaluate_phase(hg(0), 1.3), 1, 1e-15);
}

TEST(HenyeyGreenstein, IntegratesToOneWithMeanCosineG) {
    for (double g : {-0.99, -0.5, 0.0, 0.3, 0.9, 0.99}) {
        const auto density = [&](double om) { return 2 * pi * evaluate_phase(hg(g), om); };
        EXPECT_NEAR(integrate(density, 0, 2), 1, 1e-10);
        const auto one_plus_cosine = [&](double om) { return density(om) * (2 - om); };
        EXPECT_NEAR(integrate(one_plus_cosine, 0, 2), 1 + g, 1e-10);
    }
}

/// Directions, not only angles, from words: around a tilted axis, binned in the cosine.
TEST(HenyeyGreenstein, DirectionsFollowTheDensity) {
    constexpr int n = 1 << 20, bins = 64;
    const dvec3 travel = glm::normalize(dvec3(0.3, -0.5, -0.8));
    for (double g : {-0.6, 0.0, 0.85}) {
        std::array<double, bins> counts{};
        double sum = 0, sum_of_squares = 0;
        dvec3 sideways(0);
        for (std::uint32_t i = 0; i < n; ++i) {
            const glm::uvec4 words = RandomPath{{7, 0}, i, 0}.words(1, shared::BLOCK_PATH);
            const ScatteringAngle angle = sample_angle(hg(g), unit(words.y));
            const dvec3 d = direction_around(travel, angle.sine, angle.cosine, unit(words.z));
            const double cosine = glm::dot(d, travel);
            EXPECT_NEAR(cosine, angle.cosine, 1e-14);
            // Equal probability bins: the CDF of the cosine is the sampled number.
            const double quantile = integrate16(
                [&](double om) { return 2 * pi * evaluate_phase(hg(g), om); }, 1 - cosine, 2);
            if (std::abs(g) < 0.7)
                ++counts[static_cast<std::size_t>(std::min(bins - 1.0, quantile * bins))];
            sum += cosine;
            sum_of_squares += cosine * cosine;
            sideways += d - cosine * travel;
        }
        const double mean = sum / n;
        const double error = std::sqrt((sum_of_squares / n - mean * mean) / n);
        EXPECT_LT(std::abs(mean - g), support::pass * error);
        EXPECT_GT(std::abs(mean - (g + 0.02)), support::reject * error);
        EXPECT_LT(glm::length(sideways) / n, support::pass * std::sqrt(1.0 / n));
        if (std::abs(g) >= 0.7) continue; // One rule of 16 points is exact enough below.
        double chi_squared = 0;
        for (double count : counts) {
            const double expected = static_cast<double>(n) / bins;
            chi_squared += (count - expected) * (count - expected) / expected;
        }
        EXPECT_GT(stats::chi_squared_tail(chi_squared, bins - 1), 1e-4);
    }
}

} // namespace
} // namespace tyndall::reference

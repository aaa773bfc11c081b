// Free flights and the spectral weights of segments.
#include "reference/medium.h"
#include "reference/quadrature.h"
#include "support/estimates.h"

#include <gtest/gtest.h>

namespace tyndall::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Medium medium_of(const Rgb& sigma_a, const Rgb& sigma_s, const Rgb& emission = Rgb(0)) {
    Medium medium;
    medium.sigma_a = sigma_a;
    medium.sigma_s = sigma_s;
    medium.emission = emission;
    return medium;
}

TEST(FreeFlight, IsFiniteMonotoneAndExactInTheTail) {
    double before = infinity;
    for (std::uint32_t word : {0u, 1u, 482u, 483u, 0x80000000u, 0xffffff7fu, 0xffffffffu}) {
        const double tau = flight_optical_depth(word);
        EXPECT_GT(tau, 0);
        EXPECT_LT(tau, 22.88);
        EXPECT_LT(tau, before);
        before = tau;
    }
    EXPECT_GT(flight_optical_depth(482), 16);
    EXPECT_LT(flight_optical_depth(483), 16);
    EXPECT_NEAR(flight_optical_depth(0xffffffffu), 0x1p-33, 1e-20);
}

TEST(FreeFlight, IsInfiniteWithoutScatteringAndHasNoNan) {
    EXPECT_EQ(flight_distance(medium_of(Rgb(1), Rgb(0)), 0, 5), infinity);
    EXPECT_GT(flight_distance(medium_of(Rgb(0), Rgb(1e-30)), 0, 0xffffffffu), 1e19);
    EXPECT_GT(flight_distance(medium_of(Rgb(0), Rgb(1e30)), 0, 0xffffffffu), 0);
}

TEST(Segments, GreyMediaOnlyLoseWhatIsAbsorbed) {
    const Medium medium = medium_of(Rgb(0.3), Rgb(7));
    for (const Segment& segment : {Segment{2, true}, Segment{0.5, false}}) {
        const Throughput after = after_segment(medium, {}, segment);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(after.beta[c], std::exp(-0.3 * segment.length), 1e-15);
            EXPECT_NEAR(after.ratio[c], 1, 1e-15);
        }
    }
}

TEST(Segments, InfiniteOnesAreDecidedChannelByChannel) {
    const Medium medium = medium_of({0, 2, 0}, {0, 0, 3});
    const Throughput after = after_segment(medium, {}, {infinity, false});
    EXPECT_NEAR(after.beta.x, 1.5, 1e-15); // Two of three heroes get there.
    EXPECT_EQ(after.beta.y, 0);
    EXPECT_EQ(after.beta.z, 0);
    EXPECT_EQ(transmittance(medium, infinity), Rgb(1, 0, 0));
}

/// Averaged over heroes and flights, each estimate must give its integral; no weight exceeds three.
struct Averages {
    Rgb escaped{0}, collided{0}, emitted{0};
    double largest_weight = 0;
};

Averages average_segments(const Medium& medium, const Throughput& before, double surface, int n) {
    Averages sums;
    for (int hero = 0; hero < 3; ++hero) {
        for (int i = 0; i < n; ++i) {
            const auto word = static_cast<std::uint32_t>((i + 0.5) / n * 0x1p32);
            Throughput throughput = before;
            throughput.hero = hero;
            const double flight = flight_distance(medium, hero, word);
            const Segment segment{std::min(flight, surface), flight < surface};
            const double probability = before.ratio[hero] / (3.0 * n);
            const Throughput after = after_segment(medium, throughput, segment);
            (segment.collision ? sums.collided : sums.escaped) += probability * after.beta;
            sums.emitted += probability * emitted_radiance(medium, throughput, segment);
            for (int c = 0; c < 3; ++c)
                sums.largest_weight = std::max(sums.largest_weight, after.beta[c]);
        }
    }
    return sums;
}

TEST(Segments, ChromaticWeightsAverageToTheIntegrals) {
    const Rgb sigma_s(0.1, 1, 10);
    const Rgb sigma_a(0.5, 0.2, 0.05);
    const Medium medium = medium_of(sigma_a, sigma_s, {1, 2, 3});
    for (const Throughput& before : {Throughput{}, Throughput{{0.5, 2, 1}, {0.3, 2.4, 0.3}, 0}}) {
        const Averages averages = average_segments(medium, before, 1.5, 5000);
        for (int c = 0; c < 3; ++c) {
            const double sigma_t = sigma_a[c] + sigma_s[c];
            const double reaches = std::exp(-1.5 * sigma_t);
            const double collides = sigma_s[c] / sigma_t * (1 - reaches);
            const double emits = sigma_a[c] / sigma_t * (1 - reaches) * medium.emission[c];
            EXPECT_NEAR(averages.escaped[c], before.beta[c] * reaches, 2e-4);
            EXPECT_NEAR(averages.collided[c], before.beta[c] * collides, 2e-4);
            EXPECT_NEAR(averages.emitted[c], before.beta[c] * emits, 2e-4);
            // Control: 2 % more emission would be seen.
            EXPECT_GT(std::abs(averages.emitted[c] - 1.02 * before.beta[c] * emits), 2e-4);
        }
    }
}

/// Known answers for sigma (0.1, 1, 10) and distance 1: T_i / mean(T).
TEST(Segments, ChromaticWeightsStayBelowThree) {
    const Medium medium = medium_of(Rgb(0), {0.1, 1, 10});
    const Throughput after = after_segment(medium, {}, {1, false});
    EXPECT_NEAR(after.beta.x, 2.132772428, 1e-9);
    EXPECT_NEAR(after.beta.y, 0.8671205605, 1e-9);
    EXPECT_NEAR(after.beta.z, 1.070111785e-4, 1e-12);
    EXPECT_LE(average_segments(medium, {}, 1, 5000).largest_weight, 3 * (1 + 1e-12));
}

TEST(Segments, ExtremeCoefficientsStayFinite) {
    for (const Rgb& sigma_s : {Rgb(1e30, 1, 1e-30), Rgb(0, 0, 1e30), Rgb(1e-30)}) {
        const Medium medium = medium_of({1e-20, 1e20, 1}, sigma_s, Rgb(1));
        for (int hero = 0; hero < 3; ++hero) {
            for (std::uint32_t word : {0u, 0xffffffffu}) {
                const Throughput before{Rgb(1), Rgb(1), hero};
                const double flight = flight_distance(medium, hero, word);
                const Segment segment{std::min(flight, 1e6), flight < 1e6};
                const Throughput after = after_segment(medium, before, segment);
                const Rgb emitted = emitted_radiance(medium, before, segment);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_TRUE(std::isfinite(after.beta[c]) && after.beta[c] >= 0);
                    EXPECT_TRUE(std::isfinite(emitted[c]) && emitted[c] >= 0);
                }
            }
        }
    }
}

TEST(Quadrature, IsExactForPolynomialsAndConvergesOtherwise) {
    EXPECT_NEAR(integrate16([](double x) { return std::pow(x, 31) + 1; }, 0, 2),
                std::pow(2.0, 32) / 32 + 2, 1e-6);
    EXPECT_NEAR(integrate([](double x) { return std::sqrt(x); }, 0, 1), 2.0 / 3, 1e-9);
}

} // namespace
} // namespace tyndall::reference

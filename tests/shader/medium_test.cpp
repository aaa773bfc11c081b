/// Segments through a medium: weights, emission and transmittance. Flights are those of equal
/// strata of random words, so that the mean over them is a quadrature and not a guess.

#include "shader/rays.h"
#include "spirv/medium.h"

#include <algorithm>
#include <cmath>

namespace tyndall::shader_test {
namespace {

using glm::dvec3;
using glm::vec3;
using glm::vec4;

constexpr std::uint32_t kStrata = 1u << 16;     ///< Of the word of one segment.
constexpr std::uint32_t kStrataOfTwo = 1u << 9; ///< Of the words of two segments, each.

struct Coefficients {
    vec3 sigma_a, sigma_s, emission;
    dvec3 sigma_t() const { return dvec3(sigma_a) + dvec3(sigma_s); }
};

struct Segment {
    vec3 throughput;
    float collided;
    vec3 emission;
    float s;
};

/// Means over all words, and over all three heroes where the channels differ.
struct Means {
    dvec3 collided{0}, escaped{0}, emission{0};
    double least = INFINITY, most = 0; ///< Weights of single segments.
};

class Medium : public GpuTest {
  protected:
    Means integrate(const Coefficients& c, double end, std::uint32_t function = 0,
                    std::uint32_t variant = 0, bool chromatic = true) {
        shared::Features features;
        features.is_chromatic = chromatic;
        features.has_emission = c.emission != vec3(0);
        const std::uint32_t count = function == 0 ? kStrata : kStrataOfTwo * kStrataOfTwo;
        Kernel kernel("medium", medium_spirv, 4, 2 * count, features);
        const shared::MediumRecord record{
            .sigma_a = c.sigma_a, .sigma_s = c.sigma_s, .emission = c.emission};
        Means means;
        const std::uint32_t heroes = chromatic ? 3 : 1;
        for (std::uint32_t hero = 0; hero < heroes; ++hero) {
            kernel.push.shapes = hero;
            kernel.push.nodes = function == 0 ? (1u << 16) : kStrataOfTwo; // a stride, or strata
            const Task task{
                .function = function, .variant = variant, .number = static_cast<float>(end)};
            for (const Segment& s : kernel.run<Segment>(task, std::vector{record}, count)) {
                for (int k = 0; k < 3; ++k) { // not a number must not hide in a maximum
                    means.most =
                        s.throughput[k] <= means.most ? means.most : double{s.throughput[k]};
                    means.least =
                        s.throughput[k] >= means.least ? means.least : double{s.throughput[k]};
                }
                (s.collided > 0 ? means.collided : means.escaped) += dvec3(s.throughput);
                means.emission += dvec3(s.emission);
            }
        }
        const double n = static_cast<double>(count) * heroes;
        return {means.collided / n, means.escaped / n, means.emission / n, means.least, means.most};
    }
};

/// Relative error of the mean weights, the greatest of all channels.
double worst(const dvec3& found, const dvec3& exact) {
    double most = 0;
    for (int k = 0; k < 3; ++k) {
        const double off = exact[k] == 0 ? std::abs(found[k]) : std::abs(found[k] / exact[k] - 1);
        most = off <= most ? most : off;
    }
    return most;
}

dvec3 exp3(dvec3 v) {
    return {std::exp(v.x), std::exp(v.y), std::exp(v.z)};
}

/// sigma / sigma_t (1 - exp(-sigma_t end)): the chance to collide, per channel.
dvec3 share(const Coefficients& c, dvec3 sigma, double end) {
    dvec3 result(0);
    for (int k = 0; k < 3; ++k)
        if (sigma[k] > 0)
            result[k] = sigma[k] / c.sigma_t()[k] * -std::expm1(-c.sigma_t()[k] * end);
    return result;
}

const Coefficients kGrey{vec3(0.3f), vec3(1.5f), vec3(2)};
const Coefficients kChromatic{{0.2f, 0.05f, 0.4f}, {0.5f, 1, 2}, {1, 2, 3}};
const Coefficients kContrast{{0.02f, 0.05f, 0}, {0.1f, 1, 10}, {1, 2, 3}}; // ORACLES T14

Coefficients dark(Coefficients c) {
    c.emission = vec3(0);
    return c;
}

} // namespace

/// A stratum is worth its share of a weight, and weights are at most 3.
constexpr double kQuadrature = 4.0 / kStrata;

TEST_F(Medium, GreySegmentsAreUnbiased) {
    const double end = 1.2;
    const Means m = integrate(kGrey, end, 0, 0, false);
    const dvec3 escaped = exp3(-kGrey.sigma_t() * end);
    EXPECT_LT(worst(m.escaped, escaped), kQuadrature);
    EXPECT_LT(worst(m.collided, share(kGrey, kGrey.sigma_s, end)), kQuadrature);
    EXPECT_LT(worst(m.emission, share(kGrey, kGrey.sigma_a, end) * 2.0), kQuadrature);
    EXPECT_LE(m.most, 1);
    EXPECT_GT(worst(m.escaped, exp3(-1.02 * kGrey.sigma_t() * end)), 1e-3) << "no teeth";
}

TEST_F(Medium, ChromaticSegmentsAreUnbiased) {
    for (const Coefficients& c : {dark(kChromatic), dark(kContrast)})
        for (const double end : {0.1, 1.0, 4.0}) {
            const Means m = integrate(c, end);
            const dvec3 escaped = exp3(-c.sigma_t() * end);
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(m.escaped[k], escaped[k], kQuadrature + 2e-6 * escaped[k])
                    << k << ' ' << end;
            EXPECT_LT(worst(m.collided, share(c, c.sigma_s, end)), 1e-4) << end;
            EXPECT_GT(worst(m.collided, share(c, 1.02f * c.sigma_s, end)), 1e-3) << "no teeth";
        }
}

/// Of a medium that does not absorb, so that a path of 10^5 segments loses nothing.
TEST_F(Medium, WithoutAbsorptionWeightsAreExactlyOne) {
    const Coefficients scattering{vec3(0), vec3(1.5f), vec3(0)};
    for (const bool chromatic : {false, true}) {
        const Means m = integrate(scattering, 1.2, 0, 0, chromatic);
        EXPECT_EQ(m.least, 1);
        EXPECT_EQ(m.most, 1);
    }
    EXPECT_LT(integrate({vec3(1e-6f), vec3(1.5f), vec3(0)}, 1.2, 0, 0, false).least, 1)
        << "no teeth";
}

/// One-sample spectral MIS: no weight is above 3, where the hero alone would give up to 20000.
TEST_F(Medium, WeightsAreBounded) {
    const Means m = integrate(dark(kContrast), 1);
    EXPECT_LE(m.most, 3 * (1 + 1e-5));
    EXPECT_GT(m.most, 2);
    EXPECT_GT(integrate(dark(kContrast), 1, 0, 1).most, 1e4) << "no teeth";
    EXPECT_LE(integrate(dark(kContrast), 1, 1).most, 3 * (1 + 1e-5)); // second segment
}

/// The ratios r carry over to the next segment: a collision in an endless medium, then a segment.
TEST_F(Medium, SecondSegmentsAreUnbiased) {
    const double end = 1.5;
    for (const Coefficients& c : {kChromatic, kContrast}) {
        const Means m = integrate(c, end, 1);
        const dvec3 albedo = dvec3(c.sigma_s) / c.sigma_t();
        const double bound = 4.0 / kStrataOfTwo; // strata an axis
        EXPECT_LT(worst(m.collided, albedo * share(c, c.sigma_s, end)), bound);
        EXPECT_LT(worst(m.emission, albedo * share(c, c.sigma_a, end) * dvec3(c.emission)), bound);
        EXPECT_GT(worst(m.collided, albedo * albedo * share(c, c.sigma_s, end)), 1e-2)
            << "no teeth";
    }
}

/// What the medium adds along all flights is sigma_a Le (1 - exp(-sigma_t end)) / sigma_t.
TEST_F(Medium, EmissionIsUnbiased) {
    for (const Coefficients& c : {kChromatic, kContrast})
        for (const double end : {0.1, 1.0, 10.0, 1000.0}) {
            const Means m = integrate(c, end);
            const dvec3 exact = share(c, c.sigma_a, end) * dvec3(c.emission);
            EXPECT_LT(worst(m.emission, exact), 1e-4) << end;
            EXPECT_GT(worst(m.emission, 1.02 * exact), 1e-2) << "no teeth";
        }
}

/// A channel that does not scatter (ORACLES T44), and one that is clear, to infinity.
TEST_F(Medium, ClearChannelsGiveNumbers) {
    const Coefficients c{{0, 0.5f, 0.1f}, {0, 1, 2}, {1, 1, 1}};
    const Means m = integrate(c, INFINITY);
    EXPECT_NEAR(m.escaped.x, 1, kQuadrature);
    EXPECT_EQ(m.escaped.y, 0);
    EXPECT_EQ(m.escaped.z, 0);
    EXPECT_EQ(m.collided.x, 0);
    EXPECT_NEAR(m.collided.y, 1 / 1.5, kQuadrature);
    EXPECT_NEAR(m.collided.z, 2 / 2.1, kQuadrature);
    EXPECT_EQ(m.emission.x, 0);
    EXPECT_NEAR(m.emission.y, 0.5 / 1.5, 1e-4);
    EXPECT_NEAR(m.emission.z, 0.1 / 2.1, 1e-4);
    EXPECT_LE(m.most, 3 * (1 + 1e-5));
}

TEST_F(Medium, TransmittanceIsBeerLambert) {
    Kernel kernel("medium", medium_spirv, 4, 4);
    const auto transmittance = [&](const Coefficients& c, double s) {
        const shared::MediumRecord record{.sigma_a = c.sigma_a, .sigma_s = c.sigma_s};
        return dvec3(kernel
                         .run<Segment>({.function = 2, .number = static_cast<float>(s)},
                                       std::vector{record}, 1)[0]
                         .throughput);
    };
    for (const double s : {0.0, 1e-6, 0.1, 1.0, 8.0}) {
        const dvec3 depth = kContrast.sigma_t() * s;
        const dvec3 found = transmittance(kContrast, s);
        for (int k = 0; k < 3; ++k) // ORACLES 6.0: (3 + 2 tau) of exp, tau of its argument
            EXPECT_NEAR(found[k] / std::exp(-depth[k]), 1,
                        (3 + 2 * depth[k]) * 1.2e-7 + depth[k] * 1.2e-7)
                << s;
    }
    // ORACLES T5 and T6: next to nothing, and next to everything.
    for (const float sigma : {1e-45f, 1e-40f, 1e-30f})
        EXPECT_NEAR(transmittance({vec3(0), vec3(sigma), vec3(0)}, 1e6).x, 1, kEpsilon) << sigma;
    EXPECT_EQ(transmittance({vec3(0), vec3(0), vec3(0)}, INFINITY), dvec3(1));
    EXPECT_NEAR(transmittance({vec3(1e-11f), vec3(0), vec3(0)}, 1e6).x, 0.99999, 1e-7);
    EXPECT_EQ(transmittance({vec3(1e30f), vec3(0), vec3(0)}, 1), dvec3(0));
    EXPECT_EQ(transmittance({{0, 1, 2}, vec3(0), vec3(0)}, INFINITY), dvec3(1, 0, 0));
}

} // namespace tyndall::shader_test

/// Henyey-Greenstein scattering: inversion, value, normalisation, direction.

#include "shader/kernel.h"
#include "spirv/phase.h"
#include "stats/distributions.h"
#include "support/estimates.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace tyndall::shader_test {
namespace {

using glm::vec4;
using std::numbers::pi;

constexpr std::uint32_t kMost = 1u << 21;

/// 1 - cos and 1 + cos of a deflection: the identities of ORACLES 5.1, where nothing cancels that
/// double precision does not bear.
struct Deflection {
    double minus, plus;
    double cosine() const { return minus < plus ? 1 - minus : plus - 1; }
    double sine() const { return std::sqrt(minus * plus); }
};

Deflection invert(double g, double xi) {
    const double d = 1 - g + 2 * g * xi;
    const double a = (1 - g) / d, b = (1 + g) / d;
    return {2 * (1 - xi) * a * a * (1 + g * xi), 2 * xi * b * b * (1 - g * (1 - xi))};
}

/// The density by the complement of its cosine.
double density(double g, double minus) {
    const double d = (1 - g) * (1 - g) + 2 * g * minus;
    return (1 - g) * (1 + g) / (4 * pi * d * std::sqrt(d));
}

/// P(cos < mu), from the density's integral.
double cumulative(double g, double mu) {
    if (g == 0) return (1 + mu) / 2;
    return (1 - g * g) / (2 * g) * (1 / std::sqrt(1 + g * g - 2 * g * mu) - 1 / (1 + g));
}

struct WorstErrors {
    double cosine = 0;
    double sine = 0; ///< Relative.
};

/// A scene with nothing else than Henyey and Greenstein's function.
shared::Features hg_only() {
    shared::Features features;
    features.phases = shared::PHASE_BIT_HENYEY_GREENSTEIN;
    features.has_mixtures = features.has_chromatic_phases = 0;
    return features;
}

class Phase : public GpuTest {
  protected:
    /// Over all 2^24 numbers that can be drawn.
    WorstErrors exhaust(float g, std::uint32_t variant) {
        WorstErrors worst;
        const double exact_g = g;
        for (std::uint32_t first = 0; first < 1u << 24; first += kMost) {
            const auto found =
                kernel_.run<vec4>({.variant = variant, .first = first, .number = g}, kMost);
            for (std::uint32_t i = 0; i < kMost; ++i) {
                const Deflection exact = invert(exact_g, (first + i) * 0x1p-24);
                const double sine = exact.sine();
                worst.cosine = std::max(worst.cosine, std::abs(found[i].z - exact.cosine()));
                worst.sine = std::max(worst.sine, sine > 0 ? std::abs(found[i].w / sine - 1)
                                                           : std::abs(double{found[i].w}));
            }
        }
        return worst;
    }
    /// xyz directions after scattering from `from`, w their densities by evaluate_phase.
    std::vector<vec4> scatter(float g, glm::vec3 from, std::uint32_t count,
                              const shared::Features& features = hg_only()) {
        Kernel kernel("phase", phase_spirv, 1, count, features);
        kernel.push.seed = {11, 0};
        return kernel.run<vec4>({.function = 2, .number = g}, std::vector{vec4(from, 0)}, count);
    }
    Kernel kernel_{"phase", phase_spirv, 1u << 17, kMost, hg_only()};
};

struct Reference {
    double g, xi, cosine, minus, sine;
};

/// ORACLES 5.1, computed with 50 digits.
constexpr double e24 = 1 - 0x1p-24;
constexpr Reference kReferences[] = {
    {0, 1e-7, -0.9999998, 1.9999998, 0.0006324555004},
    {0, 0.25, -0.5, 1.5, 0.8660254038},
    {0, e24, 0.99999988079071045, 1.192092896e-7, 0.0004882812354},
    {1e-8, 0.25, -0.49999998874999992, 1.499999989, 0.8660254103},
    {1e-8, 0.5, 1.4999999999999999e-8, 0.999999985, 1.0},
    {1e-4, 1e-7, -0.99999979993999201, 1.9999998, 0.0006325503743},
    {1e-4, 0.5, 0.0001499999995, 0.99985, 0.9999999887},
    {1e-4, e24, 0.99999988082646847, 1.191735315e-7, 0.0004882079975},
    {1e-3, 0.75, 0.50112425009384363, 0.4988757499, 0.865375344},
    {0.5, 1e-7, -0.99999910000027000, 1.9999991, 0.001341640283},
    {0.5, 0.25, 0.25, 0.75, 0.9682458366},
    {0.5, 0.5, 0.6875, 0.3125, 0.7261843774},
    {0.5, e24, 0.99999998013178389, 1.986821611e-8, 0.0001993399905},
    {0.9, 1e-7, -0.99999278001949395, 1.99999278, 0.003799988011},
    {0.9, 0.75, 0.99601664684898930, 0.003983353151, 0.08916747837},
    {0.9, e24, 0.99999999937258263, 6.274173666e-10, 3.542364652e-5},
    {0.99, 0.25, 0.99926624840701892, 0.000733751593, 0.03830097642},
    {0.99, e24, 0.99999999999400958, 5.990417093e-12, 3.461334163e-6},
    {0.999, 1e-7, -0.99920103925650766, 1.999201039, 0.03996602493},
    {0.999, 0.25, 0.99999251647453446, 7.483525466e-6, 0.003868720063},
    {0.999, e24, 0.99999999999994037, 5.963446734e-14, 3.453533476e-7},
    {-0.999, 1e-7, -0.99999999999989995, 2.0, 4.473254744e-7},
    {-0.999, 0.5, -0.9999985005, 1.9999985, 0.001731761459},
    {-0.999, e24, 0.99952372464094048, 0.0004762753591, 0.0308597453},
    {0.99999, 1e-7, -0.92233831633211858, 1.922338316, 0.3863832686},
    {0.99999, 0.5, 0.99999999985000050, 1.499995e-10, 1.732047921e-5}};

/// p-value of the directions' polar and azimuthal angles about `from`, 64 x 16 cells of equal
/// chance.
double chi_squared_p(const std::vector<vec4>& directions, glm::dvec3 from, double g) {
    constexpr int polar = 64, azimuths = 16;
    std::vector<double> counts(polar * azimuths);
    const glm::dvec3 s = glm::normalize(glm::cross(from, glm::dvec3(0.3, -0.8, 0.5)));
    const glm::dvec3 t = glm::cross(from, s);
    for (const vec4& d : directions) {
        const glm::dvec3 to(d);
        const double c = cumulative(g, std::clamp(glm::dot(from, to), -1.0, 1.0));
        const double turn = std::atan2(glm::dot(to, t), glm::dot(to, s)) / (2 * pi) + 0.5;
        const int i = std::clamp(static_cast<int>(c * polar), 0, polar - 1);
        const int k = std::clamp(static_cast<int>(turn * azimuths), 0, azimuths - 1);
        ++counts[i * azimuths + k];
    }
    const double expected = static_cast<double>(directions.size()) / (polar * azimuths);
    double sum = 0;
    for (double n : counts)
        sum += (n - expected) * (n - expected) / expected;
    return stats::chi_squared_tail(sum, polar * azimuths - 1);
}

} // namespace

TEST_F(Phase, TheOracleOfTheseTestsGivesThePublishedDigits) {
    for (const Reference& r : kReferences) {
        const Deflection d = invert(r.g, r.xi);
        EXPECT_NEAR(d.cosine(), r.cosine, 1e-12) << r.g << ' ' << r.xi;
        EXPECT_NEAR(d.minus / r.minus, 1, 1e-9) << r.g << ' ' << r.xi;
        EXPECT_NEAR(d.sine() / r.sine, 1, 1e-9) << r.g << ' ' << r.xi;
    }
}

/// ORACLES T42 with every number that can be drawn: 1e-6 in the cosine, 2e-6 of the sine.
TEST_F(Phase, InversionIsExactForEveryDraw) {
    for (const float g : {0.0f, 1e-8f, 1e-4f, 1e-2f, 0.5f, 0.9f, 0.99f, 0.999f, -0.5f, -0.999f}) {
        const WorstErrors worst = exhaust(g, 0);
        EXPECT_LT(worst.cosine, 1e-6) << "g = " << g;
        EXPECT_LT(worst.sine, 2e-6) << "g = " << g;
    }
    EXPECT_GT(exhaust(1e-4f, 1).cosine, 1e-4) << "no teeth";
    EXPECT_GT(exhaust(0.999f, 1).sine, 0.5) << "no teeth";
}

/// Up to what a division may be off by: 2.5 units in the last place (Vulkan, "Precision and
/// Operation of SPIR-V Instructions"). Nothing is beyond its end.
TEST_F(Phase, EndsAreExactToADivision) {
    const float most_complement_error = 3 * 0x1p-23f;
    for (const float g : {0.0f, 1e-8f, 0.5f, 0.99f, -0.5f, -0.999f}) {
        const vec4 least = kernel_.run<vec4>({.first = 0, .number = g}, 1)[0];
        const vec4 most = kernel_.run<vec4>({.first = 1u << 24, .number = g}, 1)[0];
        for (const float complement : {least.x, most.y}) {
            EXPECT_LE(complement, 2) << g;
            EXPECT_GE(complement, 2 - most_complement_error) << g;
        }
        EXPECT_EQ(vec4(2, least.y, least.z, least.w), vec4(2, 0, -1, 0)) << g;
        EXPECT_EQ(vec4(most.x, 2, most.z, most.w), vec4(0, 2, 1, 0)) << g;
    }
}

/// ORACLES 5.1: from |g| = 1 - 1e-6 on, light goes straight on or straight back.
TEST_F(Phase, NextToOneThereIsNoDeflection) {
    const glm::vec3 from = glm::normalize(glm::vec3(-0.3, 0.5, -0.8));
    for (const float g : {1.0f, 1 - 0x1p-24f, -1.0f})
        for (const vec4& f : scatter(g, from, 1024))
            ASSERT_EQ(f, vec4(g > 0 ? from : -from, 0)) << g;
    EXPECT_NE(scatter(0.99999f, from, 1)[0], vec4(from, 0)) << "no teeth";
}

/// Pairs of directions at angles from 1e-6 to pi, with the angle of the rounded vectors.
TEST_F(Phase, ValuesHoldUpNearTheForwardDirection) {
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    std::vector<vec4> pairs;
    const int count = 1 << 16;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 from =
            glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        const glm::dvec3 across = glm::normalize(
            glm::cross(from, glm::dvec3(normal(random), normal(random), normal(random))));
        const double angle = i % 2 ? pi * i / count : std::pow(10, -6 + 6.0 * i / count);
        const double turned = i % 4 < 2 ? angle : pi - angle; // forwards or backwards
        pairs.emplace_back(from, 0);
        pairs.emplace_back(std::cos(turned) * from + std::sin(turned) * across, 0);
    }
    const auto worst = [&](float g, std::uint32_t variant) {
        const auto found =
            kernel_.run<vec4>({.function = 1, .variant = variant, .number = g}, pairs, count);
        double most = 0;
        for (int i = 0; i < count; ++i) {
            const glm::dvec3 a = glm::normalize(glm::dvec3(pairs[2 * i]));
            const glm::dvec3 b = glm::normalize(glm::dvec3(pairs[2 * i + 1]));
            const double exact = density(g, glm::dot(a - b, a - b) / 2);
            const double off = std::abs(found[i].x / exact - 1);
            most = std::isfinite(off) ? std::max(most, off) : INFINITY;
        }
        return most;
    };
    for (const float g : {0.0f, 1e-4f, 0.5f, 0.9f, 0.99f, 0.999f, 0.9999f, -0.5f, -0.9f, -0.999f})
        EXPECT_LT(worst(g, 0), 2e-6) << "g = " << g;
    EXPECT_GT(worst(0.999f, 1), 0.02) << "no teeth";
}

/// The integral of the value over all directions is 1, that of value times cosine g: by the
/// midpoint rule in the variable in which the exact density is constant.
TEST_F(Phase, IsNormalisedAndHasMeanCosineG) {
    constexpr int count = 1 << 14;
    for (const float g : {0.0f, 0.3f, 0.9f, 0.99f, -0.75f}) {
        std::vector<vec4> pairs;
        for (int i = 0; i < count; ++i) {
            const Deflection d = invert(g, (i + 0.5) / count);
            pairs.emplace_back(0, 0, 1, 0);
            pairs.emplace_back(d.sine(), 0, d.cosine(), 0);
        }
        const auto found = kernel_.run<vec4>({.function = 1, .number = g}, pairs, count);
        double total = 0, cosine = 0;
        for (int i = 0; i < count; ++i) {
            const Deflection d = invert(g, (i + 0.5) / count);
            const double weight = found[i].x / density(g, d.minus) / count;
            total += weight;
            cosine += weight * d.cosine();
        }
        EXPECT_NEAR(total, 1, 1e-6) << "g = " << g;
        EXPECT_NEAR(cosine, g, 1e-5) << "g = " << g; // 1e-6, and the midpoint rule
    }
}

TEST_F(Phase, SamplesFollowTheDensity) {
    const glm::vec3 from = glm::normalize(glm::vec3(-0.3, 0.5, -0.8));
    const glm::dvec3 axis = glm::normalize(glm::dvec3(from));
    const double least = stats::normal_two_sided(support::pass);
    for (const float g : {0.0f, 0.5f, 0.9f, -0.7f, 0.99f}) {
        const auto found = scatter(g, from, 1u << 20);
        EXPECT_GT(chi_squared_p(found, axis, g), least) << "g = " << g;
        EXPECT_LT(chi_squared_p(found, axis, g + (g < 0.95f ? 0.02 : 0.002)), 1e-9)
            << "no teeth at g = " << g;
        double worst = 0;
        for (const vec4& f : found) {
            const glm::dvec3 to = glm::normalize(glm::dvec3(f));
            const double exact = density(g, glm::dot(axis - to, axis - to) / 2);
            worst = std::max(worst, std::abs(f.w / exact - 1));
        }
        EXPECT_LT(worst, 1e-5) << "g = " << g;
    }
}

/// ORACLES 5.2: g > 0 scatters forward, seen from the direction of travel.
TEST_F(Phase, ForwardMeansForward) {
    constexpr std::uint32_t count = 1u << 20;
    const struct {
        float g;
        double forward;
    } cases[] = {{0.9f, 0.977096729007}, {0.5f, 0.82917960675}, {-0.5f, 0.17082039325}};
    for (const auto& c : cases) {
        double forward = 0;
        for (const vec4& f : scatter(c.g, {0, 0, 1}, count))
            forward += f.z > 0 ? 1.0 / count : 0;
        const double error = std::sqrt(c.forward * (1 - c.forward) / count);
        EXPECT_LT(std::abs(forward - c.forward), support::pass * error) << c.g;
        EXPECT_GT(std::abs(forward - (1 - c.forward)), support::reject * error) << "no teeth";
    }
}

/// With g = 0 everywhere the pipeline holds the isotropic phase function alone.
TEST_F(Phase, IsotropicPipelinesAreIsotropic) {
    shared::Features features;
    features.phases = 0;
    const auto found = scatter(0.5f, {0, 0, 1}, 1u << 20, features); // g is not looked at
    EXPECT_GT(chi_squared_p(found, {0, 0, 1}, 0), stats::normal_two_sided(support::pass));
    EXPECT_LT(chi_squared_p(found, {0, 0, 1}, 0.02), 1e-9) << "no teeth";
    for (const vec4& f : found)
        ASSERT_NEAR(f.w, 1 / (4 * pi), 1e-8);
}

} // namespace tyndall::shader_test

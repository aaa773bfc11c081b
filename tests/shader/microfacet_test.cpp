/// Rough boundaries: distribution, sampling, density and value.

#include "shader/kernel.h"
#include "spirv/boundary.h"
#include "stats/distributions.h"
#include "support/estimates.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace tyndall::shader_test {
namespace {

using glm::dvec3;
using glm::vec4;
using std::numbers::pi;

constexpr double kUnit = 0x1p-24; ///< Of rounding, relative.
constexpr std::uint32_t kMost = 1u << 20;

double lambda(const dvec3& w, double alpha) {
    const double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
    return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}

double ggx_density(const dvec3& m, double alpha) {
    const double tan2 = (m.x * m.x + m.y * m.y) / (m.z * m.z), a2 = alpha * alpha;
    const double cos4 = m.z * m.z * m.z * m.z, e = 1 + tan2 / a2;
    return 1 / (pi * a2 * cos4 * e * e);
}

dvec3 direction(double z, double phi) {
    const double r = std::sqrt((1 - z) * (1 + z));
    return {r * std::cos(phi), r * std::sin(phi), z};
}

struct Sampled {
    vec4 direction; ///< w: 1, or 0 if nothing comes from there.
    float pdf, weight, same_pdf, same_weight;
};

struct Case {
    float eta; ///< Inside over outside.
    bool entering;
    float alpha, cosine;
    double index() const { return entering ? double{eta} : 1.0 / eta; }
    std::vector<vec4> texels() const {
        return {vec4(direction(cosine, 0.7), alpha), vec4(eta, entering, 0, 0)};
    }
};

class Microfacet : public GpuTest {
  protected:
    Kernel kernel_{"boundary", boundary_spirv, 1u << 21, 2 * kMost};
};

} // namespace

TEST_F(Microfacet, DistributionAndMaskingKeepTheirDigits) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform;
    std::vector<vec4> inputs;
    const auto count = 1u << 15;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double alpha = std::pow(10, -3 + 3 * uniform(random));
        // Normals as they occur: tan = alpha sqrt(u / (1 - u)); directions down to grazing.
        const double u = uniform(random), tan2 = alpha * alpha * u / (1 - u);
        const dvec3 m = direction(1 / std::sqrt(1 + tan2), 6.28 * uniform(random));
        const double z = i % 2 ? uniform(random) : std::pow(10, -6 * uniform(random));
        inputs.emplace_back(direction(z, 6.28 * uniform(random)), alpha);
        inputs.emplace_back(m, 0);
    }
    const auto worst = [&](std::uint32_t variant) {
        const auto found = kernel_.run<vec4>({.function = 2, .variant = variant}, inputs, count);
        glm::dvec2 most(0);
        for (std::uint32_t i = 0; i < count; ++i) {
            const dvec3 wo(inputs[2 * i]), m(inputs[2 * i + 1]);
            const double alpha = inputs[2 * i].w;
            const double lo = lambda(wo, alpha), li = lambda(m, alpha);
            const double exact[] = {ggx_density(m, alpha), (1 + lo) / (1 + lo + li)};
            for (int k = 0; k < 2; ++k)
                most[k] = std::max(most[k], std::abs(found[i][k] / exact[k] - 1));
        }
        return most / kUnit;
    };
    // A dozen roundings each, and float32's z of a unit vector, which is off by one more.
    EXPECT_LT(worst(0).x, 32);
    EXPECT_LT(worst(0).y, 32);
    EXPECT_GT(worst(1).x, 1000) << "no teeth";
}

/// Cells by the azimuth and by s = alpha / sqrt(alpha^2 + tan^2), whose square is the part of D(m)
/// m.z that lies further out: of visible normals, 2 s G1(wo) max(0, wo.m) / (wo.z m.z) ds dphi / 2
/// pi, a density without poles.
double visible_normals_p(const std::vector<vec4>& found, const dvec3& wo, double alpha) {
    constexpr int polar = 16, azimuths = 24, fine = 24;
    std::vector<double> counts(polar * azimuths), expected(polar * azimuths);
    const double g1 = 1 / (1 + lambda(wo, alpha));
    for (int i = 0; i < polar * fine; ++i)
        for (int k = 0; k < azimuths * fine; ++k) {
            const double s = (i + 0.5) / (polar * fine);
            const double cosine = 1 / std::sqrt(1 + alpha * alpha * (1 - s * s) / (s * s));
            const dvec3 m = direction(cosine, 2 * pi * ((k + 0.5) / (azimuths * fine) - 0.5));
            expected[i / fine * azimuths + k / fine] +=
                2 * s * g1 * std::max(0.0, glm::dot(wo, m)) / (wo.z * m.z) /
                (polar * fine * azimuths * fine);
        }
    for (const vec4& m : found) {
        const double tan2 = (double{m.x} * m.x + double{m.y} * m.y) / (double{m.z} * m.z);
        const double s = alpha / std::sqrt(alpha * alpha + tan2);
        const double turn = std::atan2(m.y, m.x) / (2 * pi) + 0.5;
        const int i = std::clamp(static_cast<int>(s * polar), 0, polar - 1);
        const int k = std::clamp(static_cast<int>(turn * azimuths), 0, azimuths - 1);
        ++counts[i * azimuths + k];
    }
    double sum = 0, dof = -1, rest_counts = 0, rest_expected = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double n = expected[i] * static_cast<double>(found.size());
        if (n < 25) { // too few for the statistic: all such cells are one
            rest_counts += counts[i];
            rest_expected += n;
            continue;
        }
        sum += (counts[i] - n) * (counts[i] - n) / n;
        ++dof;
    }
    if (rest_expected >= 25) {
        sum += (rest_counts - rest_expected) * (rest_counts - rest_expected) / rest_expected;
        ++dof;
    }
    return stats::chi_squared_tail(sum, dof);
}

TEST_F(Microfacet, VisibleNormalsFollowTheirDensity) {
    kernel_.push.seed = {5, 0};
    for (const float alpha : {0.001f, 0.05f, 0.3f, 1.0f})
        for (const double cosine : {1.0, 0.6, 0.1}) {
            const dvec3 wo = direction(cosine, 0.7);
            const auto found =
                kernel_.run<vec4>({.function = 4}, std::vector{vec4(wo, alpha)}, 1u << 19);
            EXPECT_GT(visible_normals_p(found, wo, alpha), stats::normal_two_sided(support::pass))
                << alpha << ' ' << cosine;
            EXPECT_LT(visible_normals_p(found, wo, 1.03 * alpha), 1e-9) << "no teeth " << alpha;
            if (cosine < 1 && alpha > 0.1f) { // what is almost a mirror hardly knows from where
                EXPECT_LT(visible_normals_p(found, direction(cosine, 0.8), alpha), 1e-9)
                    << "no teeth " << alpha;
            }
        }
}

/// Bound on the relative error of a density that is evaluated from float32 directions. Their half
/// vector is off by some roundings over its length; the distribution takes that over its width
/// alpha, to the fourth power; Fresnel and the Jacobian take it over the square of the wave vector
/// beyond, which vanishes at the critical angle.
double evaluation_error(const Case& c, const dvec3& wi) {
    const dvec3 wo = direction(c.cosine, 0.7);
    const dvec3 half = wo + (wi.z > 0 ? 1 : c.index()) * wi;
    const double cosine = glm::dot(wo, half) / glm::length(half);
    const double beyond2 = std::abs(c.index() * c.index() - 1 + cosine * cosine);
    const double off = 16 * kUnit / std::min(1.0, glm::length(half));
    return 4 * off * (1 / c.alpha + 1 / beyond2);
}

/// What a sample says of itself is what evaluation says of its direction, and all of it is a
/// number, for every roughness, index and angle.
TEST_F(Microfacet, SamplesAreWhatTheyAreEvaluatedAs) {
    for (const float eta : {1.0001f, 1.33f, 2.4f, 0.75f})
        for (const bool entering : {true, false})
            for (const float alpha : {0.001f, 0.1f, 1.0f})
                for (const float cosine : {1.0f, 0.5f, 1e-2f, 1e-6f, 0.0f}) {
                    const Case c{eta, entering, alpha, cosine};
                    const auto found = kernel_.run<Sampled>({.function = 5}, c.texels(), 1u << 12);
                    const double index = c.index(), most = std::max(1.0, 1 / (index * index));
                    int agree = 0, different = 0, missed = 0;
                    for (const Sampled& s : found) {
                        ASSERT_NEAR(glm::length(glm::vec3(s.direction)), 1, 8 * kUnit);
                        if (s.direction.w == 0) continue;
                        ASSERT_TRUE(s.pdf >= 0 && s.pdf < 3e38) << s.pdf;
                        ASSERT_TRUE(s.weight >= 0 && s.weight <= most * (1 + 8 * kUnit))
                            << s.weight;
                        ASSERT_TRUE(s.same_pdf >= 0 && s.same_pdf < 3e38) << s.same_pdf;
                        ASSERT_TRUE(s.same_weight >= 0 && s.same_weight <= most * (1 + 8 * kUnit));
                        const double off = evaluation_error(c, dvec3(s.direction));
                        if (off > 0.1 || cosine < 0.1F) continue;
                        (std::abs(s.same_pdf / s.pdf - 1) < off ? agree : different)++;
                        missed += off < 0.004 && std::abs(1.01 * s.same_pdf / s.pdf - 1) < off;
                    }
                    EXPECT_LE(missed, different) << "no teeth";
                    EXPECT_LE(different, agree / 1000)
                        << eta << ' ' << entering << ' ' << alpha << ' ' << cosine;
                }
}

/// The integral of density and value over all directions, by the midpoint rule, is what samples
/// say: the fraction that goes on, and the mean of their weights (the albedo).
TEST_F(Microfacet, DensityAndValueIntegrateToWhatSamplesDo) {
    constexpr int polar = 512, azimuths = 1024;
    for (const Case& c : {Case{1.5f, true, 0.5f, 0.8f}, Case{1.5f, false, 0.5f, 0.8f},
                          Case{1.33f, true, 0.3f, 0.3f}, Case{1.33f, false, 0.8f, 0.95f}}) {
        std::vector<vec4> texels = c.texels();
        for (int i = 0; i < polar; ++i)
            for (int k = 0; k < azimuths; ++k)
                texels.emplace_back(direction(2 * (i + 0.5) / polar - 1, 2 * pi * k / azimuths), 0);
        const auto values = kernel_.run<vec4>({.function = 6}, texels, polar * azimuths);
        double pdf = 0, value = 0;
        for (const vec4& v : values) {
            pdf += v.x * 4 * pi / (polar * azimuths);
            value += double{v.x} * v.y * 4 * pi / (polar * azimuths);
        }
        const auto samples = kernel_.run<Sampled>({.function = 5}, c.texels(), 1u << 20);
        double on = 0, sum = 0, squares = 0;
        for (const Sampled& s : samples) {
            const double w = s.direction.w != 0 ? s.weight : 0;
            on += s.direction.w;
            sum += w;
            squares += w * w;
        }
        const double n = static_cast<double>(samples.size());
        on /= n;
        sum /= n;
        const double error_on = std::sqrt(std::max(on * (1 - on), 1e-6) / n);
        const double error = std::sqrt((squares / n - sum * sum) / n);
        EXPECT_LT(std::abs(pdf - on), support::pass * error_on + 1e-4) << c.eta << ' ' << c.cosine;
        EXPECT_LT(std::abs(value - sum), support::pass * error + 1e-4) << c.eta << ' ' << c.cosine;
        // The control: the value without the squeeze of refraction.
        const double index = c.index();
        EXPECT_GT(std::abs(value * index * index - sum), support::reject * error + 1e-3)
            << "no teeth";
    }
}

TEST_F(Microfacet, MetalSamplesAreWhatTheyAreEvaluatedAs) {
    for (const float alpha : {0.001f, 0.1f, 1.0f})
        for (const float cosine : {1.0f, 0.5f, 1e-6f, 0.0f}) {
            const std::vector<vec4> texels{vec4(direction(cosine, 0.7), alpha),
                                           vec4(0.2f, 0.9f, 1.1f, 0), vec4(3.9f, 2.5f, 2.1f, 0)};
            int agree = 0, different = 0;
            for (const Sampled& s : kernel_.run<Sampled>({.function = 7}, texels, 1u << 14)) {
                ASSERT_NEAR(glm::length(glm::vec3(s.direction)), 1, 8 * kUnit);
                if (s.direction.w == 0) continue;
                ASSERT_TRUE(s.pdf >= 0 && s.pdf < 3e38 && s.weight >= 0 && s.weight <= 1);
                const double off = 64 * kUnit / alpha + 1e-5;
                if (cosine < 0.1F) continue;
                const bool is_same = std::abs(s.same_pdf / s.pdf - 1) < off &&
                                     std::abs(s.same_weight / s.weight - 1) < off;
                (is_same ? agree : different)++;
            }
            EXPECT_LE(different, agree / 1000) << alpha << ' ' << cosine;
        }
}

} // namespace tyndall::shader_test

/// Every kind of phase function on the device, against double precision: value, inversion, samples.

#include "reference/phase.h"
#include "reference/quadrature.h"
#include "render/phase_tables.h"
#include "shader/kernel.h"
#include "spirv/phase.h"
#include "stats/distributions.h"
#include "support/estimates.h"
#include "support/phases.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace tyndall::shader_test {
namespace {

using glm::vec4;
using reference::evaluate_phase;
using reference::integrate16;
using std::numbers::pi;
using Mixture = std::vector<PhaseFunction>;

constexpr std::uint32_t kMost = 1u << 20;

/// The probability of less deflection than 1 - mu, for any number of them in increasing order: 2 pi
/// times the integral, node by node.
std::vector<double> cumulative(const Mixture& mixture, std::vector<double> complements,
                               int channel) {
    std::vector<double> nodes;
    for (const PhaseFunction& phase : mixture)
        if (phase.table)
            nodes.insert(nodes.end(), phase.table->complement.begin(),
                         phase.table->complement.end());
    for (double theta = 0; theta < pi; theta += 1e-3) // where the closed forms are smooth
        nodes.push_back(2 * std::pow(std::sin(theta / 2), 2));
    std::sort(nodes.begin(), nodes.end());
    std::vector<double> result;
    double sum = 0, at = 0;
    auto next = nodes.begin();
    const auto density = [&](double c) { return 2 * pi * evaluate_phase(mixture, c)[channel]; };
    for (const double c : complements) {
        for (; next != nodes.end() && *next < c; ++next) {
            sum += integrate16(density, at, *next);
            at = *next;
        }
        sum += integrate16(density, at, c);
        at = c;
        result.push_back(sum);
    }
    return result;
}

/// The kernel of a phase function, with its tables.
class PhaseKernel {
  public:
    explicit PhaseKernel(const Mixture& mixture, const shared::Features& features = {},
                         int hero = 0)
        : kernel_("phase", phase_spirv, 1u << 18, kMost, features) {
        PhasePacker packer([&](const std::vector<glm::uvec4>& texels, const char*) {
            const auto start = static_cast<std::uint32_t>(input_.size());
            input_.insert(input_.end(), texels.begin(), texels.end());
            return start;
        });
        const PhaseWords words = packer.pack(mixture);
        kernel_.push.seed = {17, 0};
        kernel_.push.media = words.phase;
        kernel_.push.shapes = static_cast<std::uint32_t>(hero);
        kernel_.push.lights = static_cast<std::uint32_t>(input_.size());
        parameter_ = words.parameter;
    }
    std::vector<vec4> run(std::uint32_t function, std::uint32_t first, std::uint32_t count,
                          const std::vector<vec4>& own_input = {}) {
        std::vector<glm::uvec4> input = input_;
        for (const vec4& v : own_input)
            input.push_back(glm::floatBitsToUint(v));
        return kernel_.run<vec4>({.function = function, .first = first, .number = parameter_},
                                 input, count);
    }

  private:
    std::vector<glm::uvec4> input_;
    float parameter_ = 0;
    Kernel kernel_;
};

class PhaseKinds : public GpuTest {};

const std::vector<Mixture>& singles() {
    static const std::vector<Mixture> all{{support::henyey_greenstein(0.75)},
                                          {support::schlick(0.9F)},
                                          {support::schlick(-0.999F)},
                                          {support::schlick(1e-6F)},
                                          {support::rayleigh()},
                                          {support::mie(1e-3, 1.5)},
                                          {support::mie(3, 1.5)},
                                          {support::mie(60, 1.333)},
                                          {support::mie(1000, 1.333)},
                                          {support::mie(12, 1.333, 0.3)}};
    return all;
}

Mixture mixture() {
    return {support::weighted(0.3, support::rayleigh()),
            support::weighted(0.5, support::mie({20, 30, 40}, 1.333)),
            support::weighted(0.05, support::schlick(-0.7F)),
            support::weighted(0.15, support::henyey_greenstein(0))};
}

/// The largest error of P(less deflection than drawn) = 1 - xi, absolute and, over 1 - xi,
/// relative.
struct Miss {
    double absolute = 0, relative = 0;
};

Miss worst_miss(const Mixture& drawn, const Mixture& assumed, int hero = 0) {
    constexpr std::uint32_t count = 1u << 14;
    PhaseKernel kernel(drawn, {}, hero);
    std::vector<std::pair<double, double>> draws; // 1 - mu, 1 - xi
    for (const std::uint32_t first : {0u, 1u << 22, 1u << 23, (1u << 24) - count}) {
        const auto found = kernel.run(0, first, count);
        for (std::uint32_t i = 0; i < count; ++i)
            draws.emplace_back(found[i].x < 1 ? found[i].x : 2 - double{found[i].y},
                               1 - (first + i) * 0x1p-24);
    }
    std::sort(draws.begin(), draws.end());
    std::vector<double> complements;
    for (const auto& draw : draws)
        complements.push_back(draw.first);
    const std::vector<double> chances = cumulative(assumed, complements, hero);
    Miss worst;
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const double miss = std::abs(chances[i] - draws[i].second);
        worst.absolute = std::max(worst.absolute, miss);
        worst.relative = std::max(worst.relative, miss / draws[i].second);
    }
    return worst;
}

} // namespace

/// Some ulps of 1 in all, and, since the number drawn for a forward peak is as small as 2^-24, in
/// relation to that.
TEST_F(PhaseKinds, InversionIsExact) {
    for (const Mixture& m : singles()) {
        const Miss miss = worst_miss(m, m);
        EXPECT_LT(miss.absolute, 5e-7) << phase_kind(m[0].kind);
        if (m[0].kind != PhaseFunction::Kind::rayleigh) { // which has no peak
            EXPECT_LT(miss.relative, 1e-5) << phase_kind(m[0].kind);
        }
        if (m[0].table) {
            EXPECT_GT(worst_miss(m, {support::perturbed(m[0], 0.01)}).absolute, 1e-5) << "no teeth";
        }
    }
    const Mixture chromatic{support::mie({4, 6, 9}, 1.333)};
    for (int hero = 0; hero < 3; ++hero)
        EXPECT_LT(worst_miss(chromatic, chromatic, hero).absolute, 5e-7);
    const Mixture other{support::mie({9, 4, 6}, 1.333)};
    EXPECT_GT(worst_miss(chromatic, other, 1).absolute, 1e-2) << "no teeth";
}

/// Pairs of directions at angles from 1e-7 to pi, forward and backward. What the rounding of the
/// angle alone may change is allowed for: 1e-6 of both complements.
TEST_F(PhaseKinds, ValuesAreThoseOfDoublePrecision) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    constexpr int count = 1 << 14;
    std::vector<vec4> pairs;
    for (int i = 0; i < count; ++i) {
        const auto vector = [&] {
            return glm::dvec3(normal(random), normal(random), normal(random));
        };
        const glm::dvec3 from = glm::normalize(vector());
        const glm::dvec3 across = glm::normalize(glm::cross(from, vector()));
        const double angle = i % 2 ? pi * i / count : std::pow(10, -7 + 7.0 * i / count);
        const double turned = i % 4 < 2 ? angle : pi - angle;
        pairs.emplace_back(from, 0);
        pairs.emplace_back(std::cos(turned) * from + std::sin(turned) * across, 0);
    }
    const auto worst = [&](const Mixture& m, const Mixture& assumed) {
        const auto found = PhaseKernel(m).run(1, 0, count, pairs);
        double most = 0;
        for (int i = 0; i < count; ++i) {
            const glm::dvec3 a = glm::normalize(glm::dvec3(pairs[2 * i]));
            const glm::dvec3 b = glm::normalize(glm::dvec3(pairs[2 * i + 1]));
            const double om = glm::dot(a - b, a - b) / 2, op = glm::dot(a + b, a + b) / 2;
            for (int c = 0; c < 3; ++c) {
                const auto at = [&](double scale) {
                    const double moved = om < op ? om * scale : 2 - op * scale;
                    return evaluate_phase(assumed, std::clamp(moved, 0.0, 2.0))[c];
                };
                const auto [least, largest] = std::minmax({at(1 - 1e-6), at(1), at(1 + 1e-6)});
                const double value = found[i][c];
                most = std::max({most, (value - largest) / largest, (least - value) / least});
            }
        }
        return most;
    };
    for (const Mixture& m : singles())
        EXPECT_LT(worst(m, m), 4e-6) << phase_kind(m[0].kind);
    const Mixture m = mixture();
    EXPECT_LT(worst(m, m), 4e-6);
    Mixture other = m;
    other[1] = support::weighted(m[1].weight, support::perturbed(m[1], 0.001));
    EXPECT_GT(worst(m, other), 1e-4) << "no teeth";
}

/// Chi-squared over 64 intervals of the angle and 8 of the azimuth.
TEST_F(PhaseKinds, MixturesAreSampledExactly) {
    const Mixture m = mixture();
    constexpr std::size_t polar = 64, azimuths = 8;
    constexpr int hero = 2;
    std::vector<double> edges;
    for (std::size_t i = 1; i <= polar; ++i)
        edges.push_back(2 * std::pow(double(i) / polar, 3));
    std::vector<double> counts(polar * azimuths);
    const auto found = PhaseKernel(m, {}, hero).run(2, 0, kMost, {vec4(0, 0, 1, 0)});
    for (const vec4& f : found) {
        const double c = f.z < 0.5F ? 1 - double{f.z} : (f.x * f.x + f.y * f.y) / (1 + double{f.z});
        const auto i = static_cast<std::size_t>(
            std::upper_bound(edges.begin(), edges.end() - 1, c) - edges.begin());
        const double turn = std::atan2(double{f.y}, double{f.x}) / (2 * pi) + 0.5;
        ++counts[i * azimuths + std::min(azimuths - 1, static_cast<std::size_t>(turn * azimuths))];
        const double exact = evaluate_phase(m, c)[hero];
        ASSERT_NEAR(f.w / exact, 1,
                    1e-4); // 1 - mu from rounded directions: 1e-6 of it, times slopes of tables
    }
    const auto p_value = [&](const Mixture& assumed) {
        const std::vector<double> chances = cumulative(assumed, edges, hero);
        double sum = 0;
        for (std::size_t i = 0; i < polar; ++i) {
            const double chance = chances[i] - (i > 0 ? chances[i - 1] : 0);
            const double expected = kMost * chance / azimuths;
            for (std::size_t k = 0; k < azimuths; ++k)
                sum += std::pow(counts[i * azimuths + k] - expected, 2) / expected;
        }
        return stats::chi_squared_tail(sum, polar * azimuths - 1);
    };
    EXPECT_GT(p_value(m), stats::normal_two_sided(support::pass));
    Mixture other = m;
    other[0].weight += 0.02;
    other[1].weight -= 0.02;
    EXPECT_LT(p_value(other), 1e-9) << "no teeth";
}

/// A pipeline that knows of one kind only computes the same as the one that knows of all, but for
/// how a driver contracts sums.
TEST_F(PhaseKinds, PipelinesForOneKindAgree) {
    constexpr std::uint32_t count = 1u << 14;
    const std::vector<vec4> from{vec4(0, 0, 1, 0)};
    for (const Mixture& m : singles()) {
        const auto general = PhaseKernel(m).run(2, 0, count, from);
        const auto farthest = [&](std::uint32_t phases) {
            shared::Features features;
            features.phases = phases;
            features.has_mixtures = features.has_chromatic_phases = 0;
            const auto found = PhaseKernel(m, features).run(2, 0, count, from);
            float most = 0;
            for (std::uint32_t i = 0; i < count; ++i)
                most = std::max(most, glm::length(glm::vec3(found[i] - general[i])));
            return most;
        };
        const std::uint32_t bit = 1u << phase_kind(m[0].kind);
        EXPECT_LT(farthest(bit), 1e-5F) << bit; // where a table is steep
        EXPECT_GT(farthest(bit == shared::PHASE_BIT_SCHLICK ? shared::PHASE_BIT_RAYLEIGH
                                                            : shared::PHASE_BIT_SCHLICK),
                  0.1F)
            << "no teeth";
    }
}

} // namespace tyndall::shader_test

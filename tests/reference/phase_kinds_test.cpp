// Every kind of phase function and mixtures of them: normalisation, mean cosine, exact sampling.
#include "reference/phase.h"
#include "reference/quadrature.h"
#include "stats/distributions.h"
#include "support/estimates.h"
#include "support/phases.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace tyndall::reference {
namespace {

using support::mie;
using support::rayleigh;
using support::schlick;
using support::weighted;
using Mixture = std::vector<PhaseFunction>;

const std::vector<Mixture>& mixtures() {
    static const std::vector<Mixture> all{
        {support::henyey_greenstein(0.6)},
        {schlick(0.9)},
        {schlick(-0.9)},
        {schlick(1e-8)},
        {schlick(0.0099)},
        {schlick(0.0101)},
        {schlick(0.9999)},
        {rayleigh()},
        {mie(1e-3, 1.5)},
        {mie(2, 1.5)},
        {mie(60, 1.333)},
        {mie(1000, 1.333)},
        {mie(15, 1.333, 0.3)},
        {weighted(0.25, rayleigh()), weighted(0.6, mie(60, 1.333)), weighted(0.15, schlick(-0.5))}};
    return all;
}

/// 2 pi times the integral of f(1 - cos) p over [a, b], with a share of the work for each segment
/// of the tables.
template<class Function>
double integrate_over(const Mixture& mixture, double a, double b, Function&& f) {
    std::vector<double> nodes{a, b};
    for (const PhaseFunction& phase : mixture)
        if (phase.table)
            for (double node : phase.table->complement)
                if (node > a && node < b) nodes.push_back(node);
    std::sort(nodes.begin(), nodes.end());
    double sum = 0;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const auto integrand = [&](double c) {
            return 2 * pi * f(c) * evaluate_phase(mixture, c).x;
        };
        sum += nodes.size() > 2 ? integrate16(integrand, nodes[i], nodes[i + 1])
                                : integrate(integrand, nodes[i], nodes[i + 1]);
    }
    return sum;
}

TEST(PhaseKinds, IntegrateToOneWithTheMeanCosineThatIsPredicted) {
    for (const Mixture& m : mixtures()) {
        EXPECT_NEAR(integrate_over(m, 0, 2, [](double) { return 1; }), 1, 1e-9);
        const double cosine = 1 - integrate_over(m, 0, 2, [](double c) { return c; });
        EXPECT_NEAR(cosine, mean_cosine(m).x, 1e-8);
    }
}

/// The probability of less deflection than the angle drawn for xi is 1 - xi: mu = 1 at xi = 1.
TEST(PhaseKinds, InversionIsExact) {
    for (const Mixture& m : mixtures()) {
        if (m.size() > 1) continue;
        const auto miss = [&](const PhaseFunction& assumed, double xi) {
            const double to = sample_angle(m.front(), xi).one_minus_cosine;
            return std::abs(integrate_over({assumed}, 0, to, [](double) { return 1; }) - (1 - xi));
        };
        double most = 0;
        for (double xi : {1e-7, 0.01, 0.25, 0.5, 0.7, 0.9, 0.999, 1 - 0x1p-24}) {
            EXPECT_LT(miss(m.front(), xi), 1e-9) << xi;
            if (m.front().table)
                most = std::max(most, miss(support::perturbed(m.front(), 0.01), xi));
        }
        EXPECT_TRUE(!m.front().table || most > 1e-5) << "no teeth";
    }
}

TEST(PhaseKinds, EndsAreReachedAndForwardIsForward) {
    for (const Mixture& m : mixtures()) {
        // A table's CDF is a sum of up to 2e4 terms.
        EXPECT_NEAR(sample_angle(m.back(), 0).cosine, -1, 1e-12);
        EXPECT_EQ(sample_angle(m.back(), 1).cosine, 1);
        EXPECT_EQ(sample_angle(m.back(), 1).sine, 0);
    }
    // Most of a forward peak is within half a degree of forward.
    EXPECT_GT(sample_angle(mie(1000, 1.333), 0.7).cosine, std::cos(0.5 * pi / 180));
    EXPECT_LT(sample_angle(schlick(-0.9999), 0.3).cosine, -0.99);
}

/// Sine, cosine and complement describe one angle, without losing the peak.
TEST(PhaseKinds, AnglesKeepTheirDigits) {
    const PhaseFunction peaked = mie(1000, 1.333);
    for (double xi = 0.5; xi < 1; xi = (1 + 3 * xi) / 4) {
        const ScatteringAngle a = sample_angle(peaked, xi);
        const double complement = a.sine * a.sine / (1 + a.cosine);
        EXPECT_NEAR(complement / a.one_minus_cosine, 1, 1e-12);
        if (1 - xi < 1e-12) break;
    }
}

/// Inversion values of ORACLES 4.4 and 5.3.
TEST(PhaseKinds, MatchKnownValues) {
    for (const auto& [xi, cosine] : {std::pair{1e-7, -0.99999986666665778},
                                     {0.1, -0.85691874269097671},
                                     {0.5, 0.0},
                                     {0.5000001, 2.6666666666666035e-7},
                                     {0.75, 0.59607163798332152}})
        EXPECT_NEAR(sample_angle(rayleigh(), xi).cosine, cosine, 1e-15);
    EXPECT_NEAR(mean_cosine(schlick(0.15445)).x, 0.103463006, 1e-9);
    EXPECT_NEAR(mean_cosine(schlick(0.99405)).x, 0.971077909, 1e-9);
    const double k = 1.55 * 0.9 - 0.55 * 0.9 * 0.9 * 0.9;
    EXPECT_NEAR(sample_angle(schlick(k), 0.25).cosine, 0.982255579303146, 1e-14);
    EXPECT_NEAR(sample_angle(schlick(k), 0.75).cosine, 0.998012725238389, 1e-14);
    EXPECT_NEAR(4 * pi * evaluate_phase(schlick(k), 0).x, 335.134454, 1e-5);
    EXPECT_NEAR(4 * pi * evaluate_phase(schlick(k), 2).x, 0.00298387703, 1e-10);
    EXPECT_NEAR(4 * pi * evaluate_phase(rayleigh(), 1).x, 0.75, 1e-15);
}

/// Chi-squared over 64 intervals of the cosine, of chances by quadrature.
double chi_squared_p(const Mixture& drawn, const Mixture& assumed) {
    constexpr std::size_t bins = 64;
    constexpr int n = 1 << 18;
    std::vector<double> edges{0};
    for (std::size_t i = 1; i < bins;
         ++i) // any edges will do: those of equal chance of one component
        edges.push_back(sample_angle(drawn.front(), 1 - double(i) / bins).one_minus_cosine);
    edges.push_back(2);
    std::vector<double> counts(bins);
    for (std::uint32_t i = 0; i < n; ++i) {
        const double xi = unit(RandomPath{{3, 1}, i, 0}.words(1, shared::BLOCK_PATH).y);
        const double c = sample_angle(drawn, xi, 0).one_minus_cosine;
        ++counts[static_cast<std::size_t>(std::upper_bound(edges.begin() + 1, edges.end() - 1, c) -
                                          edges.begin() - 1)];
    }
    double sum = 0;
    for (std::size_t i = 0; i < bins; ++i) {
        const double expected =
            n * integrate_over(assumed, edges[i], edges[i + 1], [](double) { return 1; });
        sum += (counts[i] - expected) * (counts[i] - expected) / expected;
    }
    return stats::chi_squared_tail(sum, bins - 1);
}

TEST(PhaseKinds, MixturesAreSampledExactly) {
    const double least = stats::normal_two_sided(support::pass);
    for (const Mixture& m : mixtures())
        EXPECT_GT(chi_squared_p(m, m), least);
    const Mixture& m = mixtures().back();
    Mixture tilted = m, shifted = m;
    tilted[1] = weighted(m[1].weight, support::perturbed(m[1], 0.5));
    shifted[0].weight += 0.02;
    shifted[1].weight -= 0.02;
    EXPECT_LT(chi_squared_p(m, tilted), 1e-9) << "no teeth";
    EXPECT_LT(chi_squared_p(m, shifted), 1e-9) << "no teeth";
}

/// The angle between two directions does not care which is first, or which way light runs.
TEST(PhaseKinds, AreReciprocal) {
    const dvec3 a = glm::normalize(dvec3(0.2, -0.7, 0.4)),
                b = glm::normalize(dvec3(0.3, 0.1, -0.9));
    for (const Mixture& m : mixtures())
        EXPECT_EQ(evaluate_phase(m, one_minus_cosine(a, b)),
                  evaluate_phase(m, one_minus_cosine(-b, -a)));
}

/// Each hero draws from its own channel's table.
TEST(PhaseKinds, HeroesDrawFromTheirOwnTable) {
    const Mixture m{mie({5, 10, 20}, 1.333)};
    EXPECT_TRUE(is_chromatic(m));
    EXPECT_FALSE(is_chromatic({mie(10, 1.333)}));
    for (int hero = 0; hero < 3; ++hero) {
        double sum = 0;
        constexpr int n = 1 << 14;
        for (int i = 0; i < n; ++i)
            sum += sample_angle(m, (i + 0.5) / n, hero).cosine / n;
        EXPECT_NEAR(sum, m.front().table->mean_cosine[static_cast<std::size_t>(hero)], 1e-6);
    }
}

} // namespace
} // namespace tyndall::reference

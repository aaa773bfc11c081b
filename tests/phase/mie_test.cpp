// Tables of Lorenz-Mie phase functions, of one size and of many.
#include "phase/mie.h"

#include "core/error.h"
#include "phase/mie_sphere.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace tyndall {
namespace {

using std::numbers::pi;

/// Spheres of one size parameter, in all channels.
MieParameters of_size(double x, double eta, double k = 0, double sigma = 0) {
    MieParameters p;
    p.wavelength_um = {0.5, 0.5, 0.5};
    p.radius_um = x * 0.5 / (2 * pi);
    p.radius_sigma = sigma;
    p.eta = {eta, eta, eta};
    p.k = {k, k, k};
    return p;
}

double interpolate(const PhaseTable& table, double degrees) {
    const double s = std::sin(degrees * pi / 360);
    const double c = 2 * s * s;
    const auto& nodes = table.complement;
    const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, c);
    const auto i = static_cast<std::size_t>(above - nodes.begin());
    const double t = (c - nodes[i - 1]) / (nodes[i] - nodes[i - 1]);
    return table.value[0][i - 1] * (1 - t) + table.value[0][i] * t;
}

/// Values per steradian of water, by an independent program.
TEST(Mie, TableMatchesKnownValues) {
    constexpr double degrees[] = {0, 1, 5, 10, 30, 60, 90, 120, 140, 160, 175, 180};
    constexpr double at_10[] = {5.0505937,    4.9886516,    3.6709319,    1.1836966,
                                3.1903724e-1, 5.6055598e-2, 1.2246478e-2, 9.9723697e-3,
                                2.8648436e-2, 3.6686229e-2, 1.4141200e-2, 2.0005049e-2};
    constexpr double at_100[] = {421.80383,    185.60194,    3.7309504,    0.82146120,
                                 8.2987704e-2, 1.2744080e-2, 1.4329453e-3, 1.9537447e-3,
                                 2.1900436e-2, 5.7396938e-3, 1.2480466e-2, 9.2805677e-3};
    for (const auto& [x, known] : {std::pair{10.0, at_10}, std::pair{100.0, at_100}}) {
        const PhaseTable table = compute_mie(of_size(x, 1.333)).table;
        // Linear interpolation of lobes of width pi / x with steps of pi / (10 x) at most
        // (backward; less forward) is off by up to (pi / 10)^2 / 8 = 1.2 % of their height, here
        // the larger of the value and 0.02.
        for (int i = 0; i < 12; ++i)
            EXPECT_NEAR(interpolate(table, degrees[i]), known[i], 0.012 * std::max(known[i], 0.02))
                << x << " at " << degrees[i];
        EXPECT_NEAR(table.value[0].front() / known[0], 1,
                    1e-3); // at a node: only the normalisation differs
        EXPECT_NEAR(table.value[0].back() / known[11], 1, 1e-3);
    }
}

TEST(Mie, TablesAreDistributions) {
    for (const double x : {1e-6, 0.5, 30.0, 1000.0}) {
        const MieResult mie = compute_mie(of_size(x, 1.333));
        const PhaseTable& t = mie.table;
        const std::size_t n = t.complement.size();
        EXPECT_EQ(t.complement.front(), 0);
        EXPECT_EQ(t.complement.back(), 2);
        EXPECT_EQ(t.cdf[0].front(), 0);
        EXPECT_EQ(t.cdf[0].back(), 1);
        double sum = 0, cosine = 0;
        for (std::size_t i = 0; i + 1 < n; ++i) {
            const double width = t.complement[i + 1] - t.complement[i];
            ASSERT_GT(width, 0);
            const double mass = pi * width * (t.value[0][i] + t.value[0][i + 1]);
            EXPECT_NEAR(t.cdf[0][i + 1] - t.cdf[0][i], mass, 1e-14);
            ASSERT_GE(t.value[0][i], 0);
            sum += mass;
            // Simpson's rule is exact for the cubic value * cosine.
            const double middle = (t.complement[i] + t.complement[i + 1]) / 2;
            const double value = (t.value[0][i] + t.value[0][i + 1]) / 2;
            cosine += pi / 3 * width *
                      (t.value[0][i] * (1 - t.complement[i]) + 4 * value * (1 - middle) +
                       t.value[0][i + 1] * (1 - t.complement[i + 1]));
        }
        EXPECT_NEAR(sum, 1, 1e-12);
        EXPECT_NEAR(cosine, t.mean_cosine[0], 1e-12);
        // The interpolant against the series.
        EXPECT_NEAR(t.mean_cosine[0], mie.channels[0].asymmetry, 1e-3) << x;
    }
}

TEST(Mie, OneSizeHasTheEfficienciesOfItsSphere) {
    const MieChannel c = compute_mie(of_size(100, 1.5, 1)).channels[1];
    EXPECT_NEAR(c.size_parameter, 100, 1e-12);
    EXPECT_NEAR(c.qext, 2.097501755, 2e-9);
    EXPECT_NEAR(c.qsca, 1.283697049, 2e-9);
    EXPECT_NEAR(c.asymmetry, 0.85025200, 1e-8);
    const double area = pi * std::pow(100 * 0.5 / (2 * pi), 2);
    EXPECT_NEAR(c.extinction_um2, c.qext * area, 1e-9 * area);
}

/// In water, glass of index 1.33 * 1.5 and absorption 1.33 * 0.1 is what (1.5, 0.1) is in a vacuum
/// at a wavelength 1.33 times shorter.
TEST(Mie, OnlyRatiosToTheMediumCount) {
    MieParameters p = of_size(10, 1.5, 0.1);
    const MieChannel in_vacuum = compute_mie(p).channels[0];
    p.medium_eta = 1.33;
    for (int c = 0; c < 3; ++c) {
        p.eta[c] *= 1.33;
        p.k[c] *= 1.33;
        p.wavelength_um[c] *= 1.33;
    }
    const MieChannel in_water = compute_mie(p).channels[0];
    EXPECT_NEAR(in_water.qext, in_vacuum.qext, 1e-12);
    EXPECT_NEAR(in_water.asymmetry, in_vacuum.asymmetry, 1e-12);
}

/// Against 12000 sizes, at the midpoints of equal steps over +-8 sigma of the number: resonances
/// are resolved to 1e-4.
TEST(Mie, SizesAreIntegratedToConvergence) {
    for (const auto& [x, sigma] :
         {std::pair{2.0, 0.5}, std::pair{20.0, 0.3}, std::pair{60.0, 0.1}}) {
        double area = 0, extinction = 0, scattering = 0, forward = 0;
        constexpr int count = 12000;
        for (int i = 0; i < count; ++i) {
            const double z = -8 + 16 * (i + 0.5) / count;
            const double size = x * std::exp(sigma * z);
            const MieEfficiencies one = MieSphere(size, {1.333, 1e-3}).efficiencies();
            const double weight = std::exp(-z * z / 2) * size * size;
            area += weight;
            extinction += weight * one.extinction;
            scattering += weight * one.scattering;
            forward += weight * one.scattering * one.asymmetry;
        }
        const auto agrees = [&](double median, double assumed_sigma) {
            const MieChannel found =
                compute_mie(of_size(median, 1.333, 1e-3, assumed_sigma)).channels[0];
            return std::abs(found.qext / (extinction / area) - 1) < 1e-3 &&
                   std::abs(found.qsca / (scattering / area) - 1) < 1e-3 &&
                   std::abs(found.asymmetry / (forward / scattering) - 1) < 1e-3;
        };
        EXPECT_TRUE(agrees(x, sigma)) << x;
        EXPECT_FALSE(agrees(1.1 * x, sigma)) << "no teeth at x = " << x;
        EXPECT_FALSE(agrees(x, 1.5 * sigma)) << "no teeth at x = " << x;
    }
}

TEST(Mie, ADistributionSmoothsTheLobes) {
    const auto roughness = [](const PhaseTable& t) {
        double sum = 0;
        for (std::size_t i = 1; i < t.value[0].size(); ++i)
            sum += std::abs(std::log(t.value[0][i] / t.value[0][i - 1]));
        return sum;
    };
    const double rough = roughness(compute_mie(of_size(100, 1.333)).table);
    EXPECT_LT(roughness(compute_mie(of_size(100, 1.333, 0, 0.2)).table), 0.3 * rough);
}

TEST(Mie, ChannelsFollowTheirWavelengths) {
    MieParameters p = of_size(5, 1.333);
    EXPECT_FALSE(compute_mie(p).table.is_chromatic());
    p.wavelength_um = {0.6114, 0.5491, 0.4643};
    const MieResult mie = compute_mie(p);
    EXPECT_TRUE(mie.table.is_chromatic());
    EXPECT_LT(mie.channels[0].size_parameter, mie.channels[2].size_parameter);
    EXPECT_LT(mie.table.value[0].front(), mie.table.value[2].front()); // a narrower, higher peak
}

TEST(Mie, RefusesWhatItCannotDo) {
    EXPECT_THROW(compute_mie(of_size(1, 1)), Error);
    EXPECT_THROW(compute_mie(of_size(1e-7, 1.5)), Error);
    EXPECT_THROW(compute_mie(of_size(1.1e4, 1.5)), Error);
}

} // namespace
} // namespace tyndall

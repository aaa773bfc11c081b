// The filter table against the filters themselves.
#include "scene/filter.h"

#include <cmath>
#include <gtest/gtest.h>

namespace tyndall {
namespace {

using Kind = PixelFilter::Kind;

PixelFilter filter_of(Kind kind, double radius) {
    PixelFilter filter;
    filter.kind = kind;
    filter.x_radius = filter.y_radius = radius;
    return filter;
}

/// Integral of g over [a, b] by the midpoint rule.
template<class Function>
double integrate(Function&& g, double a, double b, int n = 20000) {
    double sum = 0;
    for (int i = 0; i < n; ++i)
        sum += g(a + (b - a) * (i + 0.5) / n);
    return sum * (b - a) / n;
}

/// Tolerances: a polygon of cells of width h is off by h^2 / 12 |f''| and rounds the corner of |f|.
TEST(FilterTable, SamplesInvertTheIntegralOfTheFilter) {
    for (const auto& [kind, radius, tolerance] :
         {std::tuple(Kind::box, 0.5, 1e-12), std::tuple(Kind::triangle, 2.0, 1e-7),
          std::tuple(Kind::gaussian, 1.5, 1e-4), std::tuple(Kind::mitchell, 2.0, 3e-4)}) {
        const PixelFilter filter = filter_of(kind, radius);
        const FilterTable table = make_filter_table(filter, radius);
        const auto magnitude = [&](double x) {
            return std::abs(evaluate_filter(filter, radius, x));
        };
        const double total = integrate(magnitude, -radius, radius);
        for (double u : {0.0, 0.01, 0.1, 0.25, 0.5, 0.7, 0.95, 1 - 0x1p-24}) {
            const FilterSample sample = sample_filter(table, u);
            EXPECT_NEAR(integrate(magnitude, -radius, sample.offset) / total, u, tolerance);
            const double value = evaluate_filter(filter, radius, sample.offset);
            EXPECT_GE(value * sample.weight, 0);
        }
    }
}

TEST(FilterTable, TriangleMatchesItsAnalyticInversion) {
    const FilterTable table = make_filter_table(filter_of(Kind::triangle, 2), 2);
    for (int i = 0; i < 1000; ++i) {
        const double u = i / 1000.0;
        const double exact = u < 0.5 ? 2 * (std::sqrt(2 * u) - 1) : 2 * (1 - std::sqrt(2 - 2 * u));
        EXPECT_NEAR(sample_filter(table, u).offset, exact, 1e-13);
    }
}

TEST(FilterTable, EndsAreFiniteAndInside) {
    for (Kind kind : {Kind::box, Kind::triangle, Kind::gaussian, Kind::mitchell}) {
        const FilterTable table = make_filter_table(filter_of(kind, 1.25), 1.25);
        EXPECT_EQ(table.cdf.front(), 0);
        EXPECT_NEAR(table.cdf.back(), 1, 1e-15);
        EXPECT_EQ(sample_filter(table, 0).offset, -1.25);
        for (double u : {0x1p-24, 0.5, 1 - 0x1p-24})
            EXPECT_LE(std::abs(sample_filter(table, u).offset), 1.25);
        EXPECT_NEAR(sample_filter(table, 0.5).offset, 0, 1e-14);
    }
}

TEST(FilterTable, MitchellMatchesPublishedValuesAndHasNegativeLobes) {
    PixelFilter filter = filter_of(Kind::mitchell, 2);
    EXPECT_NEAR(evaluate_filter(filter, 2, 0), 8.0 / 9, 1e-15); // (6 - 2 b) / 6 with b = 1/3
    EXPECT_NEAR(evaluate_filter(filter, 2, 1), 1.0 / 18, 1e-15);
    EXPECT_LT(evaluate_filter(filter, 2, 1.5), 0);
    EXPECT_NEAR(evaluate_filter(filter, 2, 2), 0, 1e-15);
    // It integrates to 1 per unit of x for every b and c.
    EXPECT_NEAR(integrate([&](double x) { return evaluate_filter(filter, 2, x); }, -2, 2), 1, 1e-6);
    const FilterTable table = make_filter_table(filter, 2);
    EXPECT_NEAR(evaluate_filter(filter, 2, table.sign_change), 0, 1e-15);
}

} // namespace
} // namespace tyndall

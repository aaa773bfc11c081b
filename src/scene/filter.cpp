#include "scene/filter.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

/// Mitchell and Netravali 1988, "Reconstruction filters in computer graphics", eq. 8; x in radii.
double mitchell(double b, double c, double x) {
    x = 2 * std::abs(x);
    if (x <= 1)
        return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + (6 - 2 * b)) /
               6;
    // Its second piece, in factors: no cancellation near x = 2, and the zero can be read off.
    return (2 - x) * (2 - x) * (b * (2 - x) - 6 * c * (x - 1)) / 6;
}

/// In radii; see the second piece of mitchell().
double mitchell_zero(double b, double c) {
    return c > 0 ? (b + 3 * c) / (b + 6 * c) : 1;
}

} // namespace

double evaluate_filter(const PixelFilter& filter, double radius, double x) {
    if (std::abs(x) > radius) return 0;
    switch (filter.kind) {
    case PixelFilter::Kind::box:
        return 1;
    case PixelFilter::Kind::triangle:
        return radius - std::abs(x);
    case PixelFilter::Kind::mitchell:
        return mitchell(filter.b, filter.c, x / radius);
    case PixelFilter::Kind::gaussian:
        break;
    }
    // The Gaussian less its value at the radius; no cancellation however wide it is.
    const double scale = 1 / (2 * filter.sigma * filter.sigma);
    return -std::exp(-x * x * scale) * std::expm1((x - radius) * (x + radius) * scale);
}

FilterTable make_filter_table(const PixelFilter& filter, double radius) {
    FilterTable table;
    table.radius = radius;
    table.sign_change = filter.kind == PixelFilter::Kind::mitchell
                            ? radius * mitchell_zero(filter.b, filter.c)
                            : radius;
    constexpr int n = FilterTable::cell_count;
    for (int i = 0; i <= n; ++i) {
        const double x = radius * (2 * i - n) / n;
        table.density[i] = std::abs(evaluate_filter(filter, radius, x));
    }
    for (int i = 0; i < n; ++i)
        table.cdf[i + 1] =
            table.cdf[i] + (table.density[i] + table.density[i + 1]) / 2 * table.width();
    const double total = table.cdf[n];
    for (int i = 0; i <= n; ++i) {
        table.density[i] /= total;
        table.cdf[i] /= total;
    }
    return table;
}

FilterSample sample_filter(const FilterTable& table, double u) {
    const auto above = std::upper_bound(table.cdf.begin() + 1, table.cdf.end() - 1, u);
    const auto cell = static_cast<std::size_t>(above - table.cdf.begin()) - 1;
    const double mass = u - table.cdf[cell];
    const double p0 = table.density[cell];
    const double p1 = table.density[cell + 1];
    // The mass of [0, t] is p0 t + (p1 - p0) t^2 / (2 width); the root that does not cancel.
    const double root = std::sqrt(std::max(0.0, p0 * p0 + 2 * mass * (p1 - p0) / table.width()));
    const double t = mass > 0 ? 2 * mass / (p0 + root) : 0;
    const double x = -table.radius + static_cast<double>(cell) * table.width() + t;
    return {x, std::abs(x) > table.sign_change ? -1.0 : 1.0};
}

} // namespace tyndall

/// Pixel filters as renderers need them: samples are drawn from |f| and weighted by the sign of f.
#pragma once

#include "scene/scene.h"

#include <array>

namespace tyndall {

/// The value of the filter along one axis, at a distance x from the pixel centre [pixels]; not
/// normalised. A filter is the product of both axes; beyond the radius it is 0.
/// Formulas: pbrt-v4 chapter 8.8 (the gaussian is G(x) - G(radius)).
double evaluate_filter(const PixelFilter& filter, double radius, double x);

/// One axis of |f| as a density over [-radius, radius] that is linear between equally spaced nodes.
/// Exact for box and triangle; for the others this polygon *is* the filter that is rendered with.
struct FilterTable {
    static constexpr int cell_count = 128;
    double radius = 0.5;
    std::array<double, cell_count + 1> density{}; ///< At -radius + i * width(); integral 1.
    std::array<double, cell_count + 1> cdf{};     ///< Integral up to there; cdf[0] = 0, last = 1.
    /// Samples with |x| above this have weight -1, others +1 (mitchell; else the radius).
    double sign_change = 0.5;

    double width() const { return 2 * radius / cell_count; }
};

/// The table of one axis; radius is filter.x_radius or filter.y_radius.
/// Needs b >= 0 and c >= 0 of a mitchell filter: then it changes its sign once on each side.
FilterTable make_filter_table(const PixelFilter& filter, double radius);

struct FilterSample {
    double offset; ///< From the pixel centre, in [-radius, radius].
    double weight; ///< +1 or -1: the sign of the filter there.
};

/// Inverts the CDF of the table exactly; u in [0, 1).
FilterSample sample_filter(const FilterTable& table, double u);

} // namespace tyndall

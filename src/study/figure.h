/// Plots: values that gnuplot turns into SVG for the report.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tyndall::study {

struct FigurePoint {
    double x = 0;
    double y = 0, low = 0, high = 0; ///< With the ends of its interval.
};

struct FigureSeries {
    std::string label;
    int colour = 0; ///< 0: that of the baseline; 1 ... 6: others, in the order of the style sheet.
    std::vector<FigurePoint> points;
    std::optional<double> floor; ///< A dashed line: where its error ends.
};

/// Both axes are logarithmic.
struct Figure {
    std::string id;    ///< For ids in the page: letters and digits.
    std::string title; ///< What it shows.
    std::string alt;   ///< The same for who does not see it.
    std::string x_label, y_label;
    bool is_percent = true;   ///< y are fractions, shown as percent.
    bool is_doubling = false; ///< x are powers of two.
    std::vector<FigureSeries> series;
};

/// Each figure as <svg> elements for a wide page and for a narrow one. Colours are custom
/// properties of the page: --s0 ... --s6, --axis, --grid, --text, --card.
struct DrawnFigure {
    std::string wide, narrow;
};

/// @throws Error failed: gnuplot is not installed (and says which package has it), or fails.
std::vector<DrawnFigure> draw_figures(std::span<const Figure> figures);

} // namespace tyndall::study

#include "study/figure.h"

#include "core/error.h"
#include "study/gnuplot.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <regex>

namespace tyndall::study {
namespace {

struct Range {
    double low = 1e300, high = 0;
    void add(double value) {
        if (!(value > 0)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    /// With some room on both sides, at least a factor of 3 wide.
    Range padded() const {
        if (!(high > 0)) return {0.1, 10};
        const double room = std::max(std::pow(high / low, 0.04), std::sqrt(3 * low / high));
        return {low / room, high * room};
    }
};

/// Marks at powers of ten, with as many between them as the axis is short.
std::string marks(const Range& range, const char* unit) {
    static const std::vector<double> few{1}, some{1, 2, 5}, many{1, 1.5, 2, 2.5, 3, 4, 5, 6, 8};
    const double span = range.high / range.low;
    std::string text;
    for (int power = static_cast<int>(std::floor(std::log10(range.low)));
         power <= static_cast<int>(std::ceil(std::log10(range.high))); ++power)
        for (const double digit : span > 300 ? few : span > 6 ? some : many) {
            const double at = digit * std::pow(10.0, power);
            if (at < range.low || at > range.high) continue;
            text += fmt::format("{}\"{:.6g}{}\" {:.10g}", text.empty() ? "" : ", ", at, unit, at);
        }
    return text;
}

/// Marks at powers of two, or of four.
std::string doubling_marks(const Range& range) {
    const double step = range.high / range.low > 200 ? 4 : 2;
    std::string text;
    for (double at = 1; at <= range.high; at *= step)
        if (at >= range.low)
            text += fmt::format("{}\"{:g}\" {:g}", text.empty() ? "" : ", ", at, at);
    return text;
}

double clamped(double value, const Range& range) {
    return std::clamp(value, range.low, range.high);
}

/// The data of a figure as gnuplot's data blocks, and the plot command for them.
std::string plot_text(const Figure& figure, double scale, const Range& x, const Range& y) {
    std::string blocks, plots;
    for (std::size_t i = 0; i < figure.series.size(); ++i) {
        const FigureSeries& series = figure.series[i];
        const std::string colour = fmt::format("lc rgb '#0100{:02x}'", series.colour);
        blocks += fmt::format("$points{} << END\n", i);
        for (const FigurePoint& p : series.points)
            if (p.y > 0 && p.x > 0)
                blocks += fmt::format("{:.8g} {:.8g} {:.8g} {:.8g}\n", p.x, scale * p.y,
                                      clamped(scale * p.low, y), clamped(scale * p.high, y));
        blocks += "END\n";
        if (series.floor) {
            blocks += fmt::format("$floor{0} << END\n{1:.8g} {3:.8g}\n{2:.8g} {3:.8g}\nEND\n", i,
                                  x.low, x.high, scale * *series.floor);
            plots += fmt::format(", $floor{} with lines {} lw 1.2 dt 2", i, colour);
        }
        constexpr std::array<int, 7> symbols{7, 5, 9, 13, 11, 4, 6};
        plots += fmt::format(", $points{0} with lines {1} lw 2, $points{0} using 1:2:3:4 with "
                             "yerrorbars {1} lw 1.2 pt {2} ps 0.55",
                             i, colour, symbols[static_cast<std::size_t>(series.colour) % 7]);
    }
    return blocks + "plot NaN" + plots + "\n";
}

std::string script(const Figure& figure, int width, int height) {
    const double scale = figure.is_percent ? 100 : 1;
    Range x, y;
    for (const FigureSeries& series : figure.series) {
        for (const FigurePoint& p : series.points)
            x.add(p.x), y.add(scale * p.y);
        y.add(scale * series.floor.value_or(0));
    }
    x = x.padded(), y = y.padded();
    std::string text = fmt::format("reset session\nset terminal svg size {},{} dynamic "
                                   "font 'sans-serif,13'\nset logscale xy\nunset key\n",
                                   width, height);
    text += "set border 3 lc rgb '#0000dd'\nset tics nomirror\nunset mxtics\nunset mytics\n"
            "set grid xtics ytics lt 1 lw 0.6 lc rgb '#0000ee'\n";
    text += fmt::format("set xrange [{:.8g}:{:.8g}]\nset yrange [{:.8g}:{:.8g}]\n", x.low, x.high,
                        y.low, y.high);
    text += fmt::format("set xtics ({})\nset ytics ({})\n",
                        figure.is_doubling ? doubling_marks(x) : marks(x, ""),
                        marks(y, figure.is_percent ? " %%" : ""));
    text += fmt::format("set xlabel '{}'\nset ylabel '{}'\n", figure.x_label, figure.y_label);
    return text + plot_text(figure, scale, x, y);
}

std::string replaced(std::string text, const char* pattern, const std::string& by) {
    return std::regex_replace(text, std::regex(pattern), by);
}

/// gnuplot's document as an element of the page: colours by the style sheet, ids of its own.
std::string to_element(std::string svg, const Figure& figure, const std::string& id) {
    svg.erase(0, svg.find("<svg"));
    svg = replaced(svg, "<title>[^<]*</title>|<desc>[^<]*</desc>", "");
    svg = replaced(svg, "rgb\\( *1, *0, *(\\d+)\\)", "var(--s$1)");
    svg = replaced(svg, "rgb\\( *0, *0, *221\\)", "var(--axis)");
    svg = replaced(svg, "rgb\\( *0, *0, *238\\)", "var(--grid)");
    svg = replaced(svg, "color='white'", "color='var(--card)'"); // a rim around each point
    svg = replaced(svg, "fill=\"black\"", "fill=\"var(--text)\"");
    svg = replaced(svg, " font-family=\"sans-serif\"", "");
    svg = replaced(svg, "id=(['\"])", "id=$1" + id + "-");
    svg = replaced(svg, "href='#", "href='#" + id + "-");
    const std::string opening = fmt::format("<svg role=\"img\" aria-label=\"{}\"", figure.alt);
    return opening + svg.substr(4);
}

} // namespace

std::vector<DrawnFigure> draw_figures(std::span<const Figure> figures) {
    std::string text;
    for (const Figure& figure : figures)
        text += script(figure, 760, 430) + script(figure, 380, 340);
    const std::string drawn = run_gnuplot(text);
    std::vector<std::string> documents;
    for (std::size_t at = drawn.find("<?xml"); at != std::string::npos;) {
        const std::size_t next = drawn.find("<?xml", at + 1);
        documents.push_back(drawn.substr(at, next - at));
        at = next;
    }
    if (documents.size() != 2 * figures.size())
        throw Error(ExitStatus::failed, "gnuplot drew fewer plots than were asked for");
    std::vector<DrawnFigure> result;
    for (std::size_t i = 0; i < figures.size(); ++i)
        result.push_back({to_element(documents[2 * i], figures[i], figures[i].id + "w"),
                          to_element(documents[2 * i + 1], figures[i], figures[i].id + "n")});
    return result;
}

} // namespace tyndall::study

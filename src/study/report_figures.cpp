#include "study/report_figures.h"

#include "study/html.h"
#include "study/sentences.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace tyndall::study {
namespace {

constexpr std::size_t kMostSeries = 7;

/// The baseline has colour 0, others those that follow.
void add_series(Figure& figure, FigureSeries series, bool is_baseline) {
    series.colour = is_baseline ? 0 : 1;
    for (const FigureSeries& other : figure.series)
        if (other.colour >= series.colour && !is_baseline) series.colour = other.colour + 1;
    figure.series.push_back(std::move(series));
}

FigureSeries error_series(const TechniqueResult& t, double (*x)(const Level&)) {
    FigureSeries series{.label = t.title};
    for (const Level& level : t.levels) {
        const Bounds b = bounds(level.error);
        if (b.value > 0) series.points.push_back({x(level), b.value, b.low, b.high});
    }
    const Bounds bias = bounds(t.last().bias);
    if (!t.is_unbiased && bias.is_told()) series.floor = bias.value;
    return series;
}

std::string title_of_series(const std::string& series) {
    if (series == "march-uniform") return "uniform steps";
    if (series == "march-jittered") return "jittered steps";
    if (series == "march-equiangular") return "equiangular steps";
    if (series == "volpath-marched") return "volpath, shadows marched";
    return "scattering events";
}

} // namespace

std::vector<const TechniqueResult*> leading(const Results& results,
                                            const std::vector<Choice>& choices) {
    std::vector<const TechniqueResult*> list;
    const auto add = [&](const TechniqueResult* t) {
        if (t && t->is_measured() && list.size() < 6 &&
            std::find(list.begin(), list.end(), t) == list.end())
            list.push_back(t);
    };
    add(results.find(kBaseline));
    for (const Choice& choice : choices)
        if (choice.time.is_finite()) add(choice.technique);
    const auto marches = of_series(results, "march-uniform");
    if (!marches.empty()) add(marches.back());
    for (const char* name :
         {"march-uniform-16", "orders-1", "orders-4", "volpath-no-light-sampling", "volpath-analog",
          "volpath-sobol", "volpath-independent"})
        add(results.find(name));
    return list;
}

Figure time_figure(const std::vector<const TechniqueResult*>& techniques, std::string id,
                   std::string title) {
    Figure figure{.id = std::move(id),
                  .title = std::move(title),
                  .x_label = "time of rendering [s]",
                  .y_label = "relative RMSE"};
    for (const TechniqueResult* t : techniques)
        if (figure.series.size() < kMostSeries)
            add_series(figure, error_series(*t, [](const Level& l) { return l.seconds; }),
                       t->name == kBaseline);
    figure.alt =
        figure.title + ": error against time on logarithmic axes, one line for each technique";
    return figure;
}

Figure samples_figure(const std::vector<const TechniqueResult*>& techniques) {
    Figure figure{.id = "samples",
                  .title = "Error against samples",
                  .x_label = "samples of each pixel",
                  .y_label = "relative RMSE",
                  .is_doubling = true};
    for (const TechniqueResult* t : techniques) {
        FigureSeries series =
            error_series(*t, [](const Level& l) { return static_cast<double>(l.samples); });
        if (const auto fit = fit_noise(*t)) series.label += ": noise, slope " + told(fit);
        add_series(figure, std::move(series), t->name == kBaseline);
    }
    figure.alt = "Error against samples on logarithmic axes, one line for each technique";
    return figure;
}

Figure bias_figure(const Results& results, const std::vector<std::string>& names, std::string id,
                   std::string title, std::string x_label) {
    Figure figure{.id = std::move(id),
                  .title = std::move(title),
                  .x_label = std::move(x_label),
                  .y_label = "bias, relative",
                  .is_doubling = true};
    for (const std::string& name : names) {
        FigureSeries series{.label = title_of_series(name)};
        for (const TechniqueResult* t : of_series(results, name)) {
            const Bounds b = bounds(t->last().bias);
            if (b.is_told()) series.points.push_back({t->parameter, b.value, b.low, b.high});
        }
        if (!series.points.empty()) add_series(figure, std::move(series), false);
    }
    figure.alt = figure.title + ": bias against " + figure.x_label + " on logarithmic axes";
    return figure;
}

Figure cells_figure(const Results& results) {
    Figure figure{.id = "cells",
                  .title = "What majorant cells cost",
                  .alt = "Time of a sample against the size of majorant cells",
                  .x_label = "edge of a cell [voxels]",
                  .y_label = "time of a sample, over that of volpath",
                  .is_percent = false,
                  .is_doubling = true};
    FigureSeries series{.label = "cells of one size; dashed: those that are chosen by themselves",
                        .floor = 1};
    for (const TechniqueResult* t : of_series(results, "cells")) {
        const double cost = relative_cost(results, *t);
        series.points.push_back({t->parameter, cost, cost, cost});
    }
    add_series(figure, std::move(series), false);
    return figure;
}

bool has_points(const Figure& figure) {
    return std::any_of(figure.series.begin(), figure.series.end(),
                       [](const FigureSeries& s) { return s.points.size() > 1; });
}

std::string legend(const Figure& figure) {
    // As gnuplot's symbols, in the order of figure.cpp.
    constexpr std::array<const char*, 7> symbols{
        "<circle cx='14' cy='7' r='3.4'/>",
        "<rect x='11' y='4' width='6' height='6'/>",
        "<path d='M14 2.6 L18 9.6 L10 9.6 z'/>",
        "<path d='M14 2.5 L18.5 7 L14 11.5 L9.5 7 z'/>",
        "<path d='M14 11.4 L18 4.4 L10 4.4 z'/>",
        "<rect x='11' y='4' width='6' height='6' fill='none'/>",
        "<circle cx='14' cy='7' r='3.4' fill='none'/>"};
    std::string items;
    for (const FigureSeries& s : figure.series)
        items += fmt::format("<li><svg class=\"swatch\" viewBox=\"0 0 28 14\" aria-hidden=\"true\" "
                             "stroke=\"var(--s{0})\" fill=\"var(--s{0})\"><path d='M0 7H28' "
                             "stroke-width='2'/>{1}</svg>{2}</li>",
                             s.colour, symbols[static_cast<std::size_t>(s.colour) % 7], s.label);
    return "<ul class=\"legend\">" + items + "</ul>\n";
}

} // namespace tyndall::study

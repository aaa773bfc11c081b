#include "study/analysis.h"

#include "stats/distributions.h"

#include <algorithm>
#include <cmath>

namespace tyndall::study {
namespace {

struct Point {
    double x, y, y_sd; ///< y > 0
};

/// Least squares in logarithms, each point by its own deviation.
std::optional<Fit> fit_power(const std::vector<Point>& points) {
    if (points.size() < 3) return std::nullopt;
    double w = 0, wx = 0, wy = 0, wxx = 0, wxy = 0;
    for (const Point& p : points) {
        const double sd = std::max(p.y_sd / p.y, 1e-6), weight = 1 / (sd * sd);
        const double x = std::log(p.x), y = std::log(p.y);
        w += weight, wx += weight * x, wy += weight * y;
        wxx += weight * x * x, wxy += weight * x * y;
    }
    const double determinant = w * wxx - wx * wx;
    if (!(determinant > 0)) return std::nullopt;
    Fit fit{.slope = (w * wxy - wx * wy) / determinant, .points = points.size()};
    fit.factor = std::exp((wy - fit.slope * wx) / w);
    double chi_squared = 0; // points that scatter more than their deviations say widen the interval
    for (const Point& p : points) {
        const double residual = std::log(p.y / fit.factor) - fit.slope * std::log(p.x);
        chi_squared += std::pow(residual / std::max(p.y_sd / p.y, 1e-6), 2);
    }
    const double excess = std::max(1.0, chi_squared / static_cast<double>(points.size() - 2));
    fit.slope_sd = std::sqrt(w / determinant * excess);
    return fit;
}

/// The root of a square, and its deviation; nothing where it cannot be told from 0.
void add_root(std::vector<Point>& points, double x, const Estimate& square) {
    if (!(square.value > kInterval * square.sd) || !(x > 0)) return;
    const double root = std::sqrt(square.value);
    points.push_back({x, root, square.sd / (2 * root)});
}

/// Seconds of a run with so many samples.
double seconds_of(const TechniqueResult& t, double samples) {
    const std::vector<Level>& levels = t.levels;
    if (samples <= levels.front().samples) return levels.front().seconds;
    if (samples >= levels.back().samples)
        return levels.back().seconds + (samples - levels.back().samples) * t.seconds_per_sample;
    std::size_t i = 1;
    while (levels[i].samples < samples)
        ++i;
    const Level &a = levels[i - 1], &b = levels[i];
    return a.seconds +
           (b.seconds - a.seconds) * (samples - a.samples) / double(b.samples - a.samples);
}

/// By how much the time of a technique may seem shorter than that of another without being so, as
/// far as noise was measured; 10 % at least, for the clock.
double doubt(const TechniqueResult& a, const TechniqueResult& b) {
    const auto deviation = [](const Estimate& e) { return e.value > 0 ? e.sd / e.value : 0; };
    return std::clamp(kInterval * std::hypot(deviation(a.last().noise), deviation(b.last().noise)),
                      0.1, 1.0);
}

} // namespace

Bounds bounds(const Estimate& square) {
    const auto root = [](double s) { return std::sqrt(std::max(0.0, s)); };
    return {root(square.value), root(square.value - kInterval * square.sd),
            root(std::max(0.0, square.value) + kInterval * square.sd)};
}

std::optional<Fit> fit_noise(const TechniqueResult& technique) {
    std::vector<Point> points;
    for (const Level& level : technique.levels)
        add_root(points, level.slice_samples, level.slice_noise);
    return fit_power(points);
}

std::optional<Fit> fit_error(const TechniqueResult& technique) {
    std::vector<Point> points;
    for (const Level& level : technique.levels)
        add_root(points, level.seconds, level.error);
    return fit_power(points);
}

std::optional<Fit> fit_bias(const std::vector<const TechniqueResult*>& series) {
    std::vector<Point> points;
    for (const TechniqueResult* t : series)
        add_root(points, t->parameter, t->last().bias);
    return fit_power(points);
}

TimeTo time_to(const TechniqueResult& t, double accuracy) {
    const Level& last = t.last();
    const Bounds bias = bounds(last.bias);
    const double square = accuracy * accuracy;
    double bias_square = 0;
    if (!t.is_unbiased) {
        bias_square = std::max(0.0, last.bias.value);
        if (bias.is_told() && square <= bias_square) return {.kind = TimeTo::Kind::never};
        if (!bias.is_told() && accuracy <= bias.high) return {.kind = TimeTo::Kind::unknown};
    }
    const double samples =
        std::max(1.0, std::ceil(last.noise.value * last.samples / (square - bias_square)));
    return {.kind = samples <= last.samples ? TimeTo::Kind::measured : TimeTo::Kind::extrapolated,
            .seconds = seconds_of(t, samples),
            .samples = samples};
}

std::vector<const TechniqueResult*> contenders(const Results& results) {
    std::vector<const TechniqueResult*> list;
    for (const TechniqueResult& t : results.techniques)
        if (t.is_measured() && t.family != family_name(Family::without)) list.push_back(&t);
    return list;
}

std::vector<const TechniqueResult*> of_family(const Results& results, Family family) {
    std::vector<const TechniqueResult*> list;
    for (const TechniqueResult& t : results.techniques)
        if (t.is_measured() && t.family == family_name(family)) list.push_back(&t);
    return list;
}

std::vector<const TechniqueResult*> of_series(const Results& results, const std::string& series) {
    std::vector<const TechniqueResult*> list;
    for (const TechniqueResult& t : results.techniques)
        if (t.is_measured() && t.series == series) list.push_back(&t);
    std::sort(list.begin(), list.end(),
              [](auto* a, auto* b) { return a->parameter < b->parameter; });
    return list;
}

std::vector<Choice> choose(const Results& results) {
    const TechniqueResult* baseline = results.find(kBaseline);
    if (baseline && !baseline->is_measured()) baseline = nullptr;
    std::vector<Choice> choices;
    for (const double accuracy : kAccuracies) {
        Choice choice{.accuracy = accuracy, .technique = baseline};
        if (baseline) choice.baseline = choice.time = time_to(*baseline, accuracy);
        for (const TechniqueResult* t : contenders(results)) {
            const TimeTo time = time_to(*t, accuracy);
            if (!time.is_finite() ||
                (choice.time.is_finite() && time.seconds >= choice.time.seconds))
                continue;
            if (baseline && time.seconds > (1 - doubt(*t, *baseline)) * choice.baseline.seconds)
                continue;
            choice.technique = t, choice.time = time;
        }
        choices.push_back(choice);
    }
    return choices;
}

Agreement test_unbiased(const Results& results) {
    constexpr double false_alarm_rate = 1e-3;
    Agreement agreement;
    for (const TechniqueResult* t : contenders(results))
        if (t->is_unbiased) agreement.techniques.push_back(t);
    const double tests = 2 * static_cast<double>(agreement.techniques.size());
    const auto p_value = [](const Estimate& e) {
        return e.sd > 0 ? stats::normal_two_sided(e.value / e.sd) : 1.0;
    };
    for (const TechniqueResult* t : agreement.techniques) {
        const double p =
            stats::least_of(std::min(p_value(t->last().bias), p_value(t->brightness)), tests);
        agreement.p_values.push_back(p);
        agreement.agrees = agreement.agrees && p >= false_alarm_rate;
    }
    return agreement;
}

} // namespace tyndall::study

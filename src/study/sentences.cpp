#include "study/sentences.h"

#include "study/html.h"

#include <algorithm>
#include <fmt/format.h>

namespace tyndall::study {
namespace {

std::string strong(const std::string& text) {
    return fmt::format("<strong>{}</strong>", text);
}

/// Choices next to each other that fall on the same technique.
struct Stretch {
    const TechniqueResult* technique;
    std::size_t first, last;
};

std::vector<Stretch> stretches(const std::vector<Choice>& choices) {
    std::vector<Stretch> list;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if (!choices[i].time.is_finite()) continue;
        if (!list.empty() && list.back().technique == choices[i].technique)
            list.back().last = i;
        else
            list.push_back({choices[i].technique, i, i});
    }
    return list;
}

std::string stretch_text(const Stretch& s, const std::vector<Choice>& choices) {
    const Choice &first = choices[s.first], &last = choices[s.last];
    std::string text =
        s.first == s.last
            ? fmt::format("For an error of {} choose {}: {}", accuracy_text(first.accuracy),
                          strong(s.technique->title), told(first.time))
            : fmt::format("For errors from {} down to {} choose {}: {} to {}, {} to {}",
                          accuracy_text(first.accuracy), accuracy_text(last.accuracy),
                          strong(s.technique->title), told(first.time),
                          accuracy_text(first.accuracy), told(last.time),
                          accuracy_text(last.accuracy));
    if (s.technique->name != kBaseline && first.baseline.is_finite())
        text += fmt::format(", where volpath takes {}", told(first.baseline));
    return text + ".";
}

/// The ends of the range of a value over techniques.
template<typename Value>
std::pair<double, double> range_of(const std::vector<const TechniqueResult*>& list,
                                   const Value& value) {
    std::pair<double, double> range{1e300, 0};
    for (const TechniqueResult* t : list) {
        range.first = std::min(range.first, value(*t));
        range.second = std::max(range.second, value(*t));
    }
    return range;
}

const TechniqueResult* most_steps(const Results& results, const char* series) {
    const auto list = of_series(results, series);
    return list.empty() ? nullptr : list.back();
}

} // namespace

std::string headline(const Results& results, const std::vector<Choice>& choices) {
    const std::vector<Stretch> list = stretches(choices);
    if (list.empty())
        return "No technique was measured well enough to tell what to choose: give a larger "
               "budget.";
    std::string text;
    if (list.size() == 1 && list[0].technique->name == kBaseline) {
        std::vector<std::string> times;
        for (const Choice& choice : choices)
            times.push_back(told(choice.time) + " to " + accuracy_text(choice.accuracy));
        text = fmt::format("Choose {}: nothing that was tried is cheaper, whatever the accuracy. "
                           "It takes {}.",
                           strong("volpath"), listed(times));
    } else {
        for (const Stretch& s : list)
            text += fmt::format("{}{}", text.empty() ? "" : " ", stretch_text(s, choices));
    }
    if (const TechniqueResult* march = most_steps(results, "march-uniform"))
        if (bounds(march->last().bias).is_told())
            text += fmt::format(" Single scattering by marching stops at {}, however long it runs.",
                                percent(bounds(march->last().bias).value));
    return text;
}

std::string agreement_sentence(const Agreement& agreement) {
    if (agreement.techniques.empty()) return "No unbiased technique was measured.";
    double least = 1;
    std::vector<std::string> different;
    for (std::size_t i = 0; i < agreement.techniques.size(); ++i) {
        least = std::min(least, agreement.p_values[i]);
        if (agreement.p_values[i] < 1e-3)
            different.push_back(strong(agreement.techniques[i]->title));
    }
    if (!different.empty())
        return fmt::format("{} should be unbiased but {} not have the expectation of the reference "
                           "(p = {:.1g}, corrected for all tests): {} or the reference is wrong.",
                           listed(different), different.size() == 1 ? "does" : "do", least,
                           different.size() == 1 ? "it" : "they");
    const std::size_t n = agreement.techniques.size();
    return fmt::format(
        "{} unbiased by construction, and what was measured agrees with that: brightness is that "
        "of the reference within its interval, and no bias can be told from none (smallest p = "
        "{:.2g}, corrected for {} tests).",
        n == 1 ? fmt::format("{} is", strong(agreement.techniques[0]->title))
               : fmt::format("The {} techniques of this table are", count(n)),
        least, 2 * n);
}

std::string slope_sentence(const Results& results) {
    const TechniqueResult* baseline = results.find(kBaseline);
    if (!baseline || !baseline->is_measured()) return "";
    const Level &first = baseline->levels.front(), &last = baseline->last();
    std::string text = fmt::format("After {} sample{} of each pixel the picture of volpath is "
                                   "wrong by {}, after {} samples by "
                                   "{}.",
                                   first.samples, first.samples == 1 ? "" : "s",
                                   percent(bounds(first.error).value), last.samples,
                                   percent(bounds(last.error).value));
    if (const auto fit = fit_noise(*baseline))
        text += fmt::format(" Its noise falls with the power {} of the samples; theory says "
                            "-0.5: half the error costs four times the samples.",
                            told(fit));
    return text;
}

std::string marching_sentence(const Results& results) {
    const auto uniform = of_series(results, "march-uniform");
    if (uniform.empty()) return "";
    const TechniqueResult& last = *uniform.back();
    std::string text = fmt::format(
        "Marching looks at a ray at fixed steps and lets light scatter once at each. With {} "
        "uniform step{} its bias is {}, with {} steps {}.",
        uniform.front()->parameter, uniform.front()->parameter == 1 ? "" : "s",
        told(uniform.front()->last().bias), last.parameter, told(last.last().bias));
    if (bounds(last.last().bias).is_told())
        text += " More samples do not make that smaller: it is the floor on which the curves end. "
                "What more steps do not take away either is light that scatters more than once.";
    if (const auto fit = fit_bias(uniform); fit && fit->slope + kInterval * fit->slope_sd < -0.3)
        text += fmt::format(" Over all step counts it falls with the power {} of the steps.",
                            told(fit));
    return text;
}

std::string orders_sentence(const Results& results) {
    const auto list = of_series(results, "orders");
    if (list.empty()) return "";
    std::string text = fmt::format(
        "A path that ends after {} scattering event{} misses what more of them would bring: the "
        "picture is wrong by {}.",
        count(static_cast<std::size_t>(list[0]->parameter)), list[0]->parameter == 1 ? "" : "s",
        told(list[0]->last().bias));
    const auto untold = std::find_if(list.begin(), list.end(), [](const TechniqueResult* t) {
        return !bounds(t->last().bias).is_told();
    });
    if (list.size() == 1) return text;
    return text + (untold == list.end()
                       ? fmt::format(" With {:g}, {} is still missing.", list.back()->parameter,
                                     told(list.back()->last().bias))
                       : fmt::format(" From {:g} on, nothing that is missing could be told.",
                                     (*untold)->parameter));
}

double relative_cost(const Results& results, const TechniqueResult& technique) {
    const TechniqueResult* baseline = results.find(kBaseline);
    if (!baseline || !baseline->is_measured()) return 1;
    return technique.seconds_per_sample / baseline->seconds_per_sample;
}

std::string cells_sentence(const Results& results) {
    const auto list = of_series(results, "cells");
    if (list.empty() || !results.find(kBaseline)) return "";
    const auto [least, most] =
        range_of(list, [&](const TechniqueResult& t) { return relative_cost(results, t); });
    return fmt::format(
        "Tracking needs an upper bound of the density in each cell. Cells are chosen "
        "when a scene is read; with the other sizes a sample costs from {:.2f} to "
        "{:.2f} times as much. The picture is the same.",
        least, most);
}

} // namespace tyndall::study

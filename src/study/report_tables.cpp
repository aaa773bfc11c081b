#include "study/report_tables.h"

#include "study/html.h"
#include "study/sentences.h"

#include <cmath>
#include <fmt/format.h>

namespace tyndall::study {
namespace {

/// "1.0004 ± 0.0011": brightness over that of the reference.
std::string brightness(const Estimate& e) {
    const double half = kInterval * e.sd;
    const int digits =
        half > 0 ? std::max(0, 1 - static_cast<int>(std::floor(std::log10(half)))) : 6;
    return fmt::format("{0:.{2}f}\u00a0± {1:.{2}f}", 1 + e.value, half, std::min(digits, 7));
}

std::string bar(double share) {
    return fmt::format("<span class=\"bar\" style=\"width:{:.1f}%\"></span>",
                       100 * std::clamp(share, 0.0, 1.0));
}

} // namespace

std::string choice_table(const std::vector<Choice>& choices) {
    Table table("The cheapest technique for each accuracy",
                {"Error", "Cheapest", "Its time", "volpath"});
    for (const Choice& c : choices) {
        const bool is_reached = c.technique && c.time.is_finite();
        table.add({accuracy_text(c.accuracy), is_reached ? c.technique->title : "none",
                   is_reached ? told(c.time) : "", c.baseline.is_finite() ? told(c.baseline) : ""});
    }
    return table.html() +
           element(
               "p",
               "≈: extrapolated beyond the longest run, at its pace. Others lie within what was "
               "measured. A technique is named before volpath only if it is 10\u00a0% cheaper, and "
               "cheaper than its interval is wide.",
               "note");
}

std::string agreement_table(const Agreement& agreement) {
    Table table("Unbiased techniques against the reference",
                {"Technique", "Brightness, reference = 1", "Bias", "p, corrected", "Verdict"});
    for (std::size_t i = 0; i < agreement.techniques.size(); ++i) {
        const TechniqueResult& t = *agreement.techniques[i];
        table.add({t.title, brightness(t.brightness), told(t.last().bias),
                   fmt::format("{:.2g}", agreement.p_values[i]),
                   agreement.p_values[i] < 1e-3 ? "<strong>differs</strong>" : "agrees"});
    }
    return table.html();
}

std::string bias_table(const Results& results, std::string caption, std::string parameter,
                       const std::vector<std::pair<std::string, std::string>>& series) {
    std::vector<std::string> columns{std::move(parameter)};
    std::map<double, std::vector<std::string>> rows;
    for (const auto& [name, column] : series) {
        const auto list = of_series(results, name);
        if (list.empty()) continue;
        columns.push_back(column);
        for (const TechniqueResult* t : list) {
            std::vector<std::string>& row = rows[t->parameter];
            row.resize(columns.size() - 2);
            row.push_back(told(t->last().bias));
        }
    }
    Table table(std::move(caption), columns);
    for (auto& [value, row] : rows) {
        row.resize(columns.size() - 1);
        row.insert(row.begin(), fmt::format("{:g}", value));
        table.add(row);
    }
    return table.html();
}

std::string factors_table(const Results& results, Family family, std::string caption) {
    const TechniqueResult* baseline = results.find(kBaseline);
    if (!baseline || !baseline->is_measured()) return "";
    Table table(std::move(caption), {"Technique", "Time of a sample", "Samples for the same noise",
                                     "Time for the same noise", "Bias"});
    const auto noise = [](const TechniqueResult& t) { // of one sample, squared
        return t.last().noise.value * t.last().samples;
    };
    for (const TechniqueResult* t : of_family(results, family)) {
        if (t == baseline) continue;
        const double cost = relative_cost(results, *t), samples = noise(*t) / noise(*baseline);
        table.add({t->title, fmt::format("x {:.2f}", cost), fmt::format("x {:.2f}", samples),
                   fmt::format("x {:.2f}", cost * samples),
                   t->is_unbiased ? "unbiased" : told(t->last().bias)});
    }
    return table.html();
}

std::string effects_table(const Results& results) {
    Table table("Cost of each effect",
                {"Left out", "A sample then takes", "Share of the time that it costs", "",
                 "The picture changes by"});
    for (const TechniqueResult* t : of_family(results, Family::without)) {
        const double share = 1 - relative_cost(results, *t);
        table.add({t->title, duration(t->seconds_per_sample),
                   share > 0.005 ? percent(share) : "none", bar(share), told(t->last().bias)});
    }
    return table.html();
}

std::string techniques_table(const Results& results) {
    std::vector<std::string> columns{
        "Technique",           "Samples",        "Time of a sample",   "Time of a render besides",
        "Noise of one sample", "Slope of noise", "Slope against time", "Bias"};
    for (const double accuracy : kAccuracies)
        columns.push_back("to " + accuracy_text(accuracy));
    Table table("Everything that was measured", columns);
    std::string problems;
    for (const TechniqueResult& t : results.techniques) {
        if (!t.is_measured()) {
            problems += element("li", "<strong>" + t.title + "</strong>: " + escaped(t.problem));
            continue;
        }
        const std::string title =
            t.family == family_name(Family::without) ? "without " + t.title : t.title;
        const std::string name = title + "<br><code>" + t.name + "</code>";
        std::vector<std::string> cells{
            name,
            std::to_string(t.last().samples),
            duration(t.seconds_per_sample),
            t.seconds_per_render > 0 ? duration(t.seconds_per_render) : "",
            percent(std::sqrt(std::max(0.0, t.last().noise.value) * t.last().samples)),
            told(fit_noise(t)),
            told(fit_error(t)),
            told(t.last().bias)};
        for (const double accuracy : kAccuracies)
            cells.push_back(told(time_to(t, accuracy)));
        table.add(cells);
        for (const auto& [kind, number] : t.health)
            problems += element("li", fmt::format("<strong>{}</strong>: {} contributions were "
                                                  "dropped ({})",
                                                  t.title, number, kind));
    }
    return table.html() + (problems.empty() ? "" : element("ul", problems, "note"));
}

std::string time_text(const Results& results) {
    if (results.processors == 0) return "Times are those of rendering, by the clock.";
    return fmt::format("Times are processor time over the number of processors, {}: what the clock "
                       "shows when nothing else runs. (The clock's own are in results.json.)",
                       results.processors);
}

std::string method_text(const Results& results) {
    const std::string reference =
        results.reference.file.empty()
            ? fmt::format("The reference is volpath itself, with {} samples of each pixel that no "
                          "technique uses, made in {}; its error is {}. That is taken off what is "
                          "measured against it.",
                          results.reference.samples, duration(results.reference.seconds),
                          told(results.reference.error))
            : fmt::format("The reference is the file {}. The variance that it states is taken off "
                          "what is measured against it; if it states none, it is taken for exact.",
                          escaped(results.reference.file));
    return element("p", reference) +
           element(
               "p",
               "Noise is the scatter of four independent pictures about their mean; bias is the "
               "distance of their mean from the reference, without the share that noise has in "
               "it; an error has both. Intervals hold 95\u00a0% of the time. A bias whose "
               "interval reaches zero is given as what it is below. Slopes of noise are fitted "
               "to samples that no two points share; theory says -0.5 for all of them. Slopes "
               "against time are steeper at first, since every render also waits for its last "
               "paths, and flatter where bias is reached.") +
           element("p", time_text(results) +
                            " Reading the scene and compiling are left out; they are "
                            "in the table below and in results.json.");
}

std::string provenance_table(const Results& results) {
    Table table("What was run", {"", ""});
    const auto row = [&](const char* name, const std::string& value) { table.add({name, value}); };
    row("Scene", escaped(results.scene));
    row("SHA-256 of its files", "<code>" + results.sha256 + "</code>");
    row("Picture", fmt::format("{} (the scene asks for {} x {}), depth {}", results.part,
                               results.scene_width, results.scene_height, results.max_depth));
    std::vector<std::string> effects;
    for (const std::string& effect : results.effects)
        effects.push_back(escaped(effect));
    row("What it calls for", listed(effects));
    row("Device", escaped(results.device + ", " + results.driver));
    row("Seed", std::to_string(results.seed));
    row("Budget", duration(results.budget_seconds) + ", of which " +
                      duration(results.scene_seconds) + " to read the scene");
    if (const TechniqueResult* t = results.find(kBaseline))
        row("Before the first sample of volpath",
            fmt::format("{} for tables and hierarchy, {} to compile, {} for a first sample",
                        duration(t->build_seconds), duration(t->compile_seconds),
                        duration(t->first_seconds)));
    row("Date", escaped(results.date));
    row("Version", "Tyndall " + escaped(results.version));
    row("Command", "<code>" + escaped(results.command) + "</code>");
    return table.html();
}

} // namespace tyndall::study

/// tyndall study: what accuracy costs in time, on one scene.
#pragma once

#include "study/runner.h"

#include <string>
#include <vector>

namespace tyndall::study {

struct StudyOptions {
    std::filesystem::path folder;        ///< For report.html, results.json, results.csv, images/.
    std::vector<std::string> techniques; ///< Patterns; see select_techniques.
    double budget_seconds = 120;         ///< For everything, from `start` on.
    std::filesystem::path reference;     ///< An image file, or "": made.
    Clock::time_point start = Clock::now();
};

/// How a study talks to whoever started it.
struct StudyHooks {
    std::function<bool()> is_stopped;
    /// What it is at. Called often.
    std::function<void(const std::string&)> tell;
};

/// Measures the techniques one after the other; each gets an equal share of the time that is left.
/// What a folder holds already is not measured again, if it is of the same scene, size, seed,
/// device, reference and version, and had at least half of this budget.
///
/// @param about  who, what, when: version, command, date, device, driver, seed, sizes, effects.
/// @return What was found, also if it was stopped; the report and both files are written.
/// @throws Error bad_input: the folder holds another study, or no technique has such a name, or the
///         reference does not fit; failed; interrupted: before there was anything to report.
Results run_study(const gpu::Context& context, const Scene& scene, const StudyOptions& options,
                  const StudyHooks& hooks, Results about);

} // namespace tyndall::study

/// The tables of the report (HTML).
#pragma once

#include "study/analysis.h"

#include <string>

namespace tyndall::study {

std::string choice_table(const std::vector<Choice>& choices);
std::string agreement_table(const Agreement& agreement);
/// Bias by parameter, a column for each series: {series, what its column is called}.
std::string bias_table(const Results& results, std::string caption, std::string parameter,
                       const std::vector<std::pair<std::string, std::string>>& series);
/// Techniques of a family against the baseline, as factors.
std::string factors_table(const Results& results, Family family, std::string caption);
std::string effects_table(const Results& results);
std::string techniques_table(const Results& results);
std::string provenance_table(const Results& results);

/// What the times of this study are.
std::string time_text(const Results& results);

/// How errors, bias, noise and times were measured, and what they mean.
std::string method_text(const Results& results);

} // namespace tyndall::study

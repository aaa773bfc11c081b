/// What was found, in sentences with numbers (HTML).
#pragma once

#include "study/analysis.h"

#include <string>

namespace tyndall::study {

/// What to choose when, in two or three sentences.
std::string headline(const Results& results, const std::vector<Choice>& choices);

/// Whether the unbiased techniques agree.
std::string agreement_sentence(const Agreement& agreement);

/// How error falls with samples and time.
std::string slope_sentence(const Results& results);

std::string marching_sentence(const Results& results);
std::string orders_sentence(const Results& results);
std::string cells_sentence(const Results& results);
/// Time per sample over that of the baseline.
double relative_cost(const Results& results, const TechniqueResult& technique);

} // namespace tyndall::study

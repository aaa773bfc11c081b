/// The plots of the report, by section.
#pragma once

#include "study/analysis.h"
#include "study/figure.h"

namespace tyndall::study {

/// The techniques that tell the most apart, six at most: the baseline, the cheapest ones, the best
/// march, a single scattering event.
std::vector<const TechniqueResult*> leading(const Results& results,
                                            const std::vector<Choice>& choices);

/// Error against time, with the floors of biased techniques.
Figure time_figure(const std::vector<const TechniqueResult*>& techniques, std::string id,
                   std::string title);
/// Noise and bias together against samples, with fitted slopes.
Figure samples_figure(const std::vector<const TechniqueResult*>& techniques);
/// Bias against the parameter of series, where it can be told.
Figure bias_figure(const Results& results, const std::vector<std::string>& series, std::string id,
                   std::string title, std::string x_label);
/// Time of a sample against the size of majorant cells, and that of the baseline as a floor.
Figure cells_figure(const Results& results);

/// Whether there is anything to see.
bool has_points(const Figure& figure);

/// The legend of a figure as a list.
std::string legend(const Figure& figure);

} // namespace tyndall::study

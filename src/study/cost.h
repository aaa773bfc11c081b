/// What renders cost, from what slices of samples took.
#pragma once

#include "study/results.h"

namespace tyndall::study {

/// Finds seconds_per_render and seconds_per_sample, as a line through the slices and the longer
/// render of EqualTime, each by its relative deviation. Then takes off from the seconds of the
/// levels, until now the sums of their slices, what each slice but one took in any case: a render
/// has that once.
void price(TechniqueResult& technique);

} // namespace tyndall::study

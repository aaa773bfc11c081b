#include "reference/path_report.h"

#include <algorithm>

namespace tyndall::reference {

using namespace shared;

void PathReport::note_majorant(const Rgb& extinction_over_majorant) {
    const double ratio = std::max(
        {extinction_over_majorant.x, extinction_over_majorant.y, extinction_over_majorant.z});
    if (ratio <= MAJORANT_RATIO_MAX) return;
    note(HEALTH_MAJORANT, true);
    majorant_ratio = std::max(majorant_ratio, ratio);
}

bool PathReport::is_dropped() const {
    return (mishaps & (1u << HEALTH_NONFINITE | 1u << HEALTH_NEGATIVE | 1u << HEALTH_DIRECTION)) !=
           0;
}

} // namespace tyndall::reference

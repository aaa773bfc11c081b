#include "study/cost.h"

#include <algorithm>

namespace tyndall::study {
namespace {

/// A weighted line t = fixed + per_sample n.
struct Line {
    double w = 0, wn = 0, wt = 0, wnn = 0, wnt = 0;
    void add(double n, double t) {
        const double weight = 1 / (t * t);
        w += weight, wn += weight * n, wt += weight * t;
        wnn += weight * n * n, wnt += weight * n * t;
    }
};

} // namespace

void price(TechniqueResult& technique) {
    Line line;
    double before = 0;
    for (const Level& level : technique.levels) {
        line.add(level.slice_samples, level.seconds - before);
        before = level.seconds;
    }
    if (technique.equal_time.samples > 0)
        line.add(technique.equal_time.samples, technique.equal_time.seconds);
    const double determinant = line.w * line.wnn - line.wn * line.wn;
    technique.seconds_per_sample = line.wnt / line.wnn; // through 0, if there is no better one
    if (determinant > 1e-9 * line.w * line.wnn) {
        const double slope = (line.w * line.wnt - line.wn * line.wt) / determinant;
        const double fixed = (line.wt - slope * line.wn) / line.w;
        if (slope > 0 && fixed > 0)
            technique.seconds_per_render = fixed, technique.seconds_per_sample = slope;
    }
    double surplus = 0; // seconds grow all the same
    for (std::size_t i = 1; i < technique.levels.size(); ++i) {
        Level& level = technique.levels[i];
        const double slice = level.seconds - surplus - technique.levels[i - 1].seconds;
        surplus += std::min(technique.seconds_per_render, 0.9 * slice);
        level.seconds -= surplus;
    }
}

} // namespace tyndall::study

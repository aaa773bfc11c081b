/// What follows from the measurements: slopes, times to an accuracy, the cheapest technique for
/// each, and whether the unbiased techniques agree.
#pragma once

#include "study/results.h"

namespace tyndall::study {

/// The accuracies of the report: relative RMSE.
inline constexpr std::array<double, 5> kAccuracies{0.1, 0.03, 0.01, 0.003, 0.001};

/// Half of a 95 % interval, in standard deviations.
constexpr double kInterval = 1.96;

/// An error whose square was estimated, with its 95 % interval.
struct Bounds {
    double value = 0, low = 0, high = 0;
    /// Whether it can be told from 0. If not, `high` is what it is below.
    bool is_told() const { return low > 0; }
};
Bounds bounds(const Estimate& square);

/// A power law y = factor * x^slope, fitted in logarithms.
struct Fit {
    double slope = 0, slope_sd = 0, factor = 0;
    std::size_t points = 0;
};

/// Noise against samples, over the slices, which are independent. None with fewer than 3 of them.
std::optional<Fit> fit_noise(const TechniqueResult& technique);

/// Error against seconds, over the levels. Levels share samples: its slope_sd leaves that out.
std::optional<Fit> fit_error(const TechniqueResult& technique);

/// Bias against the parameter of a series (steps, scattering events), over techniques whose bias
/// less `floor` can be told.
std::optional<Fit> fit_bias(const std::vector<const TechniqueResult*>& series);

/// When a technique is as accurate as asked for.
struct TimeTo {
    enum class Kind {
        measured,     ///< Between two levels, or at the first.
        extrapolated, ///< Beyond the last: as many samples more at the same pace.
        never,        ///< Its bias is larger.
        unknown ///< It is biased, by less than could be told, which is not less than asked for.
    };
    Kind kind = Kind::unknown;
    double seconds = 0; ///< measured, extrapolated
    double samples = 0;
    bool is_finite() const { return kind == Kind::measured || kind == Kind::extrapolated; }
};
TimeTo time_to(const TechniqueResult& technique, double accuracy);

/// The cheapest technique for an accuracy, and what the baseline takes. A technique must be cheaper
/// than the baseline by 10 %, and by more than its own interval, to be chosen before it. Null if
/// none gets there.
struct Choice {
    double accuracy = 0;
    const TechniqueResult* technique = nullptr;
    TimeTo time, baseline;
};
std::vector<Choice> choose(const Results& results);

/// Those that are measured and are no mere omissions (Family::without).
std::vector<const TechniqueResult*> contenders(const Results& results);
std::vector<const TechniqueResult*> of_family(const Results& results, Family family);
/// Measured techniques of a series, by parameter.
std::vector<const TechniqueResult*> of_series(const Results& results, const std::string& series);

/// Whether techniques that are unbiased have the expectation of the reference: bias and brightness
/// of each, corrected for the number of tests. By chance, one study in a thousand says no.
struct Agreement {
    std::vector<const TechniqueResult*> techniques;
    std::vector<double> p_values; ///< Of each, corrected for all.
    bool agrees = true;
};
Agreement test_unbiased(const Results& results);

} // namespace tyndall::study

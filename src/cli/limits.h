/// What ends a render, and when that will be.
#pragma once

#include "render/renderer.h"

#include <limits>
#include <optional>
#include <string>

namespace tyndall::cli {

/// The limits that the command line sets; the first that is met ends the render.
struct Limits {
    std::uint32_t end_samples = 0;      ///< Per pixel; kUnlimited if only the others end it.
    std::optional<double> time;         ///< Seconds since the program began.
    std::optional<double> target_error; ///< Upper end of the interval of relative_rmse.

    static constexpr std::uint32_t kUnlimited = 1u << 31;
    /// Batches before a look may end the render or foresee its end.
    static constexpr std::uint32_t kFewestBatches = 8;

    /// Whether the target is met; only looks count.
    bool meets_target(const Progress& progress) const;
};

/// The end of a render as foreseen in the middle of it: which limit, and how things are then.
struct Prediction {
    std::uint32_t at_samples = 0; ///< When it was made: samples per pixel,
    double at_seconds = 0;        ///< seconds of rendering.
    std::string stopped_by;       ///< "spp", "time" or "target-error"
    double samples = 0;           ///< Per pixel.
    double seconds = 0;           ///< Of rendering.
    double relative_rmse = 0;
};

/// How fast a render goes.
struct Pace {
    double seconds = 0;            ///< Of rendering so far.
    double samples = 0;            ///< Per pixel, done so far.
    double traced = 0;             ///< The same with half of those that are begun but not done.
    double samples_per_second = 0; ///< Of those traced, lately; > 0.
    /// Whether few are begun but not done: until then nobody can tell how far those are.
    bool is_steady = true;

    /// Seconds of rendering from now until so many samples per pixel are done; infinite if nobody
    /// can tell.
    double seconds_to(double wanted) const {
        if (wanted <= samples) return 0;
        if (!is_steady) return std::numeric_limits<double>::infinity();
        return (wanted - samples) / samples_per_second;
    }
};

/// Foresees the end from a look: errors fall as 1 / sqrt(samples). None as long as it is not likely
/// to come true within a quarter.
///
/// @param before  seconds from the beginning of the program to that of the rendering
std::optional<Prediction> foresee_end(const Limits& limits, const Progress& progress,
                                      const Pace& pace, double before);

/// Samples per pixel at the look that will meet the target: the upper end of the interval falls as
/// 1 / sqrt(samples). None unless this comes true within a quarter nine times in ten, by the noise
/// of the present error and by how far looks are apart; none where tails are heavy.
std::optional<double> samples_to_target(const Progress& progress, double target_error);
/// Samples per pixel that halve the present error. None as above.
std::optional<double> samples_to_half(const Progress& progress);

} // namespace tyndall::cli

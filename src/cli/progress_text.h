/// The line that tells how a render goes.
#pragma once

#include "stats/error_estimate.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace tyndall::cli {

struct ProgressFigures {
    std::uint32_t samples = 0; ///< Per pixel.
    std::optional<stats::ErrorEstimate> error;
    double paths_per_second = 0;
    std::optional<double> target_error; ///< None: half the present error is told instead.
    /// Until then; told if there is an error. Infinite if nobody can tell.
    double target_seconds = std::numeric_limits<double>::infinity();
    double elapsed = 0, left = 0; ///< Seconds; left is infinite if nothing tells the end.
};

/// "312 spp  0.84 % error (0.80-0.89)  4.1 Mpaths/s  0.5 % in 38 s [41%, 0:26, 0:38 left]"
std::string progress_text(const ProgressFigures& figures);

/// "0.84 % error (0.80-0.89)"
std::string error_text(const stats::ErrorEstimate& error);

/// A fraction in per cent, two digits or more: 0.0084 is "0.84", 0.00001234 is "0.0012".
std::string format_percent(double fraction);

} // namespace tyndall::cli

#include "cli/progress_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace tyndall::cli {
namespace {

/// "0:07", "12:03", "2:05:11"
std::string format_clock(double seconds) {
    if (!std::isfinite(seconds)) return "?";
    const auto whole = static_cast<long long>(seconds + 0.5);
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole % 3600 / 60, whole % 60);
}

std::string goal_text(const ProgressFigures& f) {
    const std::string goal = f.target_error ? fmt::format("{:g} %", 100 * *f.target_error) : "half";
    if (f.target_seconds >= 99.5)
        return fmt::format("  {} in {}", goal, format_clock(f.target_seconds));
    return fmt::format("  {} in {:.{}f} s", goal, f.target_seconds,
                       f.target_seconds < 9.95 ? 1 : 0);
}

} // namespace

std::string format_percent(double fraction) {
    const double percent = 100 * fraction;
    if (percent >= 99.95) return fmt::format("{:.0f}", percent);
    if (percent >= 9.995) return fmt::format("{:.1f}", percent);
    if (percent >= 0.0995 || percent == 0) return fmt::format("{:.2f}", percent);
    return fmt::format("{:.2g}", percent);
}

std::string error_text(const stats::ErrorEstimate& error) {
    return fmt::format("{} % error ({}-{})", format_percent(error.relative_rmse),
                       format_percent(error.low),
                       std::isfinite(error.high) ? format_percent(error.high) : "?");
}

std::string progress_text(const ProgressFigures& f) {
    std::string text = fmt::format("{} spp", f.samples);
    if (f.error) text += "  " + error_text(*f.error);
    const double rate = f.paths_per_second * 1e-6;
    text += fmt::format("  {:.{}f} Mpaths/s", rate, rate < 0.0995 ? 3 : rate < 9.95 ? 1 : 0);
    if (f.error && f.error->relative_rmse > 0) text += goal_text(f);
    if (!std::isfinite(f.left)) return text + fmt::format(" [{}]", format_clock(f.elapsed));
    const double share = f.elapsed / std::max(f.elapsed + f.left, 1e-9);
    return text + fmt::format(" [{:.0f}%, {}, {} left]", 100 * share, format_clock(f.elapsed),
                              format_clock(f.left));
}

} // namespace tyndall::cli

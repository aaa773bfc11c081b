#include "cli/progress_line.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace tyndall::cli {

ProgressLine::ProgressLine(bool quiet)
    : quiet_(quiet), is_terminal_(isatty(STDERR_FILENO) != 0), interval_(is_terminal_ ? 0.2 : 2),
      last_(std::chrono::steady_clock::now()) {}

ProgressLine::~ProgressLine() {
    if (is_open_) std::fputc('\n', stderr);
}

bool ProgressLine::is_due() {
    if (quiet_) return false;
    const auto now = std::chrono::steady_clock::now();
    if (std::chrono::duration<double>(now - last_).count() < interval_) return false;
    last_ = now;
    // A log of a long render should not be long.
    if (!is_terminal_) interval_ = std::min(interval_ * 1.25, 60.0);
    return true;
}

void ProgressLine::print(const std::string& text) {
    if (quiet_) return;
    if (is_terminal_) {
        std::fprintf(stderr, "\r%s\033[K", text.c_str());
        is_open_ = true;
    } else {
        std::fprintf(stderr, "%s\n", text.c_str());
    }
    std::fflush(stderr);
}

std::string format_seconds(double seconds) {
    if (seconds < 99.95) return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<long long>(seconds + 0.5);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

} // namespace tyndall::cli

/// How far a render is, on stderr: one line that is rewritten on a terminal, else a plain line now
/// and then.
#pragma once

#include <chrono>
#include <string>

namespace tyndall::cli {

class ProgressLine {
  public:
    /// With `quiet` nothing is ever printed.
    explicit ProgressLine(bool quiet);
    ~ProgressLine(); ///< Ends the line on a terminal.
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Whether enough time has passed for another update.
    bool is_due();
    void print(const std::string& text);

  private:
    bool quiet_;
    bool is_terminal_;
    bool is_open_ = false; ///< A line on the terminal waits for its end.
    double interval_;      ///< Seconds.
    std::chrono::steady_clock::time_point last_;
};

/// "8.2 s", "3 min 12 s", "2 h 5 min"
std::string format_seconds(double seconds);

} // namespace tyndall::cli

/// The program gnuplot.
#pragma once

#include <string>

namespace tyndall::study {

/// Runs a script; returns what it writes. No text of the user may be in the script but as numbers.
/// @throws Error failed: gnuplot is not installed, or fails; with its message.
std::string run_gnuplot(const std::string& script);

} // namespace tyndall::study

/// One line of the selftest's table.
#pragma once

#include <cmath>
#include <string>

namespace tyndall::selftest {

struct Row {
    std::string name;
    double expected = 0;
    double got = 0;
    double allowed = 0; ///< Most that `got` may be off: 4.5 standard errors, or of rounding.

    double error() const { return got - expected; }
    /// Not if anything is infinite, or not a number.
    bool passed() const { return std::isfinite(allowed) && std::abs(error()) <= allowed; }
};

} // namespace tyndall::selftest

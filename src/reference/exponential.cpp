#include "reference/exponential.h"

#include <cmath>
#include <limits>

namespace tyndall::reference {

double ExponentialLine::column(double t) const {
    if (t == 0) return 0; // even in an infinite density
    // Seen from the lower end, where the density is greatest, it only falls: nothing overflows
    // before its time.
    const double fall = std::abs(rise) / scale_height;
    const double lower_end = rise < 0 ? start + rise * t : start;
    const double greatest = std::exp(-lower_end / scale_height);
    if (greatest == 0) return 0;               // even of an infinite line
    const bool is_level = !(fall * t > 1e-17); // up to rounding
    return is_level ? greatest * t : greatest * (-std::expm1(-fall * t) / fall);
}

double ExponentialLine::distance(double column) const {
    if (column == 0) return 0;
    // The column in lengths of the fall-off, by its logarithm: the density may be out of range at
    // the start.
    const double x = rise / scale_height;
    const double log_ratio = std::log(column) + start / scale_height;
    if (x == 0) return std::exp(log_ratio);
    const double log_q = log_ratio + std::log(std::abs(x));
    if (x > 0)
        return log_q < 0 ? -std::log1p(-std::exp(log_q)) / x
                         : std::numeric_limits<double>::infinity();
    const double log_1_plus_q =
        log_q > 0 ? log_q + std::log1p(std::exp(-log_q)) : std::log1p(std::exp(log_q));
    return log_1_plus_q / -x;
}

} // namespace tyndall::reference

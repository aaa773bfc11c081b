#include "stats/sample_tail.h"

#include <algorithm>
#include <cmath>

namespace tyndall::stats {
namespace {

/// Middle of a bin.
double brightness(std::size_t bin) {
    if (bin < 2) return 0; // black, and what is not normal
    const double mantissa = bin % 2 == 0 ? 1.25 : 1.75;
    return std::ldexp(mantissa, static_cast<int>(bin / 2) - 127);
}

} // namespace

std::optional<double> tail_share(const SampleHistogram& counts) {
    double count = 0, total = 0;
    for (std::size_t bin = 0; bin < counts.size(); ++bin) {
        count += static_cast<double>(counts[bin]);
        total += static_cast<double>(counts[bin]) * brightness(bin);
    }
    if (total == 0) return std::nullopt;
    double left = count / 1000, tail = 0;
    for (std::size_t bin = counts.size(); bin-- > 0 && left > 0;) {
        const double taken = std::min(left, static_cast<double>(counts[bin]));
        tail += taken * brightness(bin);
        left -= taken;
    }
    return tail / total;
}

} // namespace tyndall::stats

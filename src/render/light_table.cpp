#include "render/light_table.h"

#include <numeric>

namespace tyndall {

std::vector<AliasCell> make_alias_table(std::span<const double> weights) {
    const auto n = weights.size();
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<AliasCell> cells(n);
    std::vector<double> scaled(n); // probability times n
    std::vector<std::size_t> small, large;
    for (std::size_t i = 0; i < n; ++i) {
        cells[i].probability = total > 0 ? weights[i] / total : 1 / static_cast<double>(n);
        cells[i].alias = static_cast<std::uint32_t>(i);
        scaled[i] = cells[i].probability * static_cast<double>(n);
        (scaled[i] < 1 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty()) { // what is left at the end is 1 up to rounding
        const std::size_t i = small.back(), j = large.back();
        small.pop_back();
        large.pop_back();
        cells[i].threshold = scaled[i];
        cells[i].alias = static_cast<std::uint32_t>(j);
        scaled[j] = (scaled[j] + scaled[i]) - 1;
        (scaled[j] < 1 ? small : large).push_back(j);
    }
    return cells;
}

} // namespace tyndall

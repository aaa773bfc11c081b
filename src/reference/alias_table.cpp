#include "reference/alias_table.h"

#include <numeric>

namespace tyndall::reference {

AliasTable::AliasTable(const std::vector<double>& weights) : probabilities_(weights) {
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(total > 0)) return;
    entries_.resize(weights.size());
    std::vector<double> scaled;              // Mean 1.
    std::vector<std::uint32_t> small, large; // Stacks of rows below and not below 1.
    for (std::uint32_t i = 0; i < weights.size(); ++i) {
        probabilities_[i] = weights[i] / total;
        scaled.push_back(probabilities_[i] * static_cast<double>(weights.size()));
        entries_[i].alias = i;
        (scaled[i] < 1 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty()) {
        const std::uint32_t low = small.back(), high = large.back();
        small.pop_back();
        large.pop_back();
        entries_[low] = {scaled[low], high};
        scaled[high] = (scaled[high] + scaled[low]) - 1;
        (scaled[high] < 1 ? small : large).push_back(high);
    }
}

std::uint32_t AliasTable::choose(std::uint32_t word) const {
    const std::uint64_t product = std::uint64_t{word} * entries_.size();
    return choose(word, static_cast<double>(product & 0xffffffffu) * 0x1p-32);
}

std::uint32_t AliasTable::choose(std::uint32_t word, double fraction) const {
    const auto row = static_cast<std::uint32_t>(std::uint64_t{word} * entries_.size() >> 32);
    return fraction < entries_[row].threshold ? row : entries_[row].alias;
}

} // namespace tyndall::reference

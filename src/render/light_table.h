/// The choice of a light by power.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tyndall {

/// One cell of an alias table: keep this index if the fraction of the draw is below the threshold,
/// else take the alias.
struct AliasCell {
    double probability = 0; ///< Of the index being chosen.
    double threshold = 1;
    std::uint32_t alias = 0;
};

/// Table by which index i is chosen with probability weights[i] / sum in constant time, from one
/// uniform number u: i = floor(u n), fraction = u n - i. Weights are >= 0; if all are 0, all are as
/// likely. Deterministic: cells are filled in the order of their indices. Source: Vose 1991.
std::vector<AliasCell> make_alias_table(std::span<const double> weights);

} // namespace tyndall

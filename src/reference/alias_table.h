/// Choice among weighted items in constant time.
#pragma once

#include <cstdint>
#include <vector>

namespace tyndall::reference {

/// Vose 1991, "A Linear Algorithm for Generating Random Numbers with a Given Distribution", built
/// in the order of the items, so that every renderer draws the same item from the same word.
class AliasTable {
  public:
    /// Weights are >= 0; their sum may be 0, then there is nothing to choose.
    explicit AliasTable(const std::vector<double>& weights);

    bool empty() const { return entries_.empty(); }
    double probability(std::size_t item) const { return probabilities_[item]; }
    /// word * n = (row, remainder) in 32 bits each: the row itself if remainder / 2^32 is below its
    /// threshold, else its alias.
    std::uint32_t choose(std::uint32_t word) const;
    /// Likewise, with `fraction` in [0, 1) for remainder / 2^32: where there are many items, the
    /// remainder of a word is too coarse.
    std::uint32_t choose(std::uint32_t word, double fraction) const;

  private:
    struct Entry {
        double threshold = 1;
        std::uint32_t alias = 0;
    };
    std::vector<Entry> entries_;
    std::vector<double> probabilities_;
};

} // namespace tyndall::reference

/// Words and elements of the report.
#pragma once

#include "study/analysis.h"

#include <string>
#include <vector>

namespace tyndall::study {

/// Text of a user, for elements and attributes.
std::string escaped(const std::string& text);

/// "23 %", "4.1 %", "0.031 %".
std::string percent(double fraction);
/// Of a round number: "10 %", "0.3 %".
std::string accuracy_text(double fraction);
/// "3 ms", "0.42 s", "8.1 s", "2.5 min", "3.2 h", "4 days"
std::string duration(double seconds);
/// "4.1 % (3.9 to 4.3)", or "below 0.2 %" where it cannot be told from none.
std::string told(const Estimate& square);
/// "8.1 s", "≈ 52 s" if extrapolated, "never", "cannot be told".
std::string told(const TimeTo& time);
/// "-0.502 ± 0.004"; "" without a fit.
std::string told(const std::optional<Fit>& fit);
/// "one", "two" ... "nine", then digits.
std::string count(std::size_t n);
/// "a, b and c"
std::string listed(const std::vector<std::string>& words);

/// A table in a box that scrolls by itself where the page is too narrow for it.
class Table {
  public:
    Table(std::string caption, std::vector<std::string> columns)
        : caption_(std::move(caption)), columns_(std::move(columns)) {}
    /// The first cell names the row. `style` is a class of the row, or "".
    void add(std::vector<std::string> cells, std::string style = "");
    std::string html() const;

  private:
    std::string caption_;
    std::vector<std::string> columns_;
    std::string rows_;
};

/// An element with contents.
std::string element(const char* name, const std::string& contents, const char* style = "");

} // namespace tyndall::study

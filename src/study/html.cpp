#include "study/html.h"

#include <array>
#include <cmath>
#include <fmt/format.h>

namespace tyndall::study {
namespace {

/// Two significant digits, without exponent.
std::string two_digits(double value) {
    if (value == 0) return "0";
    const int digits = 1 - static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
    return fmt::format("{:.{}f}", value, std::max(0, digits));
}

} // namespace

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '"')
            result += "&quot;";
        else
            result += c;
    }
    return result;
}

std::string percent(double fraction) {
    return two_digits(100 * fraction) + "\u00a0%";
}

std::string accuracy_text(double fraction) {
    return fmt::format("{:g}\u00a0%", 100 * fraction);
}

std::string duration(double seconds) {
    if (seconds < 0.0995) return two_digits(1000 * seconds) + "\u00a0ms";
    if (seconds < 99.5) return two_digits(seconds) + "\u00a0s";
    if (seconds < 5970) return two_digits(seconds / 60) + "\u00a0min";
    if (seconds < 172800) return two_digits(seconds / 3600) + "\u00a0h";
    return two_digits(seconds / 86400) + "\u00a0days";
}

std::string told(const Estimate& square) {
    const Bounds b = bounds(square);
    if (!b.is_told()) return "below " + percent(b.high);
    const double ends = 100 * (b.high - b.low);
    const auto magnitude = [](double x) { return static_cast<int>(std::floor(std::log10(x))); };
    // Two digits of the interval, but four of the value at most.
    const int digits = std::max(0, std::min(1 - magnitude(ends), 3 - magnitude(100 * b.value)));
    return fmt::format("{0:.{3}f}\u00a0% <span class=\"interval\">({1:.{3}f} to {2:.{3}f})</span>",
                       100 * b.value, 100 * b.low, 100 * b.high, digits);
}

std::string told(const TimeTo& time) {
    switch (time.kind) {
    case TimeTo::Kind::measured:
        return duration(time.seconds);
    case TimeTo::Kind::extrapolated:
        return "<span class=\"predicted\">≈\u00a0" + duration(time.seconds) + "</span>";
    case TimeTo::Kind::never:
        return "<span class=\"never\">never</span>";
    case TimeTo::Kind::unknown:
        return "<span class=\"never\">cannot be told</span>";
    }
    return "";
}

std::string told(const std::optional<Fit>& fit) {
    if (!fit) return "";
    return fmt::format("{:.3f}\u00a0±\u00a0{:.3f}", fit->slope, kInterval * fit->slope_sd);
}

std::string count(std::size_t n) {
    constexpr std::array<const char*, 10> words{"no",   "one", "two",   "three", "four",
                                                "five", "six", "seven", "eight", "nine"};
    return n < words.size() ? words[n] : std::to_string(n);
}

std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
    return text;
}

void Table::add(std::vector<std::string> cells, std::string style) {
    rows_ += style.empty() ? "<tr>" : "<tr class=\"" + style + "\">";
    for (std::size_t i = 0; i < cells.size(); ++i)
        rows_ += i == 0 ? "<th scope=\"row\">" + cells[i] + "</th>" : "<td>" + cells[i] + "</td>";
    rows_ += "</tr>\n";
}

std::string Table::html() const {
    std::string head;
    for (const std::string& column : columns_)
        head += "<th scope=\"col\">" + column + "</th>";
    return "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" + caption_ +
           "\"><table>\n<caption>" + caption_ + "</caption>\n<thead><tr>" + head +
           "</tr></thead>\n<tbody>\n" + rows_ + "</tbody></table></div>\n";
}

std::string element(const char* name, const std::string& contents, const char* style) {
    const std::string attribute = *style ? fmt::format(" class=\"{}\"", style) : "";
    return fmt::format("<{0}{1}>{2}</{0}>\n", name, attribute, contents);
}

} // namespace tyndall::study

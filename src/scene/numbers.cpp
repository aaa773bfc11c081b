#include "scene/numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <system_error>

namespace tyndall {
namespace {

template<typename T, typename... Format>
std::from_chars_result read(std::string_view text, T& value, Format... format) {
    return std::from_chars(text.data(), text.data() + text.size(), value, format...);
}

bool is_whole(const std::from_chars_result& result, std::string_view text) {
    return result.ptr == text.data() + text.size();
}

/// A number other than 0 that from_chars calls out of range: is it below 1?
bool is_tiny(std::string_view text) {
    if (text.starts_with('-')) text.remove_prefix(1);
    const std::size_t mark = text.find_first_of("eE");
    const std::string_view digits = text.substr(0, mark);
    int exponent = 0;
    if (mark != std::string_view::npos) {
        std::string_view power = text.substr(mark + 1);
        if (power.starts_with('+')) power.remove_prefix(1);
        // An exponent that does not fit an int decides by its sign alone.
        if (read(power, exponent).ec != std::errc()) return power.starts_with('-');
    }
    const auto point = static_cast<std::int64_t>(std::min(digits.find('.'), digits.size()));
    const auto first = static_cast<std::int64_t>(digits.find_first_not_of("0."));
    const std::int64_t leading = first < point ? point - first - 1 : point - first;
    return leading + exponent < 0;
}

} // namespace

std::optional<double> parse_number(std::string_view text) {
    if (text.starts_with("0x") || text.starts_with("0X")) {
        std::uint64_t bits = 0;
        const std::string_view digits = text.substr(2);
        const auto result = read(digits, bits, 16);
        if (result.ec != std::errc() || !is_whole(result, digits)) return std::nullopt;
        return static_cast<double>(bits);
    }
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    double value = 0;
    const auto result = read(text, value);
    if (!is_whole(result, text)) return std::nullopt;
    if (result.ec == std::errc::result_out_of_range && is_tiny(text)) return 0.0;
    if (result.ec != std::errc()) return std::nullopt;
    if (!(std::abs(value) <= std::numeric_limits<float>::max())) return std::nullopt;
    return value;
}

std::optional<int> parse_integer(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    int value = 0;
    const auto result = read(text, value);
    if (result.ec != std::errc() || !is_whole(result, text)) return std::nullopt;
    return value;
}

} // namespace tyndall

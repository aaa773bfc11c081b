/// Numbers in text, as pbrt writes them; independent of the locale.
#pragma once

#include <optional>
#include <string_view>

namespace tyndall {

/// A decimal number ("-1", "+.5", "1e-3") or an unsigned hexadecimal integer ("0x1f"), the whole
/// text. Nothing if it is something else or not finite as a float; what is too small for a double
/// is 0.
std::optional<double> parse_number(std::string_view text);

/// An integer of 32 bits, the whole text; nothing if it is something else.
std::optional<int> parse_integer(std::string_view text);

} // namespace tyndall

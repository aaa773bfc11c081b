#include "scene/diagnostics.h"

#include <algorithm>
#include <fmt/core.h>

namespace tyndall {
namespace {

std::string message(const SourceLocation& where, std::string_view kind, std::string_view what) {
    const std::string place = to_string(where);
    return place.empty() ? fmt::format("{}: {}", kind, what)
                         : fmt::format("{}: {}: {}", place, kind, what);
}

/// Bytes of the character at the start of a text; 0 if it does not print or is no UTF-8.
std::size_t character_length(std::string_view text) {
    const auto first = static_cast<unsigned char>(text[0]);
    if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i) {
        if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return 0;
    }
    const auto second = static_cast<unsigned char>(text[1]);
    // Overlong forms, surrogates, and code points past the last.
    const bool is_invalid = (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
                            (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f);
    return is_invalid ? 0 : length;
}

} // namespace

void Diagnostics::error(const SourceLocation& where, std::string_view what) {
    if (errors_.size() == max_errors) fatal(where, "too many errors");
    errors_.push_back(message(where, "error", what));
}

void Diagnostics::fatal(const SourceLocation& where, std::string_view what) {
    errors_.push_back(message(where, "error", what));
    throw SceneError(errors_);
}

void Diagnostics::warning(const SourceLocation& where, std::string_view what) {
    if (warnings_.size() < max_warnings) {
        warnings_.push_back(message(where, "warning", what));
    } else {
        ++warnings_left_out_;
    }
}

void Diagnostics::throw_if_errors() const {
    if (has_errors()) throw SceneError(errors_);
}

std::vector<std::string> Diagnostics::warnings() const {
    std::vector<std::string> lines = warnings_;
    if (warnings_left_out_ > 0) {
        lines.push_back(fmt::format("warning: {} more warnings", warnings_left_out_));
    }
    return lines;
}

std::string in_quotes(std::string_view text, std::size_t max_length) {
    std::string result = "\"";
    std::size_t i = 0;
    while (i < text.size() && i < max_length) {
        const std::size_t length = character_length(text.substr(i));
        if (length == 0) {
            result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[i]));
        } else {
            result += text.substr(i, length);
        }
        i += std::max<std::size_t>(length, 1);
    }
    result += i < text.size() ? "...\"" : "\"";
    return result;
}

std::string file_in_quotes(std::string_view name) {
    return in_quotes(name, 400);
}

} // namespace tyndall

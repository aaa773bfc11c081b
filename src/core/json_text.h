/// JSON as text.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tyndall {

/// Names in scenes and of files need not be UTF-8, JSON must be: what is not becomes U+FFFD.
inline std::string json_text(const nlohmann::json& value, int indent = -1) {
    return value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace tyndall

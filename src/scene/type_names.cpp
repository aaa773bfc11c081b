#include "scene/type_names.h"

#include <algorithm>
#include <fmt/format.h>

namespace tyndall {

bool check_type(const TypeNames& names, std::string_view type, const SourceLocation& where,
                Diagnostics& diagnostics) {
    const auto has = [&](const std::initializer_list<std::string_view>& list) {
        return std::find(list.begin(), list.end(), type) != list.end();
    };
    if (has(names.supported)) return true;
    if (has(names.pbrt_only)) {
        diagnostics.error(where, fmt::format("{} \"{}\" is not supported yet", names.what, type));
    } else if (names.supported.size() == 0) {
        diagnostics.error(where, fmt::format("unknown {} {}", names.what, in_quotes(type)));
    } else {
        diagnostics.error(where,
                          fmt::format("unknown {} {} (expected {}{})", names.what, in_quotes(type),
                                      names.supported.size() > 1 ? "one of " : "",
                                      fmt::join(names.supported, ", ")));
    }
    return false;
}

} // namespace tyndall

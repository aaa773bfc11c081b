#include "core/error.h"

#include <cstdio>
#include <cstdlib>
#include <utility>

namespace tyndall {
namespace {

std::string join_lines(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) {
        if (!text.empty()) text += '\n';
        text += line;
    }
    return text;
}

} // namespace

std::string to_string(const SourceLocation& where) {
    if (!where.file) return "";
    if (where.line == 0) return *where.file;
    return *where.file + ':' + std::to_string(where.line) + ':' + std::to_string(where.column);
}

SceneError::SceneError(std::vector<std::string> messages)
    : Error(ExitStatus::bad_input, join_lines(messages)), messages_(std::move(messages)) {}

void assertion_failed(const char* condition, const char* file, int line) {
    std::fprintf(stderr, "%s:%d: assertion failed: %s\n", file, line, condition);
    std::abort();
}

} // namespace tyndall

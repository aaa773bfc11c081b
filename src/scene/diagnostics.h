/// Errors and warnings of scene files, collected so that one run shows all of them.
#pragma once

#include "core/error.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall {

/// Collects "file:line:column: error: ..." lines. Holds a bounded number of them, whatever the
/// input.
class Diagnostics {
  public:
    static constexpr std::size_t max_errors = 20;
    static constexpr std::size_t max_warnings = 100;

    /// Adds an error. Throws SceneError with all errors and "too many errors" instead of adding one
    /// more than max_errors.
    void error(const SourceLocation& where, std::string_view what);

    /// Adds an error that leaves nothing to go on with, and throws all of them.
    [[noreturn]] void fatal(const SourceLocation& where, std::string_view what);

    /// Adds a warning; warnings past max_warnings are counted only.
    void warning(const SourceLocation& where, std::string_view what);

    bool has_errors() const { return !errors_.empty(); }

    /// Throws SceneError with all errors if there are any.
    void throw_if_errors() const;

    /// The warnings, with a last line that tells how many were left out.
    std::vector<std::string> warnings() const;

  private:
    std::vector<std::string> errors_;
    std::vector<std::string> warnings_;
    std::size_t warnings_left_out_ = 0;
};

/// Text from a file, fit for a message: in double quotes, cut at max_length bytes; bytes that do
/// not print or are no UTF-8 as \xNN.
std::string in_quotes(std::string_view text, std::size_t max_length = 60);

/// The same for the name of a file, of which more is shown.
std::string file_in_quotes(std::string_view name);

} // namespace tyndall

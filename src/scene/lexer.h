/// Words of a pbrt-v4 scene file.
#pragma once

#include "core/error.h"
#include "scene/diagnostics.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace tyndall {

/// A token. `text` points into the file, which must outlive it.
struct Token {
    enum class Kind {
        word,    ///< Directive, number, true, false.
        string,  ///< In quotes; text is what is between them, escapes as written.
        open,    ///< [
        close,   ///< ]
        invalid, ///< An error was reported for it.
    };
    Kind kind = Kind::invalid;
    std::string_view text;
    SourceLocation where;
};

/// Splits one file into tokens, as pbrt-v4 does: tokens end at space, tab, CR, LF, quotes and
/// brackets;
/// "#" where a token could start opens a comment that ends with the line; strings do not span lines
/// and know the escapes \b \f \n \r \t \\ \' \". Lines count "\n"; columns count characters
/// (UTF-8), a tab is one of them.
class Lexer {
  public:
    /// @param file_name  for messages.
    Lexer(std::string contents, std::string file_name, Diagnostics& diagnostics);
    Lexer(const Lexer&) = delete;
    Lexer& operator=(const Lexer&) = delete;

    /// The next token; nothing at the end of the file. Errors are reported and give an invalid
    /// token.
    std::optional<Token> next();

    const std::string& file_name() const { return *file_; }

  private:
    bool at_end() const { return position_ == contents_.size(); }
    char peek() const { return contents_[position_]; }
    void advance();
    void skip_space_and_comments();
    void skip_line();
    SourceLocation here() const { return {file_, line_, column_}; }
    Token read_string();
    Token read_word();

    std::string contents_;
    std::shared_ptr<const std::string> file_;
    Diagnostics& diagnostics_;
    std::size_t position_ = 0;
    int line_ = 1;
    int column_ = 1;
};

/// The text of a string token with its escapes resolved.
std::string string_value(const Token& token);

/// A token as messages show it.
std::string describe(const Token& token);

} // namespace tyndall

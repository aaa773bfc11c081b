#include "scene/lexer.h"

#include <fmt/core.h>
#include <utility>

namespace tyndall {
namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

bool ends_word(char c) {
    return is_space(c) || c == '"' || c == '[' || c == ']';
}

/// What "\c" means; nothing if it has no meaning.
std::optional<char> unescape(char c) {
    switch (c) {
    case 'b':
        return '\b';
    case 'f':
        return '\f';
    case 'n':
        return '\n';
    case 'r':
        return '\r';
    case 't':
        return '\t';
    case '\\':
        return '\\';
    case '\'':
        return '\'';
    case '"':
        return '"';
    default:
        return std::nullopt;
    }
}

} // namespace

Lexer::Lexer(std::string contents, std::string file_name, Diagnostics& diagnostics)
    : contents_(std::move(contents)),
      file_(std::make_shared<const std::string>(std::move(file_name))), diagnostics_(diagnostics) {
    constexpr std::string_view utf8_mark = "\xef\xbb\xbf";
    if (contents_.starts_with("\xfe\xff") || contents_.starts_with("\xff\xfe")) {
        diagnostics_.error({file_, 1, 1}, "the file is in UTF-16 (expected UTF-8)");
        position_ = contents_.size();
    } else if (contents_.starts_with(utf8_mark)) {
        position_ = utf8_mark.size();
    }
}

std::optional<Token> Lexer::next() {
    skip_space_and_comments();
    if (at_end()) return std::nullopt;
    const char c = peek();
    if (c == '"') return read_string();
    if (c != '[' && c != ']') return read_word();
    Token token{c == '[' ? Token::Kind::open : Token::Kind::close,
                std::string_view(contents_).substr(position_, 1), here()};
    advance();
    return token;
}

void Lexer::advance() {
    const auto byte = static_cast<unsigned char>(contents_[position_++]);
    if (byte == '\n') {
        ++line_;
        column_ = 1;
    } else if ((byte & 0xc0) != 0x80) { // a UTF-8 sequence counts once
        ++column_;
    }
}

void Lexer::skip_space_and_comments() {
    while (!at_end()) {
        if (peek() == '#') {
            skip_line();
        } else if (is_space(peek())) {
            advance();
        } else {
            return;
        }
    }
}

void Lexer::skip_line() {
    while (!at_end() && peek() != '\n' && peek() != '\r')
        advance();
}

Token Lexer::read_string() {
    const SourceLocation start = here();
    advance();
    const std::size_t begin = position_;
    bool valid = true;
    while (!at_end() && peek() != '"' && peek() != '\n') {
        if (peek() == '\\' && position_ + 1 < contents_.size() &&
            contents_[position_ + 1] != '\n') {
            const SourceLocation escape = here();
            advance();
            if (valid && !unescape(peek())) {
                const std::string_view text = std::string_view(contents_).substr(position_ - 1, 2);
                diagnostics_.error(escape,
                                   fmt::format("unknown escape {} in a string (expected \\b, "
                                               "\\f, \\n, \\r, \\t, \\\\, \\' or \\\")",
                                               in_quotes(text)));
                valid = false;
            }
        }
        advance();
    }
    const std::string_view text = std::string_view(contents_).substr(begin, position_ - begin);
    if (at_end() || peek() == '\n') {
        if (valid) diagnostics_.error(start, "unterminated string (expected \" on the same line)");
        return {Token::Kind::invalid, text, start};
    }
    advance();
    return {valid ? Token::Kind::string : Token::Kind::invalid, text, start};
}

Token Lexer::read_word() {
    const SourceLocation start = here();
    const std::size_t begin = position_;
    while (!at_end() && !ends_word(peek()))
        advance();
    return {Token::Kind::word, std::string_view(contents_).substr(begin, position_ - begin), start};
}

std::string string_value(const Token& token) {
    std::string value;
    value.reserve(token.text.size());
    for (std::size_t i = 0; i < token.text.size(); ++i) {
        const bool escaped = token.text[i] == '\\' && i + 1 < token.text.size();
        if (escaped) ++i;
        value += escaped ? unescape(token.text[i]).value_or(token.text[i]) : token.text[i];
    }
    return value;
}

std::string describe(const Token& token) {
    return token.kind == Token::Kind::string ? "the string " + in_quotes(token.text)
                                             : in_quotes(token.text);
}

} // namespace tyndall

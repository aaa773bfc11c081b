#include "scene/parameter_parser.h"

#include "scene/numbers.h"
#include "scene/parser.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace tyndall {
namespace {

constexpr std::array<std::string_view, 13> types = {
    "bool",   "integer", "float", "point2",  "vector2",   "point3",  "vector3",
    "normal", "string",  "rgb",   "texture", "blackbody", "spectrum"};

/// The spelling of a type in pbrt-v3, or the name that another program might give it.
std::string_view modern_type(std::string_view type) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 8> old = {{
        {"point", "point3"},
        {"vector", "vector3"},
        {"color", "rgb"},
        {"normal3", "normal"},
        {"int", "integer"},
        {"boolean", "bool"},
        {"xyz", "rgb"},
        {"rgba", "rgb"},
    }};
    for (const auto& [before, now] : old) {
        if (type == before) return now;
    }
    return {};
}

/// Splits "type name"; nothing if there are not exactly two words.
std::optional<std::pair<std::string, std::string>> split_declaration(std::string_view text) {
    constexpr std::string_view blanks = " \t";
    std::array<std::string, 2> words;
    std::size_t count = 0;
    std::size_t begin = text.find_first_not_of(blanks);
    while (begin != std::string_view::npos) {
        if (count == words.size()) return std::nullopt;
        const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
        words[count++] = text.substr(begin, end - begin);
        begin = text.find_first_not_of(blanks, end);
    }
    if (count != words.size()) return std::nullopt;
    return std::pair(std::move(words[0]), std::move(words[1]));
}

/// What values of the type look like, for messages.
std::string_view value_words(std::string_view type) {
    if (type == "bool") return "true or false, without quotes";
    if (type == "integer") return "an integer of 32 bits";
    if (type == "string" || type == "texture") return "a string in quotes";
    if (type == "spectrum") return "numbers, or one string in quotes";
    return "a finite number";
}

class ParameterParser {
  public:
    ParameterParser(TokenStream& tokens, Diagnostics& diagnostics)
        : tokens_(tokens), diagnostics_(diagnostics) {}

    ParsedParameters parse();

  private:
    std::shared_ptr<Parameter> parse_declaration(const Token& token);
    bool parse_values(Parameter& parameter);
    bool parse_list(Parameter& parameter);
    void add_value(Parameter& parameter, const Token& token);
    bool convert(Parameter& parameter, const Token& token) const;
    void check_count(Parameter& parameter);
    void report(const Parameter& parameter, const Token& token, std::string_view expected);
    bool missing_value(const Parameter& parameter, const std::optional<Token>& token);

    TokenStream& tokens_;
    Diagnostics& diagnostics_;
};

ParsedParameters ParameterParser::parse() {
    ParsedParameters parameters;
    while (true) {
        std::optional<Token> token = tokens_.next();
        if (!token) return parameters;
        if (token->kind != Token::Kind::string) {
            tokens_.unget(*token);
            parameters.complete = token->kind != Token::Kind::invalid;
            return parameters;
        }
        std::shared_ptr<Parameter> parameter = parse_declaration(*token);
        if (!parse_values(*parameter)) {
            parameters.complete = false;
            parameter->broken = true;
            skip_to_directive(tokens_);
        }
        check_count(*parameter);
        parameters.list.push_back(std::move(parameter));
    }
}

std::shared_ptr<Parameter> ParameterParser::parse_declaration(const Token& token) {
    auto parameter = std::make_shared<Parameter>();
    parameter->where = token.where;
    const std::string text = string_value(token);
    if (auto words = split_declaration(text)) {
        parameter->type = std::move(words->first);
        parameter->name = std::move(words->second);
        if (std::find(types.begin(), types.end(), parameter->type) != types.end()) return parameter;
        const std::string_view modern = modern_type(parameter->type);
        diagnostics_.error(
            token.where,
            fmt::format("unknown parameter type {} ({})", in_quotes(parameter->type),
                        modern.empty() ? fmt::format("expected one of {}", fmt::join(types, ", "))
                                       : fmt::format("expected \"{}\"", modern)));
    } else {
        diagnostics_.error(token.where, fmt::format("the string {} declares no parameter (expected "
                                                    "\"type name\")",
                                                    in_quotes(text)));
    }
    parameter->broken = true;
    return parameter;
}

bool ParameterParser::parse_values(Parameter& parameter) {
    const std::optional<Token> token = tokens_.next();
    if (missing_value(parameter, token)) return false;
    if (token->kind == Token::Kind::open) return parse_list(parameter);
    add_value(parameter, *token);
    return true;
}

bool ParameterParser::parse_list(Parameter& parameter) {
    while (true) {
        const std::optional<Token> token = tokens_.next();
        if (token && token->kind == Token::Kind::close) return true;
        if (missing_value(parameter, token)) return false;
        if (token->kind == Token::Kind::open) {
            report(parameter, *token, fmt::format("{}, or ]", value_words(parameter.type)));
            return false;
        }
        add_value(parameter, *token);
    }
}

/// Reports what cannot be a value: a directive, a closing bracket, the end.
bool ParameterParser::missing_value(const Parameter& parameter, const std::optional<Token>& token) {
    if (!token) {
        diagnostics_.error(parameter.where,
                           fmt::format("the file ends inside parameter {}", parameter.title()));
        return true;
    }
    if (token->kind == Token::Kind::invalid) return true;
    const bool is_value = token->kind == Token::Kind::string || token->kind == Token::Kind::open ||
                          (token->kind == Token::Kind::word && !is_directive(token->text));
    if (is_value) return false;
    report(parameter, *token, value_words(parameter.type));
    tokens_.unget(*token);
    return true;
}

void ParameterParser::add_value(Parameter& parameter, const Token& token) {
    if (parameter.broken || convert(parameter, token)) return;
    parameter.broken = true;
    report(parameter, token, value_words(parameter.type));
}

bool ParameterParser::convert(Parameter& parameter, const Token& token) const {
    const bool is_string = token.kind == Token::Kind::string;
    if (parameter.type == "string" || parameter.type == "texture" ||
        (parameter.type == "spectrum" && parameter.numbers.empty() && is_string)) {
        if (is_string) parameter.strings.push_back(string_value(token));
        return is_string;
    }
    if (is_string || !parameter.strings.empty()) return false;
    if (parameter.type == "bool") {
        parameter.bools.push_back(token.text == "true");
        return token.text == "true" || token.text == "false";
    }
    if (parameter.type == "integer") {
        const std::optional<int> value = parse_integer(token.text);
        parameter.integers.push_back(value.value_or(0));
        return value.has_value();
    }
    const std::optional<double> value = parse_number(token.text);
    parameter.numbers.push_back(value.value_or(0));
    return value.has_value();
}

void ParameterParser::check_count(Parameter& parameter) {
    if (parameter.broken) return;
    const std::size_t count = parameter.numbers.size();
    const auto item = static_cast<std::size_t>(values_per_item(parameter.type));
    const bool is_empty = count == 0 && parameter.integers.empty() && parameter.strings.empty() &&
                          parameter.bools.empty();
    if (!is_empty && count % item == 0) return;
    parameter.broken = true;
    diagnostics_.error(parameter.where,
                       is_empty
                           ? fmt::format("parameter {} has no values", parameter.title())
                           : fmt::format("parameter {} has {} values (expected a multiple of {})",
                                         parameter.title(), count, item));
}

void ParameterParser::report(const Parameter& parameter, const Token& token,
                             std::string_view expected) {
    diagnostics_.error(token.where, fmt::format("{} is no value for parameter {} (expected {})",
                                                describe(token), parameter.title(), expected));
}

} // namespace

void skip_to_directive(TokenStream& tokens) {
    while (std::optional<Token> token = tokens.next()) {
        if (token->kind != Token::Kind::word || !is_directive(token->text)) continue;
        tokens.unget(*token);
        return;
    }
}

ParsedParameters parse_parameters(TokenStream& tokens, Diagnostics& diagnostics) {
    return ParameterParser(tokens, diagnostics).parse();
}

} // namespace tyndall

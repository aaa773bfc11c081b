#include "scene/parser.h"

#include "scene/directives.h"
#include "scene/numbers.h"
#include "scene/parameter_parser.h"
#include "scene/transform.h"

#include <array>
#include <fmt/core.h>
#include <utility>

namespace tyndall {
void Parser::parse() {
    while (std::optional<Token> token = tokens_.next()) {
        try {
            parse_directive(*token);
        } catch (const Unreadable&) {
            skip_to_directive(tokens_);
        }
        tokens_.new_directive();
    }
}

void Parser::parse_directive(const Token& token) {
    const Directive* directive =
        token.kind == Token::Kind::word ? find_directive(token.text) : nullptr;
    if (!directive) {
        if (token.kind != Token::Kind::invalid) {
            diagnostics_.error(token.where, fmt::format("{} is no directive", describe(token)));
        }
        throw Unreadable{};
    }
    const SourceLocation where = token.where;
    directive_ = directive->name;
    directive_where_ = where;
    const bool allowed = builder_.check_block(directive->block, directive_, where);
    if (const auto* typed = std::get_if<Directive::Typed>(&directive->read)) {
        const std::string type = expect_string();
        const ParsedParameters parameters = parse_parameters(tokens_, diagnostics_);
        if (allowed) (builder_.**typed)(type, parameters, where);
        if (!parameters.complete) skip_to_directive(tokens_);
    } else if (const auto* named = std::get_if<Directive::Named>(&directive->read)) {
        const std::string name = expect_string();
        if (allowed) (builder_.**named)(name, where);
    } else if (const auto* plain = std::get_if<Directive::Plain>(&directive->read)) {
        if (allowed) (builder_.**plain)(where);
    } else if (allowed) {
        (this->*std::get<Directive::Special>(directive->read))(where);
    } else {
        throw Unreadable{};
    }
}

Token Parser::expect(Token::Kind kind, std::string_view what) {
    std::optional<Token> token = tokens_.next();
    if (token && token->kind == kind && !(kind == Token::Kind::word && is_directive(token->text))) {
        return *token;
    }
    if (!token) {
        diagnostics_.error(directive_where_,
                           fmt::format("the file ends inside {} (expected {})", directive_, what));
    } else if (token->kind != Token::Kind::invalid) {
        diagnostics_.error(token->where, fmt::format("{}: expected {}, found {}", directive_, what,
                                                     describe(*token)));
        tokens_.unget(*token);
    }
    throw Unreadable{};
}

std::string Parser::expect_string() {
    return string_value(expect(Token::Kind::string, "a string in quotes"));
}

double Parser::expect_number() {
    const Token token = expect(Token::Kind::word, "a number");
    if (const std::optional<double> value = parse_number(token.text)) return *value;
    diagnostics_.error(token.where, fmt::format("{}: expected a finite number, found {}",
                                                directive_, describe(token)));
    throw Unreadable{};
}

glm::dvec3 Parser::expect_vector() {
    glm::dvec3 v;
    for (int i = 0; i < 3; ++i)
        v[i] = expect_number();
    return v;
}

glm::dmat4 Parser::expect_matrix() {
    expect(Token::Kind::open, "[");
    std::array<double, 16> values{};
    for (double& value : values)
        value = expect_number();
    expect(Token::Kind::close, "] after 16 numbers");
    return matrix(values);
}

std::filesystem::path Parser::expect_file(const SourceLocation& where) {
    return files_.resolve(expect_string(), *where.file);
}

void Parser::read_active_transform(const SourceLocation&) {
    const Token token = expect(Token::Kind::word, "All, StartTime or EndTime");
    if (token.text != "All" && token.text != "StartTime" && token.text != "EndTime") {
        diagnostics_.error(token.where, fmt::format("ActiveTransform: expected All, StartTime or "
                                                    "EndTime, found {}",
                                                    describe(token)));
        return;
    }
    builder_.activate_transforms(token.text != "EndTime", token.text != "StartTime");
}

void Parser::read_concat_transform(const SourceLocation& where) {
    builder_.concat_transform(expect_matrix(), where);
}

void Parser::read_import(const SourceLocation& where) {
    const std::filesystem::path file = expect_file(where);
    if (!tokens_.open(file, where, TokenStream::FileKind::imported)) return;
    builder_.import_begin(where);
    parse();
    tokens_.leave_import();
    builder_.import_end(where);
}

void Parser::read_include(const SourceLocation& where) {
    tokens_.open(expect_file(where), where, TokenStream::FileKind::included);
}

void Parser::read_look_at(const SourceLocation& where) {
    const glm::dvec3 eye = expect_vector();
    const glm::dvec3 look = expect_vector();
    const glm::dvec3 up = expect_vector();
    if (const auto m = look_at(eye, look, up)) return builder_.concat_transform(*m, where);
    diagnostics_.error(where,
                       "LookAt fixes no direction (expected an eye apart from the point looked "
                       "at, and an up that is not along the line of sight)");
}

void Parser::read_medium_interface(const SourceLocation&) {
    const std::string inside = expect_string();
    std::string outside = inside;
    if (std::optional<Token> token = tokens_.next()) {
        if (token->kind == Token::Kind::string) {
            outside = string_value(*token);
        } else {
            tokens_.unget(*token);
        }
    }
    builder_.medium_interface(inside, outside);
}

void Parser::read_option(const SourceLocation& where) {
    const std::string name = expect_string();
    std::optional<Token> value = tokens_.next();
    const bool is_value =
        value && (value->kind == Token::Kind::string ||
                  (value->kind == Token::Kind::word && !is_directive(value->text)));
    if (!is_value) {
        if (value) tokens_.unget(*value);
        diagnostics_.error(where, fmt::format("Option {} has no value", in_quotes(name)));
        throw Unreadable{};
    }
    builder_.option(name, *value, where);
}

void Parser::read_rotate(const SourceLocation& where) {
    const double degrees = expect_number();
    const glm::dvec3 axis = expect_vector();
    if (const auto m = rotation(degrees, axis)) return builder_.concat_transform(*m, where);
    diagnostics_.error(where,
                       "Rotate: the axis has no length (expected a vector other than 0 0 0)");
}

void Parser::read_scale(const SourceLocation& where) {
    builder_.concat_transform(scaling(expect_vector()), where);
}

void Parser::read_texture(const SourceLocation& where) {
    expect_string();
    const std::string type = expect_string();
    const std::string texture_class = expect_string();
    const ParsedParameters parameters = parse_parameters(tokens_, diagnostics_);
    builder_.texture(type, texture_class, where);
    if (!parameters.complete) skip_to_directive(tokens_);
}

void Parser::read_transform(const SourceLocation& where) {
    builder_.set_transform(expect_matrix(), where);
}

void Parser::read_transform_begin(const SourceLocation& where) {
    if (!std::exchange(warned_of_transform_begin_, true)) {
        diagnostics_.warning(where, "TransformBegin and TransformEnd are deprecated; they do what "
                                    "AttributeBegin and AttributeEnd do");
    }
    builder_.attribute_begin(where);
}

void Parser::read_transform_times(const SourceLocation&) {
    expect_number();
    expect_number();
}

void Parser::read_translate(const SourceLocation& where) {
    builder_.concat_transform(translation(expect_vector()), where);
}

void Parser::read_world_end(const SourceLocation& where) {
    diagnostics_.error(where, "WorldEnd is no directive of pbrt-v4 (expected the end of the file)");
}

} // namespace tyndall

/// The directives of the scene language: syntax here, meaning in SceneBuilder.
#pragma once

#include "scene/scene_builder.h"
#include "scene/token_stream.h"

#include <string>
#include <string_view>

namespace tyndall {

/// Whether a word is the name of a directive of the scene language.
bool is_directive(std::string_view word);

/// Reads directives and hands them to the builder. After an error it goes on at the next directive.
class Parser {
  public:
    Parser(TokenStream& tokens, InputFiles& files, SceneBuilder& builder, Diagnostics& diagnostics)
        : tokens_(tokens), files_(files), builder_(builder), diagnostics_(diagnostics) {}

    /// Reads to the end of the tokens: of the scene, or of an imported file.
    void parse();

    // Directives with a syntax of their own; the table of all directives is in parser.cpp.
    void read_active_transform(const SourceLocation& where);
    void read_concat_transform(const SourceLocation& where);
    void read_import(const SourceLocation& where);
    void read_include(const SourceLocation& where);
    void read_look_at(const SourceLocation& where);
    void read_medium_interface(const SourceLocation& where);
    void read_option(const SourceLocation& where);
    void read_rotate(const SourceLocation& where);
    void read_scale(const SourceLocation& where);
    void read_texture(const SourceLocation& where);
    void read_transform(const SourceLocation& where);
    void read_transform_begin(const SourceLocation& where);
    void read_transform_times(const SourceLocation& where);
    void read_translate(const SourceLocation& where);
    void read_world_end(const SourceLocation& where);

  private:
    /// Thrown after an error was reported, where a directive cannot be read on.
    struct Unreadable {};

    void parse_directive(const Token& token);
    Token expect(Token::Kind kind, std::string_view what);
    std::string expect_string();
    double expect_number();
    glm::dvec3 expect_vector();
    glm::dmat4 expect_matrix();
    std::filesystem::path expect_file(const SourceLocation& where);

    TokenStream& tokens_;
    InputFiles& files_;
    SceneBuilder& builder_;
    Diagnostics& diagnostics_;
    std::string directive_; ///< The one that is being read, for messages.
    SourceLocation directive_where_;
    bool warned_of_transform_begin_ = false;
};

} // namespace tyndall

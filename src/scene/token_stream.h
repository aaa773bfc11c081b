/// The tokens of a scene across its files: an included file is read in the place of its Include.
#pragma once

#include "scene/input_files.h"
#include "scene/lexer.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tyndall {

class TokenStream {
  public:
    static constexpr std::size_t max_depth = 100;

    enum class FileKind {
        included, ///< At its end the tokens of the file around it follow.
        imported  ///< At its end next() gives nothing until leave_import().
    };

    TokenStream(InputFiles& files, Diagnostics& diagnostics)
        : files_(files), diagnostics_(diagnostics) {}

    /// Puts a file in front of the tokens to come. A file that cannot be read, that is open already
    /// or too deep inside others is an error at `from`.
    /// @return whether the file was opened.
    bool open(const std::filesystem::path& file, const SourceLocation& from, FileKind kind);

    /// The next token; nothing at the end. Tokens stay valid until new_directive().
    std::optional<Token> next();

    /// Gives a token back; the next call of next() returns it.
    void unget(Token token) { ungotten_ = std::move(token); }

    /// Closes an imported file that has come to its end.
    void leave_import() { pop(); }

    /// Lets go of the text of files that have come to their end.
    void new_directive() { finished_.clear(); }

  private:
    struct OpenFile {
        std::filesystem::path identity;
        std::unique_ptr<Lexer> lexer;
        FileKind kind;
    };
    void pop();
    std::string chain(const std::filesystem::path& file) const;

    InputFiles& files_;
    Diagnostics& diagnostics_;
    std::vector<OpenFile> open_files_;
    std::vector<OpenFile> finished_;
    std::optional<Token> ungotten_;
};

} // namespace tyndall

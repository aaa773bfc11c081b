#include "scene/token_stream.h"

#include <algorithm>
#include <fmt/core.h>
#include <utility>

namespace tyndall {

bool TokenStream::open(const std::filesystem::path& file, const SourceLocation& from,
                       FileKind kind) {
    std::error_code ignored;
    std::filesystem::path identity = std::filesystem::weakly_canonical(file, ignored);
    const bool is_open =
        std::any_of(open_files_.begin(), open_files_.end(),
                    [&](const OpenFile& other) { return other.identity == identity; });
    if (is_open) {
        diagnostics_.error(from, fmt::format("{} includes itself ({})",
                                             file_in_quotes(file.string()), chain(file)));
        return false;
    }
    if (open_files_.size() == max_depth) {
        diagnostics_.error(
            from, fmt::format("files are included more than {} deep ({})", max_depth, chain(file)));
        return false;
    }
    std::string contents;
    try {
        contents = files_.read(file);
    } catch (const Error& error) {
        diagnostics_.error(from, error.what());
        return false;
    }
    auto lexer = std::make_unique<Lexer>(std::move(contents), file.string(), diagnostics_);
    open_files_.push_back({std::move(identity), std::move(lexer), kind});
    return true;
}

std::optional<Token> TokenStream::next() {
    if (ungotten_) return std::exchange(ungotten_, std::nullopt);
    while (!open_files_.empty()) {
        if (std::optional<Token> token = open_files_.back().lexer->next()) return token;
        if (open_files_.back().kind == FileKind::imported) return std::nullopt;
        pop();
    }
    return std::nullopt;
}

void TokenStream::pop() {
    finished_.push_back(std::move(open_files_.back()));
    open_files_.pop_back();
}

std::string TokenStream::chain(const std::filesystem::path& file) const {
    constexpr std::size_t most = 8;
    std::string text;
    const std::size_t first = open_files_.size() > most ? open_files_.size() - most : 0;
    if (first > 0) text = "... -> ";
    for (std::size_t i = first; i < open_files_.size(); ++i) {
        text += open_files_[i].lexer->file_name() + " -> ";
    }
    return text + file.string();
}

} // namespace tyndall

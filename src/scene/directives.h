/// The table of all directives of the scene language.
#pragma once

#include "scene/parser.h"

#include <string_view>
#include <variant>

namespace tyndall {

struct Directive {
    /// Name "type" parameters
    using Typed = void (SceneBuilder::*)(const std::string&, const ParsedParameters&,
                                         const SourceLocation&);
    /// Name "name"
    using Named = void (SceneBuilder::*)(const std::string&, const SourceLocation&);
    /// Name
    using Plain = void (SceneBuilder::*)(const SourceLocation&);
    /// A syntax of its own.
    using Special = void (Parser::*)(const SourceLocation&);

    std::string_view name;
    SceneBuilder::Block block;
    std::variant<Typed, Named, Plain, Special> read;
};

/// The directive of that name, or null.
const Directive* find_directive(std::string_view name);

} // namespace tyndall

/// Reading of the parameters that follow a directive.
#pragma once

#include "scene/parameters.h"
#include "scene/token_stream.h"

namespace tyndall {

/// Skips tokens up to the next directive.
void skip_to_directive(TokenStream& tokens);

/// Reads `"type name" value` and `"type name" [ value ... ]` pairs up to the next token that is no
/// string. Values are checked against the type. After an error inside a value the parameter is
/// broken; after an error that leaves the list unreadable, tokens are skipped up to the next
/// directive.
ParsedParameters parse_parameters(TokenStream& tokens, Diagnostics& diagnostics);

} // namespace tyndall

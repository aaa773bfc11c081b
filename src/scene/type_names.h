/// Names of types of the scene language: those that Tyndall has, and those that only pbrt has.
#pragma once

#include "scene/diagnostics.h"

#include <initializer_list>
#include <string_view>

namespace tyndall {

struct TypeNames {
    std::string_view what; ///< For messages: "shape".
    std::initializer_list<std::string_view> supported;
    std::initializer_list<std::string_view> pbrt_only;
};

/// Reports a type that is not supported: as such if pbrt knows it, else as unknown.
/// @return whether it is supported.
bool check_type(const TypeNames& names, std::string_view type, const SourceLocation& where,
                Diagnostics& diagnostics);

} // namespace tyndall

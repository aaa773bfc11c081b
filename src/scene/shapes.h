/// Shapes from their parameters.
#pragma once

#include "scene/input_files.h"
#include "scene/parameters.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <variant>

namespace tyndall {

using Geometry = std::variant<Mesh, Sphere, Disk>;

/// The geometry of a Shape directive, in object space.
/// @return nothing after an error that leaves no shape; all errors are reported.
std::optional<Geometry> read_geometry(const std::string& type, Parameters& parameters,
                                      InputFiles& files);

} // namespace tyndall

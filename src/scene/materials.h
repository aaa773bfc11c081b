/// Materials from their parameters.
#pragma once

#include "scene/input_files.h"
#include "scene/parameters.h"
#include "scene/scene.h"

#include <string>

namespace tyndall {

/// Material or MakeNamedMaterial; "" and "none" are deprecated names of "interface". After an error
/// the material has default values.
Material read_material(const std::string& type, Parameters& parameters, InputFiles& files);

} // namespace tyndall

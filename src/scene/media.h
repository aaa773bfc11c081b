/// Participating media and materials from their parameters.
#pragma once

#include "scene/input_files.h"
#include "scene/parameters.h"
#include "scene/scene.h"

#include <string>

namespace tyndall {

/// MakeNamedMedium. After an error the medium has default values.
Medium read_medium(const std::string& name, Parameters& parameters, InputFiles& files);

/// Material or MakeNamedMaterial; "" and "none" are deprecated names of "interface". After an error
/// the material has default values.
Material read_material(const std::string& type, Parameters& parameters, InputFiles& files);

} // namespace tyndall

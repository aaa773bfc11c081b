/// Participating media from their parameters.
#pragma once

#include "scene/input_files.h"
#include "scene/parameters.h"
#include "scene/scene.h"

#include <string>

namespace tyndall {

/// MakeNamedMedium. After an error the medium has default values.
Medium read_medium(const std::string& name, Parameters& parameters,
                   const glm::dmat4& world_from_medium, InputFiles& files);

} // namespace tyndall

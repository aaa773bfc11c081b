/// Light sources from their parameters, with pbrt-v4's photometric scaling.
///
/// An rgb colour is the quantity itself; a spectrum counts with luminance 1 whatever its magnitude.
/// Both times "scale"; "power" (lumens) and "illuminance" (lux) then set the magnitude where they
/// are > 0, and are not there where they are <= 0, as in pbrt. Where both "power" and a colour are
/// given, the power multiplies the colour: pbrt does not divide by the luminance of an rgb.
///
/// Source: pbrt-v4, src/pbrt/lights.cpp.
#pragma once

#include "scene/input_files.h"
#include "scene/parameters.h"
#include "scene/scene.h"

#include <optional>
#include <string>

namespace tyndall {

/// An AreaLightSource directive; shapes that follow it emit.
struct AreaLightSource {
    Rgb radiance{1};  ///< Without the power.
    double power = 0; ///< Of each emitting primitive, lumens; 0: not given.
    bool two_sided = false;
    SourceLocation where;
    int shared_index = -1; ///< Of the AreaLight that all shapes share that can; -1: none yet.
};

/// @return nothing if the type is not supported; the error is reported.
std::optional<Light> read_light(const std::string& type, Parameters& parameters,
                                const glm::dmat4& world_from_light, InputFiles& files);

/// @return nothing if the type is not supported; the error is reported.
std::optional<AreaLightSource> read_area_light(const std::string& type, Parameters& parameters,
                                               InputFiles& files);

/// The light of a shape. Spheres and disks have their power divided by their area in object space,
/// as in pbrt; of a mesh, each triangle and each patch is a light of its own with the full power.
AreaLight make_area_light(const AreaLightSource& source, const Shape& shape);

} // namespace tyndall

/// Colours as parameters: rgb, blackbody or spectrum (values, a name or a file), turned into linear
/// sRGB.
#pragma once

#include "scene/input_files.h"
#include "scene/parameters.h"
#include "scene/scene.h"

#include <optional>
#include <string_view>

namespace tyndall {

/// Light, scaled as pbrt does: rgb as it is, spectra to luminance 1. Components >= 0; colours
/// outside of sRGB are clamped with a warning. Nothing if the parameter is not given or broken.
std::optional<Rgb> read_light_colour(Parameters& parameters, std::string_view name,
                                     InputFiles& files);

/// A reflectance in [0, 1], or the fallback.
Rgb read_reflectance(Parameters& parameters, std::string_view name, const Rgb& fallback,
                     InputFiles& files);

/// A coefficient >= 0 at the wavelengths of the channels, or the fallback.
Rgb read_coefficient(Parameters& parameters, std::string_view name, const Rgb& fallback,
                     InputFiles& files);

} // namespace tyndall

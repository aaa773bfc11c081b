/// What `info --phase` tells of the phase functions of a scene.
#pragma once

#include "scene/scene.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace tyndall::cli {

/// By medium: kinds, weights, mean cosines; of spheres also size parameters, efficiencies and cross
/// sections.
nlohmann::json describe_phases(const Scene& scene);

/// The same, printed.
void print_phases(const Scene& scene);

/// Writes an SVG file with a polar plot for each medium: the phase function by channel, on a
/// logarithmic radius, over a histogram of angles that the reference renderer's sampler draws from
/// it.
/// @throws Error  if the file cannot be written.
void plot_phases(const Scene& scene, const std::string& file);

} // namespace tyndall::cli

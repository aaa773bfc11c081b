#include "scene/media.h"

#include "scene/cloud.h"
#include "scene/colours.h"
#include "scene/grid_media.h"
#include "scene/media_presets.h"
#include "scene/phases.h"
#include "scene/transform.h"
#include "scene/type_names.h"
#include "scene/volume_media.h"

#include <cmath>
#include <fmt/format.h>

namespace tyndall {
namespace {

void read_coefficients(Parameters& parameters, Medium& medium, InputFiles& files) {
    const double scale = parameters.get_float("scale", 1, require::non_negative);
    const std::string preset = parameters.get_string("preset", "");
    if (preset == "air") {
        medium.sigma_a = Rgb(0);
        medium.sigma_s = air_scattering() * scale;
    } else if (preset.empty()) {
        medium.sigma_a = read_coefficient(parameters, "sigma_a", Rgb(1), files) * scale;
        medium.sigma_s = read_coefficient(parameters, "sigma_s", Rgb(1), files) * scale;
    } else if (const std::optional<MediumPreset> found = find_medium_preset(preset)) {
        medium.sigma_a = found->sigma_a * scale;
        medium.sigma_s = found->sigma_s * scale;
    } else {
        parameters.report_value(*parameters.find("string", "preset"), in_quotes(preset),
                                "one of air, " + medium_preset_names());
    }
}

void read_emission(Parameters& parameters, Medium& medium, InputFiles& files) {
    medium.emission = read_light_colour(parameters, "Le", files).value_or(Rgb(0)) *
                      parameters.get_float("Lescale", 1, require::non_negative);
}

void read_exponential(Parameters& parameters, Medium& medium) {
    ExponentialDensity density;
    density.scale_height = parameters.get_float("scaleheight", 1, require::positive);
    density.is_spherical = parameters.find("float", "radius") != nullptr;
    if (density.is_spherical) {
        density.radius = parameters.get_float("radius", 1, require::positive);
        density.origin = parameters.get_point3("center", {0, 0, 0});
    } else {
        density.origin = parameters.get_point3("origin", {0, 0, 0});
        const glm::dvec3 up = parameters.get_vector3("up", {0, 1, 0});
        if (!(glm::length(up) > 0)) {
            parameters.diagnostics().error(
                parameters.where(),
                fmt::format("{}: \"up\" has no direction (expected another vector than 0 0 0)",
                            parameters.subject()));
            return;
        }
        density.up = glm::normalize(up);
    }
    medium.density = density;
}

/// What a density in space of its own needs.
bool check_transform(Parameters& parameters, const Medium& medium) {
    if (is_invertible(medium.world_from_medium)) return true;
    parameters.diagnostics().error(
        parameters.where(),
        "the transformation has no inverse (expected one that keeps three dimensions)");
    return false;
}

} // namespace

Medium read_medium(const std::string& name, Parameters& parameters,
                   const glm::dmat4& world_from_medium, InputFiles& files) {
    static const TypeNames names{
        "medium",
        {"homogeneous", "uniformgrid", "rgbgrid", "cloud", "nanovdb", "vdb", "exponential"},
        {}};
    Medium medium;
    medium.name = name;
    medium.where = parameters.where();
    medium.world_from_medium = world_from_medium;
    const Parameter* type = parameters.find_required("string", "type");
    const std::string type_name = parameters.get_string("type", "homogeneous");
    if (!type || !check_type(names, type_name, parameters.where(), parameters.diagnostics())) {
        return medium;
    }
    if (type_name != "homogeneous" && !check_transform(parameters, medium)) return medium;
    medium.phases = read_phases(parameters, files);
    if (type_name == "rgbgrid") {
        read_rgb_grid(parameters, medium);
        parameters.report_unused();
        return medium;
    }
    read_coefficients(parameters, medium, files);
    if (type_name == "uniformgrid") {
        read_uniform_grid(parameters, medium, files);
    } else if (type_name == "cloud") {
        read_cloud(parameters, medium);
    } else if (type_name == "homogeneous" || type_name == "exponential") {
        read_emission(parameters, medium, files);
        if (type_name == "exponential") read_exponential(parameters, medium);
    } else {
        read_volume(parameters, medium, type_name == "vdb", files);
    }
    parameters.report_unused();
    return medium;
}

} // namespace tyndall

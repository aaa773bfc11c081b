#include "scene/media.h"

#include "scene/colours.h"
#include "scene/grid_media.h"
#include "scene/phases.h"
#include "scene/type_names.h"

namespace tyndall {
Medium read_medium(const std::string& name, Parameters& parameters,
                   const glm::dmat4& world_from_medium, InputFiles& files) {
    static const TypeNames names{"medium",
                                 {"homogeneous", "uniformgrid"},
                                 {"rgbgrid", "cloud", "nanovdb", "vdb", "exponential"}};
    Medium medium;
    medium.name = name;
    medium.where = parameters.where();
    medium.world_from_medium = world_from_medium;
    const Parameter* type = parameters.find_required("string", "type");
    const std::string type_name = parameters.get_string("type", "homogeneous");
    if (!type || !check_type(names, type_name, parameters.where(), parameters.diagnostics())) {
        return medium;
    }
    const double scale = parameters.get_float("scale", 1, require::non_negative);
    if (const std::string preset = parameters.get_string("preset", ""); preset == "air") {
        medium.sigma_a = Rgb(0);
        medium.sigma_s = air_scattering() * scale;
    } else {
        if (!preset.empty()) parameters.reject("string", "preset");
        medium.sigma_a = read_coefficient(parameters, "sigma_a", Rgb(1), files) * scale;
        medium.sigma_s = read_coefficient(parameters, "sigma_s", Rgb(1), files) * scale;
    }
    const std::optional<Rgb> emission = read_light_colour(parameters, "Le", files);
    medium.emission = emission.value_or(Rgb(0));
    medium.phases = read_phases(parameters, files);
    if (type_name == "uniformgrid") {
        read_uniform_grid(parameters, medium);
    } else {
        medium.emission *= parameters.get_float("Lescale", 1, require::non_negative);
    }
    parameters.report_unused();
    return medium;
}

} // namespace tyndall

#include "scene/media.h"

#include "scene/colours.h"
#include "scene/type_names.h"

namespace tyndall {
namespace {

PhaseFunction read_phase_function(Parameters& parameters) {
    static const TypeNames names{
        "phase function", {"henyey-greenstein"}, {"schlick", "rayleigh", "mie", "isotropic"}};
    const std::string kind = parameters.get_string("phase", "henyey-greenstein");
    check_type(names, kind, parameters.where(), parameters.diagnostics());
    return {.kind = PhaseFunction::Kind::henyey_greenstein,
            .g = parameters.get_float("g", 0, require::cosine)};
}

} // namespace

Medium read_medium(const std::string& name, Parameters& parameters, InputFiles& files) {
    static const TypeNames names{
        "medium",
        {"homogeneous"},
        {"uniformgrid", "rgbgrid", "cloud", "nanovdb", "vdb", "exponential"}};
    Medium medium;
    medium.name = name;
    medium.where = parameters.where();
    const Parameter* type = parameters.find_required("string", "type");
    const std::string type_name = parameters.get_string("type", "homogeneous");
    if (!type || !check_type(names, type_name, parameters.where(), parameters.diagnostics())) {
        return medium;
    }
    parameters.reject("string", "preset");
    const double scale = parameters.get_float("scale", 1, require::non_negative);
    medium.sigma_a = read_coefficient(parameters, "sigma_a", Rgb(1), files) * scale;
    medium.sigma_s = read_coefficient(parameters, "sigma_s", Rgb(1), files) * scale;
    medium.emission = read_light_colour(parameters, "Le", files).value_or(Rgb(0)) *
                      parameters.get_float("Lescale", 1, require::non_negative);
    medium.phases.front() = read_phase_function(parameters);
    parameters.report_unused();
    return medium;
}

Material read_material(const std::string& type, Parameters& parameters, InputFiles& files) {
    static const TypeNames names{"material",
                                 {"diffuse", "interface"},
                                 {"coateddiffuse", "coatedconductor", "conductor", "dielectric",
                                  "diffusetransmission", "hair", "measured", "mix", "subsurface",
                                  "thindielectric"}};
    Material material;
    material.where = parameters.where();
    const bool is_deprecated = type.empty() || type == "none";
    if (is_deprecated) {
        parameters.diagnostics().warning(
            parameters.where(), "material \"" + type + "\" is deprecated (use \"interface\")");
    }
    if (!is_deprecated && !check_type(names, type, parameters.where(), parameters.diagnostics())) {
        return material;
    }
    parameters.reject_texture("displacement");
    parameters.reject("string", "normalmap");
    if (type == "diffuse") {
        material.kind = Material::Kind::diffuse;
        parameters.reject_texture("reflectance");
        material.reflectance = read_reflectance(parameters, "reflectance", Rgb(0.5), files);
    } else {
        material.kind = Material::Kind::interface;
    }
    parameters.report_unused();
    return material;
}

} // namespace tyndall

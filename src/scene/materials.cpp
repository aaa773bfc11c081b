#include "scene/materials.h"

#include "scene/colours.h"
#include "scene/material_spectra.h"
#include "scene/type_names.h"

#include <cmath>
#include <fmt/format.h>

namespace tyndall {
namespace {

/// GGX roughness of a surface that is equally rough in all directions.
double read_alpha(Parameters& parameters) {
    for (const char* name : {"roughness", "uroughness", "vroughness"})
        parameters.reject_texture(name);
    const double roughness = parameters.get_float("roughness", 0, require::non_negative);
    const double u = parameters.get_float("uroughness", roughness, require::non_negative);
    const double v = parameters.get_float("vroughness", roughness, require::non_negative);
    if (u != v) {
        parameters.diagnostics().error(
            parameters.where(),
            fmt::format(
                "{}: \"uroughness\" {} and \"vroughness\" {} differ: anisotropic roughness is "
                "not supported yet",
                parameters.subject(), u, v));
    }
    // pbrt-v4, TrowbridgeReitzDistribution::RoughnessToAlpha.
    return parameters.get_bool("remaproughness", true) ? std::sqrt(u) : u;
}

/// An index of refraction between two transparent bodies, from a number or a spectrum.
Rgb read_eta(Parameters& parameters, InputFiles& files) {
    constexpr double glass = 1.5;
    const double eta = parameters.get_float("eta", glass, require::positive);
    const Rgb spectrum = read_coefficient(parameters, "eta", Rgb(eta), files);
    if (glm::all(glm::greaterThan(spectrum, Rgb(0)))) return spectrum;
    parameters.diagnostics().error(
        parameters.where(),
        fmt::format("{}: \"eta\" is 0 at the wavelength of a channel, 464.3, 549.1 or 611.4 nm "
                    "(expected an index > 0)",
                    parameters.subject()));
    return Rgb(glass);
}

void read_conductor(Parameters& parameters, Material& material, InputFiles& files) {
    for (const char* name : {"eta", "k", "reflectance"})
        parameters.reject_texture(name);
    const Parameter* eta = parameters.find_colour("eta");
    const Parameter* k = parameters.find_colour("k");
    if (const Parameter* reflectance = parameters.find_colour("reflectance")) {
        if (eta || k) {
            parameters.diagnostics().error(
                reflectance->where,
                fmt::format("{} has both {} and an index (expected one of them)",
                            parameters.subject(), reflectance->title()));
        }
        // The index whose reflectance at normal incidence is r (pbrt-v4, ConductorMaterial).
        const Rgb r =
            glm::min(read_reflectance(parameters, "reflectance", Rgb(0.5), files), Rgb(0.9999));
        material.eta = Rgb(1);
        material.k = 2.0 * glm::sqrt(r / (1.0 - r));
        return;
    }
    const Rgb copper_eta = channel_values(*material_spectrum("metal-Cu-eta"));
    const Rgb copper_k = channel_values(*material_spectrum("metal-Cu-k"));
    material.eta = read_coefficient(parameters, "eta", copper_eta, files);
    material.k = read_coefficient(parameters, "k", copper_k, files);
}

} // namespace

Material read_material(const std::string& type, Parameters& parameters, InputFiles& files) {
    static const TypeNames names{
        "material",
        {"diffuse", "dielectric", "thindielectric", "conductor", "interface"},
        {"coateddiffuse", "coatedconductor", "diffusetransmission", "hair", "measured", "mix",
         "subsurface"}};
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
    } else if (type == "dielectric") {
        material.kind = Material::Kind::dielectric;
        material.eta = read_eta(parameters, files);
        material.alpha = read_alpha(parameters);
    } else if (type == "thindielectric") {
        material.kind = Material::Kind::thin_dielectric;
        material.eta = read_eta(parameters, files);
    } else if (type == "conductor") {
        material.kind = Material::Kind::conductor;
        read_conductor(parameters, material, files);
        material.alpha = read_alpha(parameters);
    } else {
        material.kind = Material::Kind::interface;
    }
    parameters.report_unused();
    return material;
}

} // namespace tyndall

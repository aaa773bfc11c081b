#include "scene/materials.h"

#include "scene/colours.h"
#include "scene/type_names.h"

namespace tyndall {

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

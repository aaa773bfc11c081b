#include "scene/lights.h"

#include "scene/colours.h"
#include "scene/transform.h"
#include "scene/type_names.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace tyndall {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Colour times scale.
Rgb read_scaled_colour(Parameters& parameters, std::string_view name, InputFiles& files) {
    const Rgb colour = read_light_colour(parameters, name, files).value_or(Rgb(1));
    return colour * parameters.get_float("scale", 1, require::non_negative);
}

/// The factor that a magnitude such as "power" brings: value / reference, or 1 without it.
double read_magnitude(Parameters& parameters, std::string_view name, double reference) {
    const double value = parameters.get_float(name, -1);
    return value > 0 ? value / reference : 1;
}

/// "from" and "to" in light space, apart from each other.
struct Segment {
    glm::dvec3 from;
    glm::dvec3 to;
};
Segment read_segment(Parameters& parameters) {
    Segment segment{parameters.get_point3("from", {0, 0, 0}),
                    parameters.get_point3("to", {0, 0, 1})};
    if (segment.from == segment.to) {
        parameters.diagnostics().error(
            parameters.where(),
            fmt::format("{}: \"from\" and \"to\" are the same point (expected two "
                        "points)",
                        parameters.subject()));
        segment.to = segment.from + glm::dvec3(0, 0, 1);
    }
    return segment;
}

InfiniteLight read_infinite(Parameters& parameters, InputFiles& files) {
    parameters.reject("string", "filename");
    parameters.reject("point3", "portal");
    const Rgb radiance = read_scaled_colour(parameters, "L", files);
    // A hemisphere of radiance 1 gives an irradiance of pi.
    return {radiance * read_magnitude(parameters, "illuminance", pi)};
}

DistantLight read_distant(Parameters& parameters, const glm::dmat4& world_from_light,
                          InputFiles& files) {
    const Segment segment = read_segment(parameters);
    const Rgb irradiance = read_scaled_colour(parameters, "L", files);
    const glm::dvec3 travel = transform_vector(world_from_light, segment.to - segment.from);
    return {irradiance * read_magnitude(parameters, "illuminance", 1), glm::normalize(travel)};
}

PointLight read_point(Parameters& parameters, const glm::dmat4& world_from_light,
                      InputFiles& files) {
    const glm::dvec3 from = parameters.get_point3("from", {0, 0, 0});
    const Rgb intensity = read_scaled_colour(parameters, "I", files);
    return {intensity * read_magnitude(parameters, "power", 4 * pi),
            transform_point(world_from_light, from)};
}

SpotLight read_spot(Parameters& parameters, const glm::dmat4& world_from_light, InputFiles& files) {
    const Segment segment = read_segment(parameters);
    constexpr Requirement is_cone{[](double x) { return x > 0 && x <= 180; },
                                  "a value in (0, 180]"};
    const double cone = parameters.get_float("coneangle", 30, is_cone);
    const double delta = parameters.get_float("conedeltaangle", 5, require::non_negative);
    // pbrt's default of 5 may exceed a small cone; the cosine then folds the start back into it.
    if (delta > 2 * cone) {
        parameters.diagnostics().error(
            parameters.where(),
            fmt::format("{}: \"conedeltaangle\" is {} (expected at most twice the "
                        "coneangle, {})",
                        parameters.subject(), delta, cone));
    }
    if (!is_similarity(world_from_light)) {
        parameters.diagnostics().warning(
            parameters.where(), "the transformation of the spot light does not keep angles; "
                                "its cone stays round");
    }
    const Rgb intensity = read_scaled_colour(parameters, "I", files);
    SpotLight light;
    light.position = transform_point(world_from_light, segment.from);
    light.axis = glm::normalize(transform_vector(world_from_light, segment.to - segment.from));
    light.cos_total_width = std::cos(glm::radians(cone));
    light.cos_falloff_start = std::cos(glm::radians(cone - delta));
    // Integral of the falloff over directions: the smoothstep counts half.
    const double integral =
        2 * pi *
        ((1 - light.cos_falloff_start) + (light.cos_falloff_start - light.cos_total_width) / 2);
    light.intensity = intensity * read_magnitude(parameters, "power", integral);
    return light;
}

/// Area in object space, as pbrt has it.
double object_area(const Sphere& sphere) {
    return sphere.phi_max * sphere.radius * (sphere.z_max - sphere.z_min);
}
double object_area(const Disk& disk) {
    return disk.phi_max / 2 * (disk.radius * disk.radius - disk.inner_radius * disk.inner_radius);
}

} // namespace

std::optional<Light> read_light(const std::string& type, Parameters& parameters,
                                const glm::dmat4& world_from_light, InputFiles& files) {
    static const TypeNames names{
        "light", {"point", "spot", "distant", "infinite"}, {"goniometric", "projection"}};
    if (!check_type(names, type, parameters.where(), parameters.diagnostics())) return std::nullopt;
    Light light;
    light.where = parameters.where();
    if (type == "infinite") {
        light.emitter = read_infinite(parameters, files);
    } else if (type == "distant") {
        light.emitter = read_distant(parameters, world_from_light, files);
    } else if (type == "point") {
        light.emitter = read_point(parameters, world_from_light, files);
    } else {
        light.emitter = read_spot(parameters, world_from_light, files);
    }
    parameters.report_unused();
    return light;
}

std::optional<AreaLightSource> read_area_light(const std::string& type, Parameters& parameters,
                                               InputFiles& files) {
    static const TypeNames names{"area light", {"diffuse"}, {}};
    if (!check_type(names, type, parameters.where(), parameters.diagnostics())) return std::nullopt;
    AreaLightSource source;
    source.where = parameters.where();
    parameters.reject("string", "filename");
    source.radiance = read_scaled_colour(parameters, "L", files);
    source.power = std::max(parameters.get_float("power", -1), 0.0);
    source.two_sided = parameters.get_bool("twosided", false);
    parameters.report_unused();
    return source;
}

AreaLight make_area_light(const AreaLightSource& source, const Shape& shape) {
    AreaLight light;
    light.two_sided = source.two_sided;
    light.radiance = source.radiance;
    if (source.power == 0) return light;
    // The radiance 1 over an area A gives the power pi A on each side that emits.
    const Rgb power_radiance = source.radiance * source.power / (pi * (source.two_sided ? 2 : 1));
    if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
        light.radiance = power_radiance / object_area(*sphere);
    } else if (const auto* disk = std::get_if<Disk>(&shape.geometry)) {
        light.radiance = power_radiance / object_area(*disk);
    } else {
        light.radiance = Rgb(0);
        light.power_radiance = power_radiance;
    }
    return light;
}

} // namespace tyndall

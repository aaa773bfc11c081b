#include "scene/options.h"

#include "scene/type_names.h"

#include <fmt/core.h>
#include <limits>

namespace tyndall {
namespace {

/// A string that must be one of a few; the rest is unknown.
std::string read_choice(Parameters& parameters, std::string_view name, const std::string& fallback,
                        const TypeNames& names) {
    const std::string value = parameters.get_string(name, fallback);
    check_type(names, value, parameters.where(), parameters.diagnostics());
    return value;
}

void read_screen_window(Parameters& parameters, Camera& camera) {
    const Parameter* window = parameters.find("float", "screenwindow");
    if (!window) return;
    const std::vector<double>& w = window->numbers;
    if (w.size() != 4 || w[0] == w[1] || w[2] == w[3]) {
        parameters.diagnostics().error(
            window->where, "parameter \"float screenwindow\" is no window (expected x0 x1 y0 y1)");
        return;
    }
    camera.screen_window = {w[0], w[1], w[2], w[3]};
    camera.screen_window_given = true;
}

/// How many steps a march has, or how long they are.
void read_steps(Parameters& parameters, Integrator& integrator) {
    const Parameter* size = parameters.find("float", "stepsize");
    const Parameter* count = parameters.find("integer", "steps");
    constexpr Requirement few{[](double x) { return x >= 1 && x <= 4096; }, "1 to 4096 steps"};
    integrator.steps = parameters.get_integer("steps", integrator.steps, few);
    if (size) integrator.step_size = parameters.get_float("stepsize", 0, require::positive);
    if (size && count)
        parameters.diagnostics().error(size->where,
                                       "parameters \"float stepsize\" and \"integer steps\" "
                                       "exclude each other");
}

/// Tyndall's own parameters of integrators: which estimators they are made of.
void read_technique(Parameters& parameters, Integrator& integrator) {
    static const TypeNames absorptions{"absorption", {"expected", "analog"}, {}};
    static const TypeNames transmittances{"transmittance", {"tracked", "marched"}, {}};
    static const TypeNames placements{"placement", {"uniform", "jittered", "equiangular"}, {}};
    const bool marches = integrator.kind == Integrator::Kind::singlescatter;
    if (!marches) integrator.samples_lights = parameters.get_bool("lightsampling", true);
    if (integrator.kind == Integrator::Kind::path) return;
    if (!marches && read_choice(parameters, "absorption", "expected", absorptions) == "analog")
        integrator.absorption = Integrator::Absorption::analog;
    if (read_choice(parameters, "transmittance", "tracked", transmittances) == "marched")
        integrator.transmittance = Integrator::Transmittance::marched;
    read_steps(parameters, integrator);
    if (!marches) return;
    const std::string placement = read_choice(parameters, "placement", "uniform", placements);
    if (placement == "jittered") integrator.placement = Integrator::Placement::jittered;
    if (placement == "equiangular") integrator.placement = Integrator::Placement::equiangular;
}

} // namespace

Camera read_camera(const std::string& type, Parameters& parameters) {
    static const TypeNames names{
        "camera", {"perspective", "orthographic"}, {"realistic", "spherical"}};
    Camera camera;
    if (!check_type(names, type, parameters.where(), parameters.diagnostics())) return camera;
    constexpr Requirement is_fov{[](double x) { return x > 0 && x < 180; }, "a value in (0, 180)"};
    if (type == "perspective") {
        camera.kind = Camera::Kind::perspective;
        camera.fov = parameters.get_float("fov", 90, is_fov);
    } else {
        camera.kind = Camera::Kind::orthographic;
    }
    camera.lens_radius = parameters.get_float("lensradius", 0, require::non_negative);
    camera.focal_distance = parameters.get_float("focaldistance", 1e6, require::positive);
    // Without the parameter the aspect is that of the film: 0 here.
    if (parameters.find("float", "frameaspectratio")) {
        camera.frame_aspect_ratio = parameters.get_float("frameaspectratio", 0, require::positive);
    }
    read_screen_window(parameters, camera);
    const double open = parameters.get_float("shutteropen", 0);
    const double close = parameters.get_float("shutterclose", 1);
    camera.shutter_seconds = close - open;
    if (close <= open) {
        parameters.diagnostics().error(
            parameters.where(),
            fmt::format("the shutter closes at {} and opens at {} (expected it to open first)",
                        close, open));
        camera.shutter_seconds = 1;
    }
    parameters.report_unused();
    return camera;
}

PixelFilter read_pixel_filter(const std::string& type, Parameters& parameters) {
    static const TypeNames names{
        "pixel filter", {"box", "gaussian", "triangle", "mitchell"}, {"sinc"}};
    PixelFilter filter;
    if (!check_type(names, type, parameters.where(), parameters.diagnostics())) return filter;
    double radius = 2;
    if (type == "box") {
        filter.kind = PixelFilter::Kind::box;
        radius = 0.5;
    } else if (type == "gaussian") {
        filter.kind = PixelFilter::Kind::gaussian;
        radius = 1.5;
        filter.sigma = parameters.get_float("sigma", 0.5, require::positive);
    } else if (type == "triangle") {
        filter.kind = PixelFilter::Kind::triangle;
    } else {
        filter.kind = PixelFilter::Kind::mitchell;
        filter.b = parameters.get_float("B", 1.0 / 3, require::non_negative);
        filter.c = parameters.get_float("C", 1.0 / 3, require::non_negative);
        if (filter.b > 3) // then it is negative in the middle
            parameters.diagnostics().error(parameters.where(),
                                           "\"B\" is above 3 (expected 0 to 1)");
    }
    filter.x_radius = parameters.get_float("xradius", radius, require::positive);
    filter.y_radius = parameters.get_float("yradius", radius, require::positive);
    parameters.report_unused();
    return filter;
}

Integrator::Kind integrator_kind(std::string_view name) {
    if (name == "path") return Integrator::Kind::path;
    if (name == "singlescatter") return Integrator::Kind::singlescatter;
    return Integrator::Kind::volpath;
}

Integrator read_integrator(const std::string& type, Parameters& parameters) {
    static const TypeNames names{"integrator",
                                 {"volpath", "path", "singlescatter"},
                                 {"ambientocclusion", "bdpt", "function", "lightpath", "mlt",
                                  "randomwalk", "simplepath", "simplevolpath", "sppm"}};
    static const TypeNames light_samplers{
        "light sampler", {"bvh", "power", "uniform", "exhaustive"}, {}};
    Integrator integrator;
    if (!check_type(names, type, parameters.where(), parameters.diagnostics())) return integrator;
    integrator.kind = integrator_kind(type);
    integrator.max_depth = parameters.get_integer("maxdepth", 5, require::non_negative);
    read_technique(parameters, integrator);
    read_choice(parameters, "lightsampler", "bvh", light_samplers);
    if (parameters.get_bool("regularize", false)) parameters.reject("bool", "regularize");
    parameters.report_unused();
    return integrator;
}

SamplerSettings read_sampler(const std::string& type, Parameters& parameters) {
    static const TypeNames names{
        "sampler",
        {"zsobol", "sobol", "paddedsobol", "halton", "pmj02bn", "independent", "stratified"},
        {}};
    static const TypeNames randomizations{
        "randomization", {"fastowen", "owen", "permutedigits", "none"}, {}};
    SamplerSettings settings;
    if (!check_type(names, type, parameters.where(), parameters.diagnostics())) return settings;
    settings.sampler = type == "independent" ? Sampler::independent
                       : type == "zsobol"    ? Sampler::zsobol
                                             : Sampler::sobol;
    if (type == "stratified") {
        const std::int64_t x = parameters.get_integer("xsamples", 4, require::positive);
        const std::int64_t y = parameters.get_integer("ysamples", 4, require::positive);
        parameters.get_bool("jitter", true);
        const std::int64_t samples = x * y;
        if (samples > std::numeric_limits<int>::max()) {
            parameters.diagnostics().error(
                parameters.where(),
                fmt::format("{} samples per pixel (expected fewer than 2^31)", samples));
        } else {
            settings.samples_per_pixel = static_cast<int>(samples);
        }
    } else {
        const int fallback = type == "independent" ? 4 : 16;
        settings.samples_per_pixel =
            parameters.get_integer("pixelsamples", fallback, require::positive);
    }
    if (type.ends_with("sobol") || type == "halton") {
        read_choice(parameters, "randomization", "owen", randomizations);
    }
    if (parameters.find("integer", "seed")) {
        const int seed = parameters.get_integer("seed", 0);
        settings.seed = static_cast<std::uint32_t>(seed);
    }
    parameters.report_unused();
    return settings;
}

void read_accelerator(const std::string& type, Parameters& parameters) {
    static const TypeNames names{"accelerator", {"bvh", "kdtree"}, {}};
    static const TypeNames methods{"split method", {"sah", "hlbvh", "middle", "equal"}, {}};
    if (!check_type(names, type, parameters.where(), parameters.diagnostics())) return;
    if (type == "bvh") {
        read_choice(parameters, "splitmethod", "sah", methods);
        parameters.get_integer("maxnodeprims", 4);
    } else {
        for (const char* name : {"intersectcost", "traversalcost", "maxprims", "maxdepth"}) {
            parameters.get_integer(name, 0);
        }
        parameters.get_float("emptybonus", 0.5);
    }
    parameters.report_unused();
}

} // namespace tyndall

#include "scene/options.h"
#include "scene/type_names.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/core.h>

namespace tyndall {
namespace {

void read_resolution(Parameters& parameters, Film& film) {
    film.width = parameters.get_integer("xresolution", 1280, require::positive);
    film.height = parameters.get_integer("yresolution", 720, require::positive);
    constexpr std::int64_t most_pixels = (std::int64_t{1} << 31) - 1;
    constexpr int most_across = 65535; // as --size has it: a path keeps its pixel in 16 bits each
    if (std::int64_t{film.width} * film.height > most_pixels) {
        parameters.diagnostics().error(
            parameters.where(),
            fmt::format("{} x {} are too many pixels (expected fewer than 2^31)", film.width,
                        film.height));
        film.width = film.height = 1;
    } else if (std::max(film.width, film.height) > most_across) {
        parameters.diagnostics().error(
            parameters.where(), fmt::format("{} x {} pixels (expected at most {} on each side)",
                                            film.width, film.height, most_across));
        film.width = film.height = 1;
    }
    film.bounds = {0, film.width, 0, film.height};
}

/// "pixelbounds", cut to the picture.
void read_pixel_bounds(Parameters& parameters, Film& film) {
    const Parameter* bounds = parameters.find("integer", "pixelbounds");
    if (!bounds) return;
    const std::vector<int>& b = bounds->integers;
    if (b.size() != 4) {
        parameters.diagnostics().error(
            bounds->where, fmt::format("parameter \"integer pixelbounds\" has {} values "
                                       "(expected x0 x1 y0 y1)",
                                       b.size()));
        return;
    }
    film.bounds = {std::clamp(b[0], 0, film.width), std::clamp(b[1], 0, film.width),
                   std::clamp(b[2], 0, film.height), std::clamp(b[3], 0, film.height)};
    const PixelBounds& cut = film.bounds;
    if (cut.x0 != b[0] || cut.x1 != b[1] || cut.y0 != b[2] || cut.y1 != b[3]) {
        parameters.diagnostics().warning(
            bounds->where, "the pixel bounds go beyond the picture; they are cut to it");
    }
}

/// "cropwindow", shares of the picture, rounded up to pixels on both sides as in pbrt.
void read_crop_window(Parameters& parameters, Film& film) {
    const Parameter* window = parameters.find("float", "cropwindow");
    if (!window) return;
    const std::vector<double>& w = window->numbers;
    if (w.size() != 4) {
        parameters.diagnostics().error(window->where,
                                       fmt::format("parameter \"float cropwindow\" has {} values "
                                                   "(expected x0 x1 y0 y1)",
                                                   w.size()));
        return;
    }
    if (parameters.find("integer", "pixelbounds")) {
        parameters.diagnostics().warning(
            window->where, "both pixelbounds and cropwindow are given; cropwindow counts");
    }
    const auto pixel = [](double share, int size) {
        return static_cast<int>(std::ceil(std::clamp(share, 0.0, 1.0) * size));
    };
    film.bounds = {pixel(std::min(w[0], w[1]), film.width), pixel(std::max(w[0], w[1]), film.width),
                   pixel(std::min(w[2], w[3]), film.height),
                   pixel(std::max(w[2], w[3]), film.height)};
}

void check_sensor(Parameters& parameters) {
    const std::string sensor = parameters.get_string("sensor", "cie1931");
    if (sensor != "cie1931") {
        parameters.diagnostics().error(
            parameters.where(), fmt::format("sensor {} is not supported yet", in_quotes(sensor)));
    }
    if (parameters.get_float("whitebalance", 0, require::non_negative) != 0) {
        parameters.reject("float", "whitebalance");
    }
}

} // namespace

Film read_film(const std::string& type, Parameters& parameters) {
    static const TypeNames names{"film", {"rgb"}, {"gbuffer", "spectral"}};
    Film film;
    if (!check_type(names, type, parameters.where(), parameters.diagnostics())) return film;
    read_resolution(parameters, film);
    read_pixel_bounds(parameters, film);
    read_crop_window(parameters, film);
    if (film.bounds.width() <= 0 || film.bounds.height() <= 0) {
        parameters.diagnostics().error(parameters.where(),
                                       "no pixel is left to render (expected bounds with an area)");
    }
    film.filename = parameters.get_string("filename", "pbrt.exr");
    if (film.filename.empty()) film.filename = "pbrt.exr"; // pbrt's rule
    film.iso = parameters.get_float("iso", 100, require::positive);
    film.max_component_value =
        parameters.get_float("maxcomponentvalue", film.max_component_value, require::positive);
    film.half_float = parameters.get_bool("savefp16", true) && parameters.find("bool", "savefp16");
    parameters.get_float("diagonal", 35,
                         require::positive); // only a realistic camera has a use for it
    check_sensor(parameters);
    parameters.report_unused();
    return film;
}

} // namespace tyndall

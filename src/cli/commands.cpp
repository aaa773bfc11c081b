#include "cli/options.h"
#include "cli/progress_line.h"
#include "core/error.h"
#include "core/json_text.h"
#include "gpu/context.h"
#include "scene/options.h"
#include "scene/reader.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tyndall::cli {
namespace {

using nlohmann::json;

/// Numbers separated by `separator`; throws if there are not exactly `count`, or anything else.
std::vector<double> parse_numbers(const std::string& option, const std::string& text,
                                  char separator, std::size_t count, const char* form) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* end = at + text.size();
    while (at <= end) {
        double number = 0;
        const auto [next, problem] = std::from_chars(at, end, number);
        if (problem != std::errc() || !std::isfinite(number)) break;
        numbers.push_back(number);
        if (next == end) {
            if (numbers.size() == count) return numbers;
            break;
        }
        if (*next != separator) break;
        at = next + 1;
    }
    throw Error(ExitStatus::bad_input,
                fmt::format("{} \"{}\" is not of the form {}", option, text, form));
}

void apply_size(Scene& scene, const std::string& text) {
    const auto size = parse_numbers("--size", text, 'x', 2, "WxH, e.g. 640x480");
    const auto valid = [](double n) { return n >= 1 && n <= 65535 && n == std::floor(n); };
    if (!valid(size[0]) || !valid(size[1]))
        throw Error(ExitStatus::bad_input,
                    fmt::format("--size {} (expected whole numbers from 1 to 65535)", text));
    resize_film(scene, static_cast<int>(size[0]), static_cast<int>(size[1]));
}

void apply_crop(Scene& scene, const std::string& text) {
    const auto c = parse_numbers("--crop", text, ',', 4, "X0,X1,Y0,Y1");
    if (!(0 <= c[0] && c[0] < c[1] && c[1] <= 1 && 0 <= c[2] && c[2] < c[3] && c[3] <= 1))
        throw Error(
            ExitStatus::bad_input,
            fmt::format("--crop {} (expected 0 <= X0 < X1 <= 1 and 0 <= Y0 < Y1 <= 1)", text));
    const Film& film = scene.film;
    const auto pixel = [](double share, int size) {
        return static_cast<int>(std::ceil(share * size));
    };
    scene.film.bounds = {pixel(c[0], film.width), pixel(c[1], film.width), pixel(c[2], film.height),
                         pixel(c[3], film.height)};
}

} // namespace

void resize_film(Scene& scene, int width, int height) {
    Film& film = scene.film;
    const double x_scale = double(width) / film.width, y_scale = double(height) / film.height;
    film.width = width;
    film.height = height;
    // The scene's own crop window stays the same part of the picture.
    const auto scaled = [](int at, double by, int limit) {
        return std::clamp(static_cast<int>(std::ceil(at * by)), 0, limit);
    };
    PixelBounds& b = film.bounds;
    b = {scaled(b.x0, x_scale, film.width), scaled(b.x1, x_scale, film.width),
         scaled(b.y0, y_scale, film.height), scaled(b.y1, y_scale, film.height)};
    fit_screen_window(scene);
}

Scene load_scene(const SceneOptions& options, bool quiet) {
    Scene scene;
    {
        ProgressLine line(quiet);
        constexpr std::uint64_t large = 16u << 20; // takes seconds, if it is a volume
        scene = read_scene(options.scene, {.on_file = [&](const auto& file, std::uint64_t bytes) {
                               if (bytes >= large || line.is_due())
                                   line.print(fmt::format("reading {} ({:.1f} MiB)", file.string(),
                                                          static_cast<double>(bytes) / (1 << 20)));
                           }});
    }
    for (const std::string& warning : scene.warnings)
        std::fprintf(stderr, "%s\n", warning.c_str());
    if (options.size) apply_size(scene, *options.size);
    if (options.crop) apply_crop(scene, *options.crop);
    if (scene.film.bounds.width() <= 0 || scene.film.bounds.height() <= 0)
        throw Error(ExitStatus::bad_input, "the part of the picture to render has no pixels");
    if (options.spp) scene.samples_per_pixel = static_cast<int>(*options.spp);
    if (options.seed) scene.seed = *options.seed;
    if (options.max_depth) scene.integrator.max_depth = *options.max_depth;
    if (options.integrator) scene.integrator.kind = integrator_kind(*options.integrator);
    return scene;
}

int run_devices(const DevicesOptions& options) {
    const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
    json list = json::array();
    for (const gpu::DeviceInfo& d : devices)
        list.push_back({{"name", d.name},
                        {"driver", d.driver},
                        {"type", d.type},
                        {"vulkan", d.api_version},
                        {"missing", d.missing},
                        {"memory_bytes", d.memory_bytes},
                        {"max_texel_buffer_elements", d.max_texel_buffer_elements},
                        {"max_storage_buffer_bytes", d.max_storage_buffer_bytes}});
    if (options.json) {
        std::printf("%s\n", json_text(list, 2).c_str());
    } else {
        for (std::size_t i = 0; i < devices.size(); ++i)
            std::printf(
                "%zu: %s\n   %s, %s, Vulkan %s\n   %s\n", i, devices[i].name.c_str(),
                devices[i].type.c_str(), devices[i].driver.c_str(), devices[i].api_version.c_str(),
                devices[i].missing.empty() ? "usable" : ("lacks " + devices[i].missing).c_str());
        std::printf("reference: the renderer in double precision on the CPU, for comparison\n");
    }
    return static_cast<int>(devices.empty() ? ExitStatus::no_device : ExitStatus::done);
}

} // namespace tyndall::cli

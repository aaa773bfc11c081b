#include "cli/report.h"

#include "cli/progress_line.h"
#include "core/atomic_file.h"

#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

namespace tyndall::cli {
namespace {

using nlohmann::json;

double path_count(const Scene& scene, const RenderReport& report) {
    return static_cast<double>(scene.film.bounds.width()) * scene.film.bounds.height() *
           report.samples;
}

Matrix44 to_matrix44(const glm::dmat4& m) {
    Matrix44 result;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            result[column * 4 + row] = static_cast<float>(m[column][row]);
    return result;
}

/// pbrt's worldToNDC: camera space to the picture, [0, 1] from the upper left.
glm::dmat4 ndc_from_camera(const Scene& scene) {
    const Camera& camera = scene.camera;
    const std::array<double, 4>& w = camera.screen_window;
    glm::dmat4 screen(1);
    if (camera.kind == Camera::Kind::perspective) {
        constexpr double near = 1e-2, far = 1000; // pbrt's
        const double scale = 1 / std::tan(glm::radians(camera.fov) / 2);
        screen[0][0] = screen[1][1] = scale;
        screen[2][2] = far / (far - near);
        screen[3][2] = -far * near / (far - near);
        screen[2][3] = 1;
        screen[3][3] = 0;
    }
    const glm::dmat4 ndc =
        glm::scale(glm::dmat4(1), glm::dvec3(1 / (w[1] - w[0]), 1 / (w[2] - w[3]), 1)) *
        glm::translate(glm::dmat4(1), glm::dvec3(-w[0], -w[3], 0));
    return ndc * screen;
}

json health_json(const Engine& engine) {
    json health = json::object();
    const HealthCounts counts = engine.health();
    for (std::size_t kind = 0; kind < counts.size(); ++kind)
        health[kHealthNames[kind]] = counts[kind];
    return health;
}

} // namespace

std::optional<double> relative_rmse(const Image& film, std::uint32_t samples) {
    if (samples < 2) return std::nullopt;
    double variance = 0, square = 0;
    for (std::size_t i = 0; i < film.pixels.size(); i += 6)
        for (std::size_t c = 0; c < 3; ++c) {
            square +=
                static_cast<double>(film.pixels[i + c]) * static_cast<double>(film.pixels[i + c]);
            variance += static_cast<double>(film.pixels[i + 3 + c]);
        }
    if (square == 0) return std::nullopt;
    return std::sqrt(variance / square);
}

ImageAttributes image_attributes(const Scene& scene, const Engine& engine,
                                 const RenderReport& report) {
    const glm::dmat4 camera_from_world = glm::inverse(scene.camera.world_from_camera);
    ImageAttributes attributes;
    attributes.full_width = scene.film.width;
    attributes.full_height = scene.film.height;
    attributes.x = scene.film.bounds.x0;
    attributes.y = scene.film.bounds.y0;
    attributes.values = {
        {"Software", std::string("Tyndall " TYNDALL_VERSION)},
        {"samplesPerPixel", static_cast<int>(report.samples)},
        {"renderTimeSeconds", static_cast<float>(report.seconds.render)},
        {"worldToCamera", to_matrix44(camera_from_world)},
        {"worldToNDC", to_matrix44(ndc_from_camera(scene) * camera_from_world)},
        {"tyndall:version", std::string(TYNDALL_VERSION)},
        {"tyndall:scene", scene.filename},
        {"tyndall:scene_sha256", scene.sha256},
        {"tyndall:seed", std::to_string(scene.seed)},
        {"tyndall:device", engine.device_text()},
        {"tyndall:stopped_by", report.stopped_by},
        {"tyndall:health", health_json(engine).dump()},
    };
    if (const auto error = relative_rmse(report.film, report.samples))
        attributes.values.emplace_back("tyndall:relative_rmse", *error);
    return attributes;
}

void write_stats(const std::string& file, const Scene& scene, const Engine& engine,
                 const RenderReport& report) {
    const double paths = path_count(scene, report);
    const std::optional<double> error = relative_rmse(report.film, report.samples);
    json stats{{"version", TYNDALL_VERSION},
               {"scene", scene.filename},
               {"scene_sha256", scene.sha256},
               {"seed", scene.seed},
               {"width", scene.film.bounds.width()},
               {"height", scene.film.bounds.height()},
               {"spp", report.samples},
               {"paths", paths},
               {"stopped_by", report.stopped_by},
               {"seconds",
                {{"total", report.seconds.total},
                 {"scene", report.seconds.scene},
                 {"build", 0.0},
                 {"compile", 0.0},
                 {"render", report.seconds.render}}},
               {"paths_per_second", paths / std::max(report.seconds.render, 1e-9)},
               {"error", {{"relative_rmse", error ? json(*error) : json(nullptr)}}},
               {"health", health_json(engine)}};
    engine.describe(stats);
    const std::string text = stats.dump(2) + '\n';
    AtomicFile out(file);
    std::fwrite(text.data(), 1, text.size(), out.stream());
    out.commit();
}

std::string closing_text(const Scene& scene, const Engine& engine, const RenderReport& report) {
    std::string text = fmt::format(
        "{} spp in {}, {:.2f} Mpaths/s", report.samples, format_seconds(report.seconds.render),
        path_count(scene, report) * 1e-6 / std::max(report.seconds.render, 1e-9));
    if (const auto error = relative_rmse(report.film, report.samples))
        text += fmt::format(", {:.2f} % relative error", 100 * *error);
    text += '\n';
    const HealthCounts counts = engine.health();
    for (std::size_t kind = 0; kind < counts.size(); ++kind)
        if (counts[kind] > 0)
            text += fmt::format("warning: {} contributions dropped: {}\n", counts[kind],
                                kHealthNames[kind]);
    return text;
}

} // namespace tyndall::cli

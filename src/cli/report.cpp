#include "cli/report.h"

#include "cli/progress_line.h"
#include "cli/progress_text.h"
#include "core/atomic_file.h"
#include "core/json_text.h"

#include <algorithm>
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
    const Health counts = engine.health();
    for (std::size_t kind = 0; kind < kHealthNames.size(); ++kind) {
        const shared::Mishap& mishap = counts.kinds[kind];
        health[kHealthNames[kind]] = mishap.count;
        if (mishap.count > 0)
            health["first"][kHealthNames[kind]] = {mishap.x, mishap.y, mishap.sample};
    }
    health["worst_majorant_ratio"] = counts.worst_majorant_ratio;
    health["lost_throughput"] = counts.lost_throughput;
    return health;
}

bool has_heavy_tail(const RenderReport& report) {
    return stats::is_heavy_tail(report.tail_share);
}

bool is_black(const Image& film) {
    return std::all_of(film.pixels.begin(), film.pixels.end(), [](float x) { return x == 0; });
}

json error_json(const RenderReport& report) {
    json error{{"relative_rmse", nullptr},
               {"interval_95", nullptr},
               {"half_in_seconds", nullptr},
               {"tail_share", nullptr},
               {"heavy_tails", has_heavy_tail(report)}};
    if (report.tail_share) error["tail_share"] = *report.tail_share;
    if (report.error) {
        error["relative_rmse"] = report.error->relative_rmse;
        error["interval_95"] = {report.error->low, report.error->high}; // null if infinite
        // Errors fall as 1 / sqrt(time): four times as long in all.
        error["half_in_seconds"] = 3 * report.seconds.render;
    }
    return error;
}

json prediction_json(const RenderReport& report) {
    if (!report.prediction) return nullptr;
    const Prediction& p = *report.prediction;
    return {{"at_spp", p.at_samples},     {"at_seconds", p.at_seconds},
            {"stopped_by", p.stopped_by}, {"spp", p.samples},
            {"seconds", p.seconds},       {"relative_rmse", p.relative_rmse}};
}

} // namespace

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
    if (report.error) {
        attributes.values.emplace_back("tyndall:relative_rmse", report.error->relative_rmse);
        attributes.values.emplace_back("tyndall:error", error_json(report).dump());
    }
    if (report.prediction)
        attributes.values.emplace_back("tyndall:prediction", prediction_json(report).dump());
    return attributes;
}

void write_stats(const std::string& file, const Scene& scene, const Engine& engine,
                 const RenderReport& report) {
    const double paths = path_count(scene, report);
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
               {"error", error_json(report)},
               {"prediction", prediction_json(report)},
               {"health", health_json(engine)}};
    engine.describe(stats);
    const std::string text = json_text(stats, 2) + '\n';
    AtomicFile out(file);
    std::fwrite(text.data(), 1, text.size(), out.stream());
    out.commit();
}

std::string health_text(const Health& health, const std::string& replay_command) {
    std::string text;
    for (std::size_t kind = 0; kind < kHealthNames.size(); ++kind) {
        const shared::Mishap& mishap = health.kinds[kind];
        if (mishap.count == 0) continue;
        text += fmt::format("warning: {} {}", mishap.count, shared::kHealthTexts[kind]);
        if (kind == shared::HEALTH_MAJORANT)
            text += fmt::format(" (up to {:.4g} times)", health.worst_majorant_ratio);
        if (kind == shared::HEALTH_EVENT_LIMIT)
            text += fmt::format(" (they carried {:.4g} in all)", health.lost_throughput);
        text += fmt::format(
            "; first at pixel {0},{1} sample {2}: see it with {3} --replay {0},{1},{2}\n", mishap.x,
            mishap.y, mishap.sample, replay_command);
    }
    return text;
}

std::string closing_text(const Scene& scene, const RenderReport& report) {
    std::string text = fmt::format(
        "{} spp in {}, {:.2f} Mpaths/s", report.samples, format_seconds(report.seconds.render),
        path_count(scene, report) * 1e-6 / std::max(report.seconds.render, 1e-9));
    if (report.error) text += ", " + error_text(*report.error);
    text += '\n';
    if (is_black(report.film)) text += "the image is black: no path has found light\n";
    if (has_heavy_tail(report))
        text +=
            fmt::format("heavy tails: the top 0.1 % of samples carry {:.0f} % of the image; the "
                        "interval may be too narrow\n",
                        100 * *report.tail_share);
    return text;
}

} // namespace tyndall::cli

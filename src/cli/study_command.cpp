#include "study/study.h"

#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/progress_line.h"
#include "core/error.h"
#include "render/effects.h"

#include <cmath>
#include <cstdio>
#include <ctime>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <thread>

namespace tyndall::cli {
namespace {

/// Most pixels of a study that nobody gave a size: errors by sample are the same for more.
constexpr double kMostPixels = 256 * 256;

/// A smaller picture of the same view, if the scene asks for a large one.
void shrink(Scene& scene) {
    const PixelBounds& b = scene.film.bounds;
    const double pixels = static_cast<double>(b.width()) * b.height();
    if (pixels <= kMostPixels) return;
    const double scale = std::sqrt(kMostPixels / pixels);
    const auto scaled = [&](int size) { return std::max(1, static_cast<int>(size * scale)); };
    resize_film(scene, scaled(scene.film.width), scaled(scene.film.height));
}

std::string describe_part(const Film& film) {
    const PixelBounds& b = film.bounds;
    if (b.width() == film.width && b.height() == film.height)
        return fmt::format("{} x {} pixels", film.width, film.height);
    return fmt::format("columns {} to {} and rows {} to {} of {} x {} pixels", b.x0, b.x1 - 1, b.y0,
                       b.y1 - 1, film.width, film.height);
}

/// What is known before anything is measured.
study::Results describe(const StudyOptions& options, const Scene& scene,
                        const gpu::DeviceInfo& device) {
    study::Results about;
    about.version = TYNDALL_VERSION;
    about.scene = options.scene.scene;
    about.sha256 = scene.sha256;
    about.device = device.name;
    about.driver = device.driver;
    if (device.type == "cpu")
        about.processors = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    about.command = options.command_line;
    about.date = fmt::format("{:%Y-%m-%d %H:%M %Z}", fmt::localtime(std::time(nullptr)));
    about.seed = scene.seed;
    about.width = scene.film.bounds.width();
    about.height = scene.film.bounds.height();
    about.part = describe_part(scene.film);
    about.max_depth = scene.integrator.max_depth;
    about.budget_seconds = options.budget;
    about.reference.file = options.reference;
    for (const Effect& effect : compute_effects(scene).list)
        if (effect.value != "no")
            about.effects.push_back(effect.value == "yes" ? effect.name
                                                          : effect.name + ": " + effect.value);
    return about;
}

} // namespace

int run_study(const StudyOptions& options) {
    if (options.device.device == "reference")
        throw Error(ExitStatus::bad_input, "study measures a device: name one");
    study::StudyOptions work{.folder = options.folder,
                             .techniques = options.techniques,
                             .budget_seconds = options.budget,
                             .reference = options.reference};
    Scene scene = load_scene(options.scene, options.quiet);
    const int scene_width = scene.film.width, scene_height = scene.film.height;
    if (!options.scene.size && !options.scene.crop && options.reference.empty()) shrink(scene);
    const gpu::Context context(
        {.device = options.device.device, .validate = options.device.validate});
    study::Results about = describe(options, scene, context.info());
    about.scene_width = scene_width, about.scene_height = scene_height;
    about.scene_seconds = study::seconds_since(work.start);
    watch_interrupts();
    ProgressLine line(options.quiet);
    const study::Results results = study::run_study(context, scene, work,
                                                    {.is_stopped = was_interrupted,
                                                     .tell =
                                                         [&](const std::string& text) {
                                                             if (line.is_due()) line.print(text);
                                                         }},
                                                    std::move(about));
    if (!options.quiet) line.print(fmt::format("{}", (work.folder / "report.html").string()));
    if (context.validation_messages() > 0)
        throw Error(ExitStatus::failed, fmt::format("the validation layer had {} messages",
                                                    context.validation_messages()));
    return static_cast<int>(was_interrupted() && !results.is_complete ? ExitStatus::interrupted
                                                                      : ExitStatus::done);
}

} // namespace tyndall::cli

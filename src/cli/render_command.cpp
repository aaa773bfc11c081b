#include "cli/engine.h"
#include "cli/interrupt.h"
#include "cli/progress_line.h"
#include "cli/report.h"
#include "core/error.h"
#include "image/image.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <numeric>

namespace tyndall::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// One render command at work.
class Job {
  public:
    explicit Job(const RenderOptions& options) : options_(options) {}
    int run();

  private:
    bool keep_going(const Progress& progress);
    std::string progress_text(const Progress& progress) const;
    void write_images(double render_seconds);
    std::uint32_t end_sample() const;

    const RenderOptions& options_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point render_start_;
    Clock::time_point last_write_;
    Scene scene_;
    std::vector<std::string> outputs_;
    std::unique_ptr<Engine> engine_;
    std::unique_ptr<ProgressLine> line_;
    RenderReport report_;
};

std::uint32_t Job::end_sample() const {
    // Without a number of samples, only the clock ends the render.
    constexpr std::uint32_t unlimited = 1u << 31;
    if (options_.time && !options_.scene.spp) return unlimited;
    return static_cast<std::uint32_t>(scene_.samples_per_pixel);
}

std::string Job::progress_text(const Progress& progress) const {
    const double seconds = seconds_since(render_start_);
    const double pixels =
        static_cast<double>(scene_.film.bounds.width()) * scene_.film.bounds.height();
    const double rate = progress.paths / std::max(seconds, 1e-9);
    double left = (progress.end_samples * pixels - progress.paths) / std::max(rate, 1e-9);
    if (options_.time) left = std::min(left, *options_.time - seconds_since(start_));
    left = std::max(0.0, left);
    return fmt::format("{:5.1f} %  {} spp  {:.2f} Mpaths/s  {} elapsed  {} left",
                       100 * seconds / std::max(seconds + left, 1e-9), progress.samples,
                       rate * 1e-6, format_seconds(seconds), format_seconds(left));
}

bool Job::keep_going(const Progress& progress) {
    if (line_->is_due()) line_->print(progress_text(progress));
    if (was_interrupted()) {
        report_.stopped_by = "signal";
        return false;
    }
    if (options_.time && seconds_since(start_) >= *options_.time) {
        report_.stopped_by = "time";
        return false;
    }
    if (options_.write_interval && progress.samples > 0 &&
        seconds_since(last_write_) >= *options_.write_interval) {
        write_images(seconds_since(render_start_));
        last_write_ = Clock::now();
    }
    return true;
}

void Job::write_images(double render_seconds) {
    report_.film = engine_->read_film();
    report_.seconds.render = render_seconds;
    report_.seconds.total = seconds_since(start_);
    const ImageAttributes attributes = image_attributes(scene_, *engine_, report_);
    for (const std::string& output : outputs_)
        write_image(output, report_.film, attributes, {.half = scene_.film.half_float});
}

int Job::run() {
    scene_ = load_scene(options_.scene, options_.quiet);
    report_.seconds.scene = seconds_since(start_);
    outputs_ = options_.outputs.empty() ? std::vector{scene_.film.filename} : options_.outputs;
    for (const std::string& output : outputs_)
        check_image_extension(output);
    engine_ = make_engine(scene_, options_.device);
    if (!options_.quiet)
        std::fprintf(stderr, "%s: %d x %d on %s\n", options_.scene.scene.c_str(),
                     scene_.film.bounds.width(), scene_.film.bounds.height(),
                     engine_->device_text().c_str());
    watch_interrupts();
    line_ = std::make_unique<ProgressLine>(options_.quiet);
    render_start_ = last_write_ = Clock::now();
    report_.samples = engine_->render(0, end_sample(), [&](const Progress& p) {
        report_.samples = p.samples;
        return keep_going(p);
    });
    const double render_seconds = seconds_since(render_start_);
    line_.reset();
    write_images(render_seconds);
    if (!options_.quiet) std::fputs(closing_text(scene_, *engine_, report_).c_str(), stderr);
    if (!options_.stats.empty()) write_stats(options_.stats, scene_, *engine_, report_);
    if (engine_->validation_messages() > 0)
        throw Error(ExitStatus::failed, fmt::format("the validation layer had {} messages",
                                                    engine_->validation_messages()));
    const HealthCounts health = engine_->health();
    if (options_.strict && std::any_of(health.begin(), health.end(), [](auto n) { return n > 0; }))
        throw Error(ExitStatus::failed, "contributions were dropped (--strict); see above");
    const bool interrupted = report_.stopped_by == "signal";
    return static_cast<int>(interrupted ? ExitStatus::interrupted : ExitStatus::done);
}

} // namespace

int run_render(const RenderOptions& options) {
    return Job(options).run();
}

} // namespace tyndall::cli

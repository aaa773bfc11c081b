#include "cli/engine.h"
#include "cli/interrupt.h"
#include "cli/limits.h"
#include "cli/orders.h"
#include "cli/progress_line.h"
#include "cli/progress_text.h"
#include "cli/report.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "image/image.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace tyndall::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The command of this render, without what does not tell which paths are traced.
std::string replay_command(const SceneOptions& o, const DeviceOptions& device, Sampler sampler) {
    std::string command = "tyndall render " + in_shell_quotes(o.scene);
    if (!device.device.empty()) command += " --device " + in_shell_quotes(device.device);
    if (o.seed) command += fmt::format(" --seed {}", *o.seed);
    if (o.spp && sampler == Sampler::zsobol) command += fmt::format(" --spp {}", *o.spp);
    if (o.size) command += " --size " + *o.size;
    if (o.max_depth) command += fmt::format(" --maxdepth {}", *o.max_depth);
    if (o.integrator) command += " --integrator " + *o.integrator;
    return command;
}

/// Why --strict fails: "--strict: 3 nonfinite, 1 negative".
std::string strict_text(const Health& health) {
    std::string text;
    for (std::size_t kind = 0; kind < kHealthNames.size(); ++kind)
        if (health[kind] > 0)
            text += fmt::format("{} {} {}", text.empty() ? "--strict:" : ",", health[kind],
                                kHealthNames[kind]);
    return text;
}

/// One render command at work.
class Job {
  public:
    explicit Job(const RenderOptions& options) : options_(options) {}
    int run();

  private:
    bool keep_going(const Progress& progress);
    std::string progress_text(const Progress& progress) const;
    void report_state(double render_seconds);
    void write_images(const Image& picture);
    void write_interval();
    void write_layers();
    void choose_outputs();
    Limits limits() const;
    double pixels() const;
    Pace pace(const Progress& progress) const;
    bool is_time_over();
    void foresee(const Progress& progress);

    const RenderOptions& options_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point render_start_;
    Clock::time_point last_write_;
    Clock::time_point last_asked_;
    double asking_interval_ = 0; ///< Seconds between the last two calls of keep_going.
    Scene scene_;
    Limits limits_;
    Pace first_pace_;
    std::vector<std::string> outputs_;
    std::unique_ptr<Engine> engine_;
    std::unique_ptr<ProgressLine> line_;
    RenderReport report_;
};

/// "0.005" or "0.5%" as a fraction.
double parse_error(const std::string& text) {
    double value = 0;
    const char* end = text.data() + text.size();
    auto [rest, failure] = std::from_chars(text.data(), end, value);
    while (rest != end && *rest == ' ')
        ++rest;
    if (rest != end && *rest == '%') {
        value /= 100;
        ++rest;
    }
    if (failure != std::errc() || rest != end || !(value > 0 && value <= 1))
        throw Error(ExitStatus::bad_input,
                    fmt::format("--target-error {}: expected a number above 0 and up to 1, such as "
                                "0.005, or 0.5%",
                                text));
    return value;
}

Limits Job::limits() const {
    Limits limits;
    limits.time = options_.time;
    if (options_.target_error) limits.target_error = parse_error(*options_.target_error);
    // Without a number of samples, only the others end the render.
    const bool is_open = (limits.time || limits.target_error) && !options_.scene.spp;
    limits.end_samples =
        is_open ? Limits::kUnlimited : static_cast<std::uint32_t>(scene_.samples_per_pixel);
    return limits;
}

double Job::pixels() const {
    return static_cast<double>(scene_.film.bounds.width()) * scene_.film.bounds.height();
}

/// Measured since the first call of keep_going: what came before has the costs of a first time in
/// it.
Pace Job::pace(const Progress& progress) const {
    const double in_flight = progress.begun - progress.done;
    Pace now{.seconds = seconds_since(render_start_),
             .samples = progress.done,
             .traced = progress.done + 0.5 * in_flight,
             .is_steady = 0.5 * in_flight <= 0.25 * progress.done};
    const Pace since = now.traced > first_pace_.traced ? first_pace_ : Pace{};
    now.samples_per_second =
        std::max(1e-9, (now.traced - since.traced) / std::max(1e-9, now.seconds - since.seconds));
    return now;
}

std::string Job::progress_text(const Progress& progress) const {
    const Pace now = pace(progress);
    ProgressFigures figures{.samples = progress.samples,
                            .error = progress.error,
                            .paths_per_second = now.samples_per_second * pixels(),
                            .target_error = limits_.target_error,
                            .elapsed = now.seconds,
                            .left = std::numeric_limits<double>::infinity()};
    if (limits_.end_samples < Limits::kUnlimited)
        figures.left = now.seconds_to(limits_.end_samples);
    if (limits_.time)
        figures.left = std::min(figures.left, std::max(0.0, *limits_.time - seconds_since(start_)));
    const std::optional<double> goal = limits_.target_error
                                           ? samples_to_target(progress, *limits_.target_error)
                                           : samples_to_half(progress);
    if (goal) figures.target_seconds = now.seconds_to(*goal);
    if (limits_.target_error) figures.left = std::min(figures.left, figures.target_seconds);
    return cli::progress_text(figures);
}

/// The renderer asks once per submission, with the next one under way. It is time at the one that
/// leaves the end of what is under way nearest to the limit.
bool Job::is_time_over() {
    const Clock::time_point now = Clock::now();
    asking_interval_ = std::chrono::duration<double>(now - last_asked_).count();
    last_asked_ = now;
    return limits_.time && seconds_since(start_) + 1.5 * asking_interval_ >= *limits_.time;
}

/// Foresees the end, once: at the first look that is a tenth of the way to it, by which time the
/// pace and the error are known.
void Job::foresee(const Progress& progress) {
    constexpr double seconds_for_pace = 0.5;
    const Pace now = pace(progress);
    if (report_.prediction || !progress.is_look || progress.batches < Limits::kFewestBatches ||
        now.seconds < seconds_for_pace)
        return;
    const double before = std::chrono::duration<double>(render_start_ - start_).count();
    const std::optional<Prediction> end = foresee_end(limits_, progress, now, before);
    if (end && progress.samples >= 0.1 * end->samples) report_.prediction = end;
}

bool Job::keep_going(const Progress& progress) {
    if (first_pace_.seconds == 0) first_pace_ = pace(progress);
    if (line_->is_due()) line_->print(progress_text(progress));
    foresee(progress);
    const bool is_late = is_time_over();
    if (was_interrupted())
        report_.stopped_by = "signal";
    else if (limits_.meets_target(progress))
        report_.stopped_by = "target-error";
    else if (is_late)
        report_.stopped_by = "time";
    if (report_.stopped_by != RenderReport::kUnfinished) return false;
    if (options_.write_interval && progress.samples > 0 &&
        seconds_since(last_write_) >= *options_.write_interval) {
        write_interval();
        last_write_ = last_asked_ = Clock::now();
    }
    return true;
}

void Job::report_state(double render_seconds) {
    report_.film = engine_->read_film();
    report_.samples = engine_->samples();
    report_.error = engine_->error();
    report_.tail_share = engine_->tail_share();
    report_.seconds.render = render_seconds;
    report_.seconds.total = seconds_since(start_);
}

/// Writes as many of the outputs as can be written.
/// @throws Error of the first that cannot.
void Job::write_images(const Image& picture) {
    const ImageAttributes attributes = image_attributes(scene_, *engine_, report_);
    std::optional<Error> failure;
    for (const std::string& output : outputs_) {
        try {
            const std::size_t clamped =
                write_image(output, picture, attributes, {.half = scene_.film.half_float});
            if (clamped > 0)
                std::fprintf(stderr,
                             "%s: warning: %zu values were cut to 65504, the most that "
                             "half floats have (savefp16)\n",
                             output.c_str(), clamped);
        } catch (const Error& error) {
            if (!failure) failure = error;
        }
    }
    if (failure) throw *failure;
}

/// A disk that is full now may have room at the end: the render goes on.
void Job::write_interval() {
    report_state(seconds_since(render_start_));
    try {
        write_images(report_.film);
    } catch (const Error& error) {
        std::fprintf(stderr, "\nwarning: %s; the render goes on\n", error.what());
    }
}

/// Writes the outputs again, with layers. They are made by renders of their own: the picture is
/// safe by now.
void Job::write_layers() {
    if (!options_.quiet) std::fputs("rendering the layers of --aov\n", stderr);
    const auto layers =
        with_orders(report_.film, scene_, options_.device, report_.samples, was_interrupted);
    if (layers)
        write_images(*layers);
    else
        report_.stopped_by = "signal";
}

void Job::choose_outputs() {
    outputs_ = options_.outputs.empty() ? std::vector{scene_.film.filename} : options_.outputs;
    for (const std::string& output : outputs_)
        check_image_extension(output);
    // Now, not after hours: whether they can be written at all.
    // A pipe's reader would take a probe for all of it.
    std::vector<std::string> files = outputs_;
    if (!options_.stats.empty()) files.push_back(options_.stats);
    for (const std::string& file : files)
        if (!std::filesystem::is_fifo(file)) AtomicFile probe(file);
    if (std::count(outputs_.begin(), outputs_.end(), options_.stats) > 0)
        throw Error(ExitStatus::bad_input, options_.stats + ": both an output and --stats");
    const bool has_exr = std::any_of(outputs_.begin(), outputs_.end(),
                                     [](const auto& output) { return output.ends_with(".exr"); });
    if (!options_.aovs.empty() && !has_exr)
        throw Error(ExitStatus::bad_input, "--aov asks for layers, which only an .exr output has");
}

int Job::run() {
    if (options_.device.calibrate && options_.device.device == "reference")
        throw Error(ExitStatus::bad_input, "--calibrate: the reference has nothing to tune");
    scene_ = load_scene(options_.scene, options_.quiet);
    report_.seconds.scene = seconds_since(start_);
    choose_outputs();
    limits_ = limits();
    watch_interrupts();
    if (options_.device.calibrate && !options_.quiet)
        std::fprintf(stderr, "calibrating for about %d seconds\n", int(kCalibrationTime.count()));
    const Clock::time_point before_engine = Clock::now();
    engine_ = make_engine(scene_, options_.device);
    if (options_.device.calibrate) start_ += Clock::now() - before_engine; // no part of --time
    if (!options_.quiet)
        std::fprintf(stderr, "%s: %d x %d on %s\n", options_.scene.scene.c_str(),
                     scene_.film.bounds.width(), scene_.film.bounds.height(),
                     engine_->device_text().c_str());
    if (options_.device.calibrate && !options_.quiet) {
        nlohmann::json found;
        engine_->describe(found);
        std::fprintf(stderr, "fastest with %s\n", found["tuning"].dump().c_str());
    }
    line_ = std::make_unique<ProgressLine>(options_.quiet);
    render_start_ = last_write_ = last_asked_ = Clock::now();
    engine_->render(0, limits_.end_samples, [&](const Progress& p) { return keep_going(p); });
    if (report_.stopped_by == RenderReport::kUnfinished) report_.stopped_by = "spp";
    const double render_seconds = seconds_since(render_start_);
    line_.reset();
    report_state(render_seconds);
    write_images(report_.film);
    if (!options_.aovs.empty() && report_.stopped_by != "signal") write_layers();
    if (!options_.quiet) std::fputs(closing_text(scene_, report_).c_str(), stderr);
    std::fputs(health_text(engine_->health(),
                           replay_command(options_.scene, options_.device, scene_.sampler))
                   .c_str(),
               stderr);
    if (!options_.stats.empty()) write_stats(options_.stats, scene_, *engine_, report_);
    if (engine_->validation_messages() > 0)
        throw Error(ExitStatus::failed, fmt::format("the validation layer had {} messages",
                                                    engine_->validation_messages()));
    const Health health = engine_->health();
    if (options_.strict && !health.is_good()) throw Error(ExitStatus::failed, strict_text(health));
    const bool interrupted = report_.stopped_by == "signal";
    return static_cast<int>(interrupted ? ExitStatus::interrupted : ExitStatus::done);
}

} // namespace

int run_render(const RenderOptions& options) {
    return Job(options).run();
}

} // namespace tyndall::cli

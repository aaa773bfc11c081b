#include "cli/engine.h"

#include "cli/interrupt.h"
#include "core/error.h"
#include "reference/reference.h"
#include "render/calibration.h"
#include "stats/batch_film.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numeric>

namespace tyndall::cli {
namespace {

using nlohmann::json;

json effects_json(const Effects& effects) {
    json list = json::object();
    for (const Effect& e : effects.list)
        list[e.name] = e.value == "yes"  ? json(true)
                       : e.value == "no" ? json(false)
                                         : json(e.value);
    return list;
}

/// The tuning of the options, and what they leave open by a calibration: one that is made now (and
/// kept if it was all left open), or before.
Tuning find_tuning(const gpu::Context& context, const Scene& scene, const DeviceOptions& options) {
    const std::string key = tuning_key(compute_effects(scene).features);
    const TuningFile file(gpu::default_cache_folder(), context.info());
    if (options.calibrate) {
        const auto start = std::chrono::steady_clock::now();
        const Tuning best = calibrate(context, scene, options.tuning, [&] {
            return !was_interrupted() &&
                   std::chrono::steady_clock::now() - start < kCalibrationTime;
        });
        if (options.tuning == Tuning{}) file.store(key, best);
        return best;
    }
    const Tuning found = file.find(key).value_or(Tuning{});
    Tuning tuning = options.tuning;
    for (const auto value :
         {&Tuning::stages, &Tuning::slots, &Tuning::run_length, &Tuning::workgroup_size})
        if (tuning.*value == 0) tuning.*value = found.*value;
    return tuning;
}

class DeviceEngine final : public Engine {
  public:
    DeviceEngine(const Scene& scene, const DeviceOptions& options)
        : context_({.device = options.device,
                    .validate = options.validate,
                    .cache_folder = gpu::default_cache_folder()}),
          renderer_(context_, scene, find_tuning(context_, scene, options)) {}

    std::uint32_t render(std::uint32_t first_sample, std::uint32_t end_sample,
                         const KeepGoing& keep_going) override {
        return renderer_.render(first_sample, end_sample, keep_going);
    }
    Image read_film() override { return renderer_.read_film(); }
    std::vector<glm::dvec4> read_sums() override { return renderer_.read_sums(); }
    std::uint32_t samples() const override { return renderer_.samples(); }
    std::optional<stats::ErrorEstimate> error() const override { return renderer_.error(); }
    std::optional<double> tail_share() const override { return renderer_.tail_share(); }
    Health health() const override { return renderer_.health(); }
    std::string device_text() const override {
        return fmt::format("{} ({})", context_.info().name, context_.info().driver);
    }
    std::uint32_t validation_messages() const override { return context_.validation_messages(); }
    void describe(json& stats) const override;

  private:
    gpu::Context context_;
    Renderer renderer_;
};

void DeviceEngine::describe(json& stats) const {
    const gpu::DeviceInfo& info = context_.info();
    const Tuning& tuning = renderer_.wavefront().tuning();
    stats["device"] = {{"name", info.name}, {"driver", info.driver}, {"type", info.type}};
    stats["tuning"] = {{"slots", tuning.slots},
                       {"run_length", tuning.run_length},
                       {"workgroup_size", tuning.workgroup_size},
                       {"stages", tuning.stages == STAGES_FUSED ? "fused" : "apart"}};
    stats["effects"] = effects_json(renderer_.effects());
    stats["seconds"]["build"] = renderer_.build_seconds();
    stats["seconds"]["compile"] = renderer_.compile_seconds();
    stats["pipeline_cache_bytes"] = context_.pipelines().loaded_bytes();
    for (const StageTime& stage : renderer_.stage_times())
        stats["stages"].push_back({{"name", stage.name},
                                   {"dispatches", stage.dispatches},
                                   {"paths", stage.paths},
                                   {"seconds", stage.seconds}});
    for (const auto& [name, bytes] : renderer_.wavefront().memory())
        stats["memory_bytes"][name] = bytes;
}

/// The reference renderer, batch by batch, with a film of its own in double.
class ReferenceEngine final : public Engine {
  public:
    explicit ReferenceEngine(const Scene& scene)
        : scene_(scene), effects_(compute_effects(scene)), renderer_(scene) {}

    std::uint32_t render(std::uint32_t first_sample, std::uint32_t end_sample,
                         const KeepGoing& keep_going) override;
    Image read_film() override { return film_.image(scene_.film.bounds.width()); }
    std::vector<glm::dvec4> read_sums() override { return film_.sums(); }
    std::uint32_t samples() const override { return film_.samples(); }
    std::optional<stats::ErrorEstimate> error() const override { return film_.error(); }
    std::optional<double> tail_share() const override {
        return stats::tail_share(film_.histogram());
    }
    Health health() const override { return renderer_.health(); }
    std::string device_text() const override { return "reference (double precision, CPU)"; }
    void describe(json& stats) const override {
        stats["device"] = {{"name", "reference"}, {"driver", "double precision"}, {"type", "cpu"}};
        stats["effects"] = effects_json(effects_);
        stats["stages"] = json::array();
    }

  private:
    std::size_t pixel_count() const {
        return static_cast<std::size_t>(scene_.film.bounds.width()) *
               static_cast<std::size_t>(scene_.film.bounds.height());
    }

    const Scene& scene_;
    Effects effects_;
    reference::ReferenceRenderer renderer_;
    stats::BatchFilm film_;
};

std::uint32_t ReferenceEngine::render(std::uint32_t first_sample, std::uint32_t end_sample,
                                      const KeepGoing& keep_going) {
    film_ = stats::BatchFilm(pixel_count());
    const BatchRange batches(first_sample, end_sample);
    Progress progress{.end_samples = end_sample - first_sample};
    std::uint32_t look = batches.next_look(batches.first());
    for (std::uint32_t batch = batches.first(); batch < batches.end(); ++batch) {
        const std::uint32_t size = batches.samples_of(batch);
        const auto go_on = [&](double share) {
            progress.begun = progress.done = progress.samples + share * size;
            return !keep_going || keep_going(progress) || progress.samples == 0;
        };
        const auto sums = renderer_.render(first_sample + progress.samples, size, go_on);
        if (sums.empty()) break; // told to stop in the middle of the batch
        film_.fold(sums, size);
        progress.samples += size;
        progress.batches = batch + 1 - batches.first();
        progress.is_look = batch + 1 == look;
        if (progress.is_look) {
            progress.error = film_.error();
            progress.has_heavy_tail = stats::is_heavy_tail(tail_share());
            look = batches.next_look(look);
        }
        if (!go_on(0)) break;
        progress.is_look = false;
    }
    return progress.samples;
}

} // namespace

std::unique_ptr<Engine> make_engine(const Scene& scene, const DeviceOptions& options) {
    if (options.device == "reference") return std::make_unique<ReferenceEngine>(scene);
    return std::make_unique<DeviceEngine>(scene, options);
}

} // namespace tyndall::cli

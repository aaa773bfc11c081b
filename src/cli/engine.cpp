#include "cli/engine.h"

#include "core/error.h"
#include "reference/reference.h"
#include "shared/schedule.h"

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

class DeviceEngine final : public Engine {
  public:
    DeviceEngine(const Scene& scene, const DeviceOptions& options)
        : context_({.device = options.device, .validate = options.validate}),
          renderer_(context_, scene, options.tuning) {}

    std::uint32_t render(std::uint32_t first_sample, std::uint32_t end_sample,
                         const KeepGoing& keep_going) override {
        return renderer_.render(first_sample, end_sample, keep_going);
    }
    Image read_film() override { return renderer_.read_film(); }
    std::vector<glm::dvec4> read_sums() override { return renderer_.read_sums(); }
    HealthCounts health() const override { return renderer_.health(); }
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
                       {"workgroup_size", tuning.workgroup_size}};
    stats["effects"] = effects_json(renderer_.effects());
    stats["seconds"]["build"] = renderer_.build_seconds();
    stats["seconds"]["compile"] = renderer_.compile_seconds();
    for (const StageTime& stage : renderer_.stage_times())
        stats["stages"].push_back(
            {{"name", stage.name}, {"dispatches", stage.dispatches}, {"seconds", stage.seconds}});
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
    Image read_film() override;
    std::vector<glm::dvec4> read_sums() override { return sums_; }
    HealthCounts health() const override {
        HealthCounts counts{};
        counts[shared::HEALTH_NONFINITE] = renderer_.dropped_paths();
        return counts;
    }
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
    void fold(const std::vector<glm::dvec4>& batch, std::uint32_t count);

    const Scene& scene_;
    Effects effects_;
    reference::ReferenceRenderer renderer_;
    std::vector<glm::dvec4> sums_;
    std::vector<glm::dvec3> residuals_; ///< As shared::FILM_RESIDUAL.
    std::uint32_t samples_ = 0;
    std::uint32_t batches_ = 0;
};

void ReferenceEngine::fold(const std::vector<glm::dvec4>& batch, std::uint32_t count) {
    const double before = samples_, n = count;
    for (std::size_t i = 0; i < batch.size(); ++i) {
        if (before > 0 && sums_[i].w >= 0.5 * before) { // as update_film.comp
            const glm::dvec3 d =
                glm::dvec3(batch[i]) - glm::dvec3(sums_[i]) * (batch[i].w / sums_[i].w);
            residuals_[i] += d * d * (before / (n * (before + n)));
        }
        sums_[i] += batch[i];
    }
    samples_ += count;
    ++batches_;
}

std::uint32_t ReferenceEngine::render(std::uint32_t first_sample, std::uint32_t end_sample,
                                      const KeepGoing& keep_going) {
    sums_.assign(pixel_count(), glm::dvec4(0));
    residuals_.assign(pixel_count(), glm::dvec3(0));
    samples_ = batches_ = 0;
    std::uint32_t batch = 0;
    while (shared::batch_first_sample(batch + 1) <= first_sample)
        ++batch;
    for (std::uint32_t sample = first_sample; sample < end_sample; ++batch) {
        const std::uint32_t end = std::min(end_sample, shared::batch_first_sample(batch + 1));
        const auto go_on = [&](double share) {
            const double begun = samples_ + share * (end - sample);
            const Progress progress{samples_, end_sample - first_sample,
                                    begun * static_cast<double>(pixel_count())};
            return !keep_going || keep_going(progress) || samples_ == 0;
        };
        const auto sums = renderer_.render(sample, end - sample, go_on);
        if (sums.empty()) break; // told to stop in the middle of the batch
        fold(sums, end - sample);
        sample = end;
        if (!go_on(0)) break;
    }
    return samples_;
}

Image ReferenceEngine::read_film() {
    const PixelBounds& bounds = scene_.film.bounds;
    Image image(bounds.width(), bounds.height(),
                {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        if (sums_[i].w == 0) continue;
        for (int c = 0; c < 3; ++c) {
            image.pixels[i * 6 + c] = static_cast<float>(sums_[i][c] / sums_[i].w);
            if (batches_ > 1)
                image.pixels[i * 6 + 3 + c] = static_cast<float>(
                    residuals_[i][c] / (static_cast<double>(batches_ - 1) * samples_));
        }
    }
    return image;
}

} // namespace

std::unique_ptr<Engine> make_engine(const Scene& scene, const DeviceOptions& options) {
    if (options.device == "reference") return std::make_unique<ReferenceEngine>(scene);
    return std::make_unique<DeviceEngine>(scene, options);
}

} // namespace tyndall::cli

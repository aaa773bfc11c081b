/// One face for both renderers: the device's and the reference's.
#pragma once

#include "cli/options.h"
#include "image/image.h"
#include "render/renderer.h"

#include <chrono>
#include <memory>
#include <nlohmann/json_fwd.hpp>

namespace tyndall::cli {

class Engine {
  public:
    virtual ~Engine() = default;
    /// As Renderer::render.
    virtual std::uint32_t render(std::uint32_t first_sample, std::uint32_t end_sample,
                                 const KeepGoing& keep_going) = 0;
    /// As Renderer::read_film.
    virtual Image read_film() = 0;
    /// As Renderer::read_sums.
    virtual std::vector<glm::dvec4> read_sums() = 0;
    /// As Renderer::samples.
    virtual std::uint32_t samples() const = 0;
    /// As Renderer::error and Renderer::tail_share.
    virtual std::optional<stats::ErrorEstimate> error() const = 0;
    virtual std::optional<double> tail_share() const = 0;
    /// What went wrong.
    virtual Health health() const = 0;
    /// "name (driver)", for people.
    virtual std::string device_text() const = 0;
    /// Adds what only this engine knows to --stats: device, effects, stages, memory_bytes, seconds.
    virtual void describe(nlohmann::json& stats) const = 0;
    /// Messages of the validation layer.
    virtual std::uint32_t validation_messages() const { return 0; }
};

/// After this long --calibrate tries nothing new.
constexpr std::chrono::seconds kCalibrationTime{30};

/// The engine that the options ask for. The scene must outlive it.
std::unique_ptr<Engine> make_engine(const Scene& scene, const DeviceOptions& options);

} // namespace tyndall::cli

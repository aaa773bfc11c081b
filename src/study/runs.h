/// A technique at work: four pictures that grow at the same pace.
#pragma once

#include "render/renderer.h"
#include "study/error_split.h"

#include <array>
#include <chrono>
#include <functional>
#include <map>
#include <string>

namespace tyndall::study {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start);

/// When to end, and which clock tells what work takes.
struct Limits {
    Clock::time_point deadline; ///< Renders that are not done by then are given up.
    /// Asked every now and then: whether to end at once.
    std::function<bool()> is_stopped;
    int processors = 0; ///< As in Results.

    /// A clock for the work of the device, see Level::seconds.
    double work_seconds() const;
};

enum class Outcome { done, stopped, too_slow };

/// Ranges of samples, all of one seed: what is rendered from different ones is independent.
/// Techniques use the same ones, each beginning with 0.
namespace range {
constexpr std::uint32_t length = 1u << 22; ///< No run reaches the next.
constexpr std::uint32_t runs = 0, equal_time = kRuns, first = kRuns + 1, reference = kRuns + 2;
} // namespace range

class Runs {
  public:
    /// The scene and the limits must outlive it.
    Runs(const gpu::Context& context, const Scene& scene, const Limits& limits)
        : renderer_(context, scene), limits_(limits) {}

    /// Renders samples first_sample <= s < end_sample of a range into an empty film.
    Outcome render(std::uint32_t range, std::uint32_t first_sample, std::uint32_t end_sample);

    /// Takes every run from samples() to `end` samples. Run i has range first_range + i. If the
    /// first run shows that all would take longer than is allowed, it ends there (too_slow).
    Outcome extend(std::uint32_t first_range, std::uint32_t end, double allowed_seconds);

    /// Each run, with all its samples.
    std::vector<Picture> pictures() const;
    /// Each run, with those of the last call of extend alone.
    const std::vector<Picture>& slice() const { return slice_; }
    /// What was rendered last.
    Picture film();

    const Renderer& renderer() const { return renderer_; }
    std::uint32_t samples() const { return samples_; } ///< Of each run.
    double seconds() const { return seconds_; }        ///< Of a run; see Level.
    double clock_seconds() const { return clock_seconds_; }
    const std::map<std::string, std::uint64_t>& health() const { return health_; }

  private:
    using Sums = std::vector<glm::dvec4>;

    Renderer renderer_;
    const Limits& limits_;
    std::array<Sums, kRuns> sums_;
    std::vector<Picture> slice_;
    std::uint32_t samples_ = 0;
    double seconds_ = 0, clock_seconds_ = 0;
    std::map<std::string, std::uint64_t> health_;
};

} // namespace tyndall::study

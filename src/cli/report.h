/// What a render leaves behind besides the picture: statistics, metadata, a closing line.
#pragma once

#include "cli/engine.h"
#include "cli/limits.h"

#include <optional>

namespace tyndall::cli {

struct RenderReport {
    static constexpr const char* kUnfinished = "unfinished";
    Image film; ///< As last read.
    std::uint32_t samples = 0;
    std::string stopped_by = kUnfinished;      ///< Or "spp", "time", "target-error", "signal".
    std::optional<stats::ErrorEstimate> error; ///< Of the film.
    std::optional<double> tail_share;          ///< stats::tail_share
    std::optional<Prediction> prediction;      ///< Of the end, if the render was long enough.
    struct {
        double total = 0, scene = 0, render = 0;
    } seconds;
};

/// EXR attributes: pbrt's names and tyndall:*.
ImageAttributes image_attributes(const Scene& scene, const Engine& engine,
                                 const RenderReport& report);

/// The JSON of --stats, written whole or not at all. Throws Error.
void write_stats(const std::string& file, const Scene& scene, const Engine& engine,
                 const RenderReport& report);

/// One line for each kind of mishap that occurred.
/// @param replay_command  as a user types it, up to --replay.
std::string health_text(const Health& health, const std::string& replay_command);

/// A line for the end of a render: samples, time, error.
std::string closing_text(const Scene& scene, const RenderReport& report);

} // namespace tyndall::cli

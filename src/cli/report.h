/// What a render leaves behind besides the picture: statistics, metadata, a closing line.
#pragma once

#include "cli/engine.h"

#include <optional>

namespace tyndall::cli {

struct RenderReport {
    Image film; ///< As last read.
    std::uint32_t samples = 0;
    std::string stopped_by = "spp"; ///< "spp", "time" or "signal".
    struct {
        double total = 0, scene = 0, render = 0;
    } seconds;
};

/// Relative RMSE of the image: sqrt(sum of variances / sum of squared means) over pixels and
/// channels. None as long as there is no variance (a single batch, or a picture that is black).
std::optional<double> relative_rmse(const Image& film, std::uint32_t samples);

/// EXR attributes: pbrt's names and tyndall:*.
ImageAttributes image_attributes(const Scene& scene, const Engine& engine,
                                 const RenderReport& report);

/// The JSON of --stats, written whole or not at all. Throws Error.
void write_stats(const std::string& file, const Scene& scene, const Engine& engine,
                 const RenderReport& report);

/// Lines for the end of a render: samples, time, error, and what went wrong.
std::string closing_text(const Scene& scene, const Engine& engine, const RenderReport& report);

} // namespace tyndall::cli

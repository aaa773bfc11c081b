#include "cli/limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::cli {
namespace {

/// What is foreseen may be off by this factor, nine times in ten.
constexpr double kMostOff = 1.25;

/// The factor within which the square of the error is known, nine times in ten; none where tails
/// are heavy, and errors need not fall as 1 / sqrt(samples).
double likely_range(const Progress& progress) {
    return progress.error && !progress.has_heavy_tail ? std::exp(1.645 * progress.error->variation)
                                                      : std::numeric_limits<double>::infinity();
}

/// Samples per pixel at the first look from now on with so many samples.
double next_look_at(const Progress& progress, double wanted) {
    const BatchRange batches(0, Limits::kUnlimited);
    std::uint32_t batch = progress.batches;
    while (batches.samples_before(batch) < wanted && batch < batches.end())
        batch = batches.next_look(batch);
    return batches.samples_before(batch);
}

} // namespace

bool Limits::meets_target(const Progress& progress) const {
    return target_error && progress.is_look && progress.batches >= kFewestBatches &&
           progress.error && progress.error->high < *target_error;
}

std::optional<double> samples_to_target(const Progress& progress, double target_error) {
    const double range = likely_range(progress);
    if (range > kMostOff || !std::isfinite(progress.error->high)) return std::nullopt;
    const double ratio = progress.error->high / target_error;
    const double wanted = progress.samples * ratio * ratio;
    const double samples = next_look_at(progress, wanted);
    if (next_look_at(progress, wanted / range) * kMostOff < samples ||
        next_look_at(progress, wanted * range) > samples * kMostOff)
        return std::nullopt;
    return samples;
}

std::optional<double> samples_to_half(const Progress& progress) {
    if (likely_range(progress) > kMostOff) return std::nullopt;
    return 4.0 * progress.samples;
}

std::optional<Prediction> foresee_end(const Limits& limits, const Progress& progress,
                                      const Pace& pace, double before) {
    if (!pace.is_steady || !samples_to_half(progress)) return std::nullopt;
    Prediction end{.at_samples = progress.samples,
                   .at_seconds = pace.seconds,
                   .stopped_by = "spp",
                   .samples = static_cast<double>(limits.end_samples)};
    const auto limit = [&](double samples, const char* name) {
        if (samples >= end.samples) return;
        end.samples = std::max<double>(samples, progress.samples);
        end.stopped_by = name;
    };
    if (limits.target_error) {
        const std::optional<double> samples = samples_to_target(progress, *limits.target_error);
        if (!samples) return std::nullopt;
        limit(*samples, "target-error");
    }
    if (limits.time) {
        const double left = *limits.time - before - pace.seconds;
        limit(pace.samples + left * pace.samples_per_second, "time");
    }
    end.seconds = pace.seconds + pace.seconds_to(end.samples);
    end.relative_rmse = progress.error->relative_rmse * std::sqrt(progress.samples / end.samples);
    return end;
}

} // namespace tyndall::cli

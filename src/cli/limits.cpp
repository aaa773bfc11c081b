#include "cli/limits.h"

#include <algorithm>
#include <cmath>

namespace tyndall::cli {

bool Limits::meets_target(const Progress& progress) const {
    return target_error && progress.is_look && progress.batches >= kFewestBatches &&
           progress.error && progress.error->high < *target_error;
}

double samples_to_target(const Progress& progress, double target_error) {
    const double ratio = progress.error->high / target_error;
    const double wanted =
        std::min(progress.samples * ratio * ratio, static_cast<double>(Limits::kUnlimited - 1));
    if (wanted <= progress.samples) return progress.samples;
    const BatchRange batches(0, Limits::kUnlimited);
    std::uint32_t batch = progress.batches;
    while (batches.samples_before(batch) < wanted && batch < batches.end())
        batch = batches.next_look(batch);
    return batches.samples_before(batch);
}

Prediction foresee_end(const Limits& limits, const Progress& progress, const Pace& pace,
                       double before) {
    Prediction end{.at_samples = progress.samples,
                   .at_seconds = pace.seconds,
                   .stopped_by = "spp",
                   .samples = static_cast<double>(limits.end_samples)};
    const auto limit = [&](double samples, const char* name) {
        if (samples >= end.samples) return;
        end.samples = std::max<double>(samples, progress.samples);
        end.stopped_by = name;
    };
    if (limits.target_error)
        limit(samples_to_target(progress, *limits.target_error), "target-error");
    if (limits.time) {
        const double left = *limits.time - before - pace.seconds;
        limit(pace.samples + left * pace.samples_per_second, "time");
    }
    end.seconds = pace.seconds + pace.seconds_to(end.samples);
    end.relative_rmse = progress.error->relative_rmse * std::sqrt(progress.samples / end.samples);
    return end;
}

} // namespace tyndall::cli

#include "study/runner.h"

#include "core/error.h"
#include "study/cost.h"

#include <algorithm>
#include <fmt/format.h>

namespace tyndall::study {
namespace {

Level measure_level(const Runs& runs, const Reference& reference, std::uint32_t slice_samples) {
    const ErrorSplit split = split_error(runs.pictures(), reference);
    return {.samples = runs.samples(),
            .seconds = runs.seconds(),
            .clock_seconds = runs.clock_seconds(),
            .error = split.total,
            .noise = split.noise,
            .bias = split.bias,
            .slice_samples = slice_samples,
            .slice_noise = measure_noise(runs.slice(), reference.power())};
}

std::string too_slow(const TechniqueResult& r, const Share& share) {
    return fmt::format("a first sample of each pixel took {:.2g} s; {} of them do not fit into its "
                       "share of {:.2g} s",
                       r.first_seconds, kRuns, share.seconds);
}

/// Doubles the samples as long as there is time; begins in any case, but gives up if even one
/// sample takes longer than `first_seconds`.
Outcome measure_levels(Runs& runs, const Reference& reference, double seconds, double first_seconds,
                       std::vector<Level>& levels) {
    const Clock::time_point start = Clock::now();
    double next = 0; // seconds of the next slice, which has as many samples as there are now
    for (std::uint32_t samples = 1; samples < range::length; samples *= 2) {
        const double left = seconds - seconds_since(start);
        const std::uint32_t before = runs.samples();
        if (before > 0 && next > left) break;
        const Clock::time_point slice_start = Clock::now();
        const Outcome outcome =
            runs.extend(range::runs, samples, before == 0 ? first_seconds : 1e30);
        if (outcome != Outcome::done) return outcome;
        levels.push_back(measure_level(runs, reference, samples - before));
        next = seconds_since(slice_start) * (before == 0 ? 1 : 2);
    }
    return Outcome::done;
}

/// How many samples take so long, one at least.
std::uint32_t samples_in(double seconds, TechniqueResult r) {
    price(r);
    const double fit = (seconds - r.seconds_per_render) / std::max(r.seconds_per_sample, 1e-9);
    return static_cast<std::uint32_t>(std::clamp(fit, 1.0, double(range::length)));
}

TechniqueResult describe(const Technique& technique) {
    return {.name = technique.name,
            .title = technique.title,
            .family = family_name(technique.family),
            .series = technique.series,
            .parameter = technique.parameter,
            .is_unbiased = technique.is_unbiased};
}

/// The picture for the eye.
void render_equal_time(Runs& runs, double seconds, const Limits& limits, Measurement& m) {
    EqualTime& equal_time = m.result.equal_time;
    const double start = limits.work_seconds();
    m.is_interrupted =
        runs.render(range::equal_time, 0, samples_in(seconds, m.result)) == Outcome::stopped;
    equal_time.seconds = limits.work_seconds() - start;
    equal_time.samples = runs.renderer().samples(); // fewer, if the time of the study was up
    m.equal_time = runs.film();
}

} // namespace

Measurement Runner::measure(const Technique& technique, const Reference& reference,
                            const Share& share) const {
    const Clock::time_point start = Clock::now();
    Measurement m{.result = describe(technique)};
    TechniqueResult& r = m.result;
    if (kRuns * share.expected > share.seconds) {
        r.problem = fmt::format("a sample of each pixel would take about {:.2g} s; {} of them do "
                                "not fit into its share of {:.2g} s",
                                share.expected, kRuns, share.seconds);
        return m;
    }
    const Scene scene = changed_scene(scene_, technique);
    Runs runs(context_, scene, limits_);
    r.build_seconds = runs.renderer().build_seconds();
    r.compile_seconds = runs.renderer().compile_seconds();
    const Clock::time_point first = Clock::now();
    Outcome outcome = runs.render(range::first, 0, 1);
    r.first_seconds = seconds_since(first);
    if (outcome == Outcome::done)
        outcome =
            measure_levels(runs, reference, share.seconds - share.equal_time - seconds_since(start),
                           r.name == kBaseline ? 1e30 : share.seconds, r.levels);
    m.is_interrupted = outcome == Outcome::stopped;
    if (r.is_measured()) {
        const std::vector<Picture> pictures = runs.pictures();
        m.mean = average(pictures);
        r.brightness = brightness_error(pictures, reference);
        if (!m.is_interrupted) render_equal_time(runs, share.equal_time, limits_, m);
        price(r);
    } else if (!m.is_interrupted) {
        r.problem = too_slow(r, share);
    }
    r.health = runs.health();
    r.spent_seconds = seconds_since(start);
    return m;
}

Reference Runner::make_reference(double seconds, ReferenceResult& result) const {
    const Clock::time_point start = Clock::now();
    const Scene scene = changed_scene(scene_, Technique{});
    Runs runs(context_, scene, limits_);
    for (std::uint32_t samples = 1; samples > runs.samples() && samples < range::length;) {
        const Clock::time_point slice_start = Clock::now();
        const std::uint32_t before = runs.samples();
        const Outcome outcome = runs.extend(range::reference, samples, 1e30);
        if (outcome == Outcome::stopped)
            throw Error(ExitStatus::interrupted, "interrupted before there was a reference");
        if (outcome != Outcome::done) break;
        const double per_sample = seconds_since(slice_start) / (samples - before);
        const double fits = (seconds - seconds_since(start)) / per_sample;
        samples += static_cast<std::uint32_t>(std::clamp(fits, 0.0, double(samples)));
    }
    if (runs.samples() == 0)
        throw Error(ExitStatus::failed, "the time is too short for a reference: give a larger "
                                        "--budget or a smaller --size");
    Reference reference = study::make_reference(runs.pictures());
    result.samples = runs.samples() * kRuns;
    result.seconds = seconds_since(start);
    result.error = reference.error();
    return reference;
}

} // namespace tyndall::study

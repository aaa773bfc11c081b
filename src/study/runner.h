/// Measures: renders a technique until its time is used up, and says how wrong it was after every
/// doubling of its samples.
#pragma once

#include "gpu/context.h"
#include "study/results.h"
#include "study/runs.h"

namespace tyndall::study {

/// What a technique may take.
struct Share {
    double seconds = 0;    ///< By the clock, compiling included.
    double equal_time = 0; ///< Level::seconds of that for the picture EqualTime.
    /// Seconds of a sample, if that can be guessed: what cannot finish kRuns of them is not begun.
    double expected = 0;
};

/// A technique, measured, and its pictures. They are empty where the technique has no levels.
struct Measurement {
    TechniqueResult result;
    Picture mean;       ///< Of all runs, at the last level.
    Picture equal_time; ///< After EqualTime::seconds.
    bool is_interrupted = false;
};

class Runner {
  public:
    /// The scene must outlive it.
    Runner(const gpu::Context& context, const Scene& scene, Limits limits)
        : context_(context), scene_(scene), limits_(std::move(limits)) {}

    Measurement measure(const Technique& technique, const Reference& reference,
                        const Share& share) const;

    /// The unbiased reference, kRuns parts by the baseline, from samples that no technique uses.
    /// @throws Error failed: the time is too short for one sample, or the picture is black;
    ///         interrupted.
    Reference make_reference(double seconds, ReferenceResult& result) const;

  private:
    const gpu::Context& context_;
    const Scene& scene_;
    Limits limits_;
};

} // namespace tyndall::study

/// What a way of sampling is worth.
#pragma once

#include "bench/bench.h"

#include <benchmark/benchmark.h>

namespace tyndall::bench {

/// Renders with both in turns, as often as the state asks for, and reports the square error of the
/// image without it over that with it ("variance"), the time with it over that without ("time"),
/// and what both gain together ("gain"). Errors are those of heavy tails, too: where samples are
/// few they say little.
void report_gain(benchmark::State& state, Renderer& without, Renderer& with, std::uint32_t samples);

} // namespace tyndall::bench

/// What the wavefront costs, beside kernels that keep paths in registers from end to end.
#include "bench/bench.h"
#include "bench/fused_cube.h"
#include "spirv/bare_region.h"
#include "spirv/bare_unwatched.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <functional>
#include <limits>
#include <span>

namespace tyndall::bench {
namespace {

constexpr int kSize = 256;

/// Seconds of both in turns, the least of each, and their ratio.
void run_in_turns(benchmark::State& state, std::uint32_t samples,
                  const std::function<void()>& wavefront, const std::function<void()>& bar) {
    double best_wavefront = std::numeric_limits<double>::max(), best_bar = best_wavefront;
    for (auto _ : state) {
        best_wavefront = std::min(best_wavefront, cost_of(wavefront));
        best_bar = std::min(best_bar, cost_of(bar));
    }
    const double paths = double(kSize) * kSize * samples;
    state.counters["wavefront_seconds_per_Mpath"] = best_wavefront / paths * 1e6;
    state.counters["bar_seconds_per_Mpath"] = best_bar / paths * 1e6;
    state.counters["ratio"] = best_bar / best_wavefront;
}

/// Likewise of two renderers, whose images must be the same.
void compare(benchmark::State& state, std::uint32_t samples, Renderer& wavefront, Renderer& bar) {
    wavefront.render(0, 1);
    bar.render(0, 1);
    run_in_turns(
        state, samples, [&] { wavefront.render(0, samples); }, [&] { bar.render(0, samples); });
    if (bar.read_film().pixels != wavefront.read_film().pixels)
        state.SkipWithError("the images differ");
}

/// Against a kernel written for homogeneous-cube and nothing else.
void fused_cube(benchmark::State& state) {
    constexpr std::uint32_t samples = 512;
    Renderer renderer(context(), read_bench_scene("device/pbrt/homogeneous-cube", kSize));
    FusedCube fused(context(), kSize);
    renderer.render(0, 8);
    fused.render(1, 0);
    std::uint32_t seed = 0;
    run_in_turns(
        state, samples, [&] { renderer.render(0, samples); },
        [&] { fused.render(samples, ++seed); });
    state.counters["fused_mean"] = fused.read_mean();
}
BENCHMARK(fused_cube)->Name("fused_ratio/homogeneous-cube")->Iterations(6);

/// The whole program against a build of it that has nothing else in it (bare_region.glsl).
void bare_cube(benchmark::State& state, std::span<const std::uint32_t> walk_region) {
    const Scene scene = read_bench_scene("device/pbrt/homogeneous-cube", kSize);
    std::vector<StageKind> stages(stage_kinds().begin(), stage_kinds().end());
    stages.front().spirv = walk_region;
    Renderer whole(context(), scene);
    Renderer bare(context(), scene, compute_effects(scene), {}, stages);
    compare(state, 512, whole, bare);
}
BENCHMARK_CAPTURE(bare_cube, watched, bare_region_spirv)
    ->Name("bare_ratio/homogeneous-cube")
    ->Iterations(6);
BENCHMARK_CAPTURE(bare_cube, unwatched, bare_unwatched_spirv)
    ->Name("bare_ratio/unwatched")
    ->Iterations(6);

/// Against all stages in one kernel.
void fused_paths(benchmark::State& state, const std::string& name) {
    const Scene scene = read_bench_scene(name, kSize);
    Renderer renderer(context(), scene);
    Renderer fused(context(), scene, {.slots = 4096, .stages = STAGES_FUSED}); // its best
    compare(state, 64, renderer, fused);
}
BENCHMARK_CAPTURE(fused_paths, smoke_grid, "device/pbrt/smoke-grid")
    ->Name("fused_ratio/smoke-grid")
    ->Iterations(3);
BENCHMARK_CAPTURE(fused_paths, fog_room, "device/pbrt/fog-room")
    ->Name("fused_ratio/fog-room")
    ->Iterations(3);
BENCHMARK_CAPTURE(fused_paths, lantern, "bench/lantern")
    ->Name("fused_ratio/lantern")
    ->Iterations(3);
BENCHMARK_CAPTURE(fused_paths, materials, "bench/materials")
    ->Name("fused_ratio/materials")
    ->Iterations(3);

} // namespace
} // namespace tyndall::bench

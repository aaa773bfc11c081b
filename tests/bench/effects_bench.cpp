/// What effects cost that a scene does not call for: the same scene with each of them forced on,
/// and as it is, in turns.
#include "bench/bench.h"
#include "render/stages.h"
#include "support/forced_effects.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <limits>
#include <memory>

namespace tyndall::bench {
namespace {

std::int64_t instructions_of(const Renderer& renderer) {
    std::int64_t sum = 0;
    for (const auto& [name, count] : count_stage_instructions(renderer.wavefront().features()))
        sum += std::int64_t(count);
    return sum;
}

void effects(benchmark::State& state) {
    constexpr int size = 96;
    constexpr std::uint32_t samples = 64;
    const auto& [name, force] = support::kForcedEffects[static_cast<std::size_t>(state.range(0))];
    const Scene scene = read_bench_scene("bench/plain", size);
    const Effects own = compute_effects(scene);
    Effects more = own;
    force(more.features);
    Renderer plain(context(), scene, own, {}), forced(context(), scene, more, {});
    plain.render(0, 1);
    forced.render(0, 1);
    double without = std::numeric_limits<double>::max(), with = without;
    for (auto _ : state) {
        without = std::min(without, cost_of([&] { plain.render(0, samples); }));
        with = std::min(with, cost_of([&] { forced.render(0, samples); }));
    }
    state.SetLabel(name);
    state.counters["times_as_long"] = with / without;
    state.counters["seconds_per_Mpath"] = without / (double(size) * size * samples) * 1e6;
    state.counters["more_instructions"] = double(instructions_of(forced) - instructions_of(plain));
}
BENCHMARK(effects)
    ->DenseRange(0, int(support::kForcedEffects.size()) - 1)
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

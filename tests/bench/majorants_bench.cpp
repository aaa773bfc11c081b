/// The cells of majorants: what their size is worth.
#include "bench/bench.h"
#include "volume/majorants.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <limits>

namespace tyndall::bench {
namespace {

/// A cloud of 256^3 voxels: CPU time with the cells that choose_majorants takes, over the same with
/// others.
void majorant_cells(benchmark::State& state) {
    constexpr std::uint32_t samples = 8;
    Scene scene = read_bench_scene("bench/cloud", 96);
    auto& density = std::get<GridDensity>(scene.media[0].density);
    const MajorantGrid chosen = density.majorants;
    const auto cpu = [&](const MajorantGrid& majorants) {
        density.majorants = majorants;
        Renderer renderer(context(), scene);
        renderer.render(0, 1);
        return cpu_of([&] { renderer.render(0, samples); });
    };
    const MajorantGrid sixteen = build_majorants(*density.density, 16);
    const MajorantGrid global = build_majorants(*density.density, 512);
    double ours = std::numeric_limits<double>::max(), others = ours, one = ours;
    for (auto _ : state) {
        ours = std::min(ours, cpu(chosen));
        others = std::min(others, cpu(sixteen));
        one = std::min(one, cpu(global));
    }
    state.counters["voxels_per_cell_edge"] = chosen.size;
    state.counters["cpu_seconds_per_Mpath"] = ours / (96.0 * 96 * samples) * 1e6;
    state.counters["cells_of_16_over_ours"] = others / ours;
    state.counters["one_majorant_over_ours"] = one / ours;
}
BENCHMARK(majorant_cells)->Iterations(3)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

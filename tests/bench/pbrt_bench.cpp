/// The wavefront against pbrt-v4's CPU volpath at equal error: CPU time times variance on the same
/// picture. Its figures were taken when the yardstick printed kYardstickThen.
#include "bench/bench.h"
#include "bench/yardstick.h"

#include <algorithm>
#include <array>
#include <benchmark/benchmark.h>
#include <limits>

namespace tyndall::bench {
namespace {

constexpr double kYardstickThen = 0.105; // CPU seconds per million paths

/// pbrt-v4 (commit 5f7a6068, volpath, independent sampler) on 2 cores.
struct PbrtFigures {
    const char* scene;
    double cpu_seconds_per_million_paths;
    double variance_per_sample; ///< Image average of the G channel.
};
constexpr std::array<PbrtFigures, 5> kPbrt{{{"homogeneous-cube", 1.59, 0.0743},
                                            {"chromatic-ball", 2.73, 0.1268},
                                            {"fog-room", 13.8, 0.8627},
                                            {"smoke-grid", 3.14, 0.0244},
                                            {"vdb-smoke", 6.93, 0.0528}}};

/// Image average of the variance per sample, G channel.
double variance_per_sample(Renderer& renderer) {
    const Image film = renderer.read_film();
    double sum = 0;
    for (std::size_t i = 0; i < film.pixels.size(); i += 6)
        sum += static_cast<double>(film.pixels[i + 4]);
    return sum / (double(film.width) * film.height) * renderer.samples();
}

/// Time to equal error against pbrt-v4, with its independent numbers (as the scenes say) or on the
/// Sobol' points that scenes get which say nothing.
void equal_error(benchmark::State& state) {
    const PbrtFigures& pbrt = kPbrt[static_cast<std::size_t>(state.range(0))];
    constexpr int size = 128;
    const std::uint32_t samples = state.range(0) < 2 ? 512 : 128;
    Scene scene = read_bench_scene(std::string("device/pbrt/") + pbrt.scene, size);
    if (state.range(1)) scene.sampler = Sampler::sobol;
    Renderer renderer(context(), scene);
    renderer.render(0, 1);
    const double paths = double(size) * size * samples;
    double best = std::numeric_limits<double>::max(), yardstick = best, paths_walked = 1;
    std::uint32_t round = 0;
    for (auto _ : state) {
        yardstick =
            std::min(yardstick, cpu_of([&] { paths_walked = run_yardstick(++round).paths; }));
        best = std::min(best, cost_of([&] { renderer.render(0, samples); }));
    }
    const double ours = best / paths * 1e6 * variance_per_sample(renderer);
    const double theirs = pbrt.cpu_seconds_per_million_paths * pbrt.variance_per_sample;
    const double yardstick_now = yardstick / paths_walked * 1e6;
    state.SetLabel(std::string(pbrt.scene) + (state.range(1) ? ", Sobol'" : ", independent"));
    state.counters["seconds_per_Mpath"] = best / paths * 1e6;
    state.counters["variance_per_sample"] = variance_per_sample(renderer);
    state.counters["yardstick_cpu_seconds_per_Mpath"] = yardstick_now;
    state.counters["times_pbrt"] = theirs / ours * (yardstick_now / kYardstickThen);
}
BENCHMARK(equal_error)
    ->ArgsProduct({benchmark::CreateDenseRange(0, int(kPbrt.size()) - 1, 1), {0, 1}})
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

/// tyndall-bench: how fast, against what, measured in one run.
///
/// Every figure is CPU seconds of the whole process (a CPU driver's threads included), which other
/// load on the machine disturbs less than wall time. "Equal error" compares CPU time times variance
/// with pbrt-v4's CPU volpath on the same picture; its figures were taken when the yardstick
/// printed kYardstickThen.
#include "bench/fused_cube.h"
#include "bench/yardstick.h"
#include "image/image.h"
#include "render/renderer.h"
#include "scene/reader.h"
#include "volume/majorants.h"

#include <algorithm>
#include <array>
#include <benchmark/benchmark.h>
#include <limits>
#include <sys/resource.h>

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

double cpu_seconds() {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return double(t.tv_sec) + double(t.tv_usec) * 1e-6;
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// CPU seconds of what `work` does.
template<typename Work>
double cpu_of(const Work& work) {
    const double start = cpu_seconds();
    work();
    return cpu_seconds() - start;
}

gpu::Context& context() {
    static gpu::Context instance({});
    return instance;
}

/// @param path  in tests/, without its extension.
Scene read_bench_scene(const std::string& path, int size) {
    Scene scene = read_scene(std::string(TYNDALL_TEST_SOURCES) + "/" + path + ".pbrt");
    scene.film.width = scene.film.height = size;
    scene.film.bounds = {0, size, 0, size};
    fit_screen_window(scene);
    return scene;
}

/// Image average of the variance per sample, G channel.
double variance_per_sample(Renderer& renderer) {
    const Image film = renderer.read_film();
    double sum = 0;
    for (std::size_t i = 0; i < film.pixels.size(); i += 6)
        sum += static_cast<double>(film.pixels[i + 4]);
    return sum / (double(film.width) * film.height) * renderer.samples();
}

/// The wavefront against the fused kernel, in turns.
void fused_ratio(benchmark::State& state) {
    constexpr int size = 256;
    constexpr std::uint32_t samples = 512;
    Renderer renderer(context(), read_bench_scene("device/pbrt/homogeneous-cube", size));
    FusedCube fused(context(), size);
    renderer.render(0, 8);
    fused.render(1, 0);
    const double paths = double(size) * size * samples;
    double best_wavefront = std::numeric_limits<double>::max(), best_fused = best_wavefront;
    std::uint32_t seed = 0;
    for (auto _ : state) {
        best_wavefront = std::min(best_wavefront, cpu_of([&] { renderer.render(0, samples); }));
        best_fused = std::min(best_fused, cpu_of([&] { fused.render(samples, ++seed); }));
    }
    state.counters["wavefront_cpu_seconds_per_Mpath"] = best_wavefront / paths * 1e6;
    state.counters["fused_cpu_seconds_per_Mpath"] = best_fused / paths * 1e6;
    state.counters["ratio"] = best_fused / best_wavefront;
    state.counters["fused_mean"] = fused.read_mean();
}
BENCHMARK(fused_ratio)->Iterations(6)->Unit(benchmark::kMillisecond);

/// Time to equal error against pbrt-v4.
void equal_error(benchmark::State& state) {
    const PbrtFigures& pbrt = kPbrt[static_cast<std::size_t>(state.range(0))];
    constexpr int size = 128;
    const std::uint32_t samples = state.range(0) == 2 ? 16 : state.range(0) > 2 ? 128 : 512;
    Renderer renderer(context(), read_bench_scene(std::string("device/pbrt/") + pbrt.scene, size));
    renderer.render(0, 1);
    const double paths = double(size) * size * samples;
    double best = std::numeric_limits<double>::max(), yardstick = best, paths_walked = 1;
    std::uint32_t round = 0;
    for (auto _ : state) {
        yardstick =
            std::min(yardstick, cpu_of([&] { paths_walked = run_yardstick(++round).paths; }));
        best = std::min(best, cpu_of([&] { renderer.render(0, samples); }));
    }
    const double ours = best / paths * 1e6 * variance_per_sample(renderer);
    const double theirs = pbrt.cpu_seconds_per_million_paths * pbrt.variance_per_sample;
    const double yardstick_now = yardstick / paths_walked * 1e6;
    state.SetLabel(pbrt.scene);
    state.counters["cpu_seconds_per_Mpath"] = best / paths * 1e6;
    state.counters["variance_per_sample"] = variance_per_sample(renderer);
    state.counters["yardstick_cpu_seconds_per_Mpath"] = yardstick_now;
    state.counters["times_pbrt"] = theirs / ours * (yardstick_now / kYardstickThen);
}
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

BENCHMARK(equal_error)
    ->DenseRange(0, int(kPbrt.size()) - 1)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

BENCHMARK_MAIN();

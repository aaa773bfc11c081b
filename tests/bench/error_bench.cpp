/// What it costs to know the error: the part of update_film, an upper bound since that folds the
/// film too, and the looks of the host, with and without in turns.
#include "bench/bench.h"

#include <algorithm>
#include <array>
#include <benchmark/benchmark.h>
#include <limits>
#include <numeric>

namespace tyndall::bench {
namespace {

struct Subject {
    const char* scene;
    int size;
    std::uint32_t samples;
};
constexpr std::array<Subject, 3> kSubjects{{{"device/pbrt/homogeneous-cube", 256, 256},
                                            {"device/pbrt/smoke-grid", 128, 128},
                                            {"device/pbrt/fog-room", 128, 32}}};

/// Share of the device's time, in per cent.
double stage_percent(const Renderer& renderer, const std::string& name) {
    double all = 0, one = 0;
    for (const StageTime& stage : renderer.stage_times()) {
        all += stage.seconds;
        if (stage.name == name) one += stage.seconds;
    }
    return 100 * one / all;
}

void error_overhead(benchmark::State& state) {
    const Subject& subject = kSubjects[static_cast<std::size_t>(state.range(0))];
    Renderer renderer(context(), read_bench_scene(subject.scene, subject.size));
    renderer.render(0, 1);
    double blind = std::numeric_limits<double>::max(), looking = blind, film = blind;
    for (auto _ : state) {
        blind = std::min(blind, cost_of([&] { renderer.render(0, subject.samples); }));
        film = std::min(film, stage_percent(renderer, "update_film"));
        looking =
            std::min(looking, cost_of([&] {
                         renderer.render(0, subject.samples, [](const Progress&) { return true; });
                     }));
    }
    state.SetLabel(subject.scene);
    state.counters["update_film_percent"] = film;
    state.counters["looks_percent"] = 100 * (looking / blind - 1);
}
BENCHMARK(error_overhead)
    ->DenseRange(0, int(kSubjects.size()) - 1)
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

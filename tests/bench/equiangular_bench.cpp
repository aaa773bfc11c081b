/// What it is worth to look for light of small lights where paths pass: the square error of an
/// image times CPU time without it, over that with it.
#include "bench/bench.h"

#include <algorithm>
#include <array>
#include <benchmark/benchmark.h>
#include <limits>

namespace tyndall::bench {
namespace {

struct Subject {
    const char* scene;
    double density; ///< Its media are so many times as dense.
    std::uint32_t samples;
};
constexpr std::array<Subject, 8> kSubjects{{{"../scenes/beam", 1, 64},
                                            {"../scenes/beam", 20, 16},
                                            {"bench/lantern", 0.01, 64},
                                            {"bench/lantern", 0.1, 64},
                                            {"bench/lantern", 1, 64},
                                            {"bench/lantern", 10, 32},
                                            {"bench/lantern", 100, 8},
                                            {"device/pbrt/fog-room", 1, 16}}};

struct Cost {
    double cpu = std::numeric_limits<double>::max();
    double variance = 0;
};

void add_round(Renderer& renderer, std::uint64_t seed, std::uint32_t samples, Cost& cost) {
    renderer.set_seed(seed);
    cost.cpu = std::min(cost.cpu, cpu_of([&] { renderer.render(0, samples); }));
    const double error = renderer.error()->relative_rmse;
    cost.variance += error * error;
}

void equiangular_gain(benchmark::State& state) {
    const Subject& subject = kSubjects[static_cast<std::size_t>(state.range(0))];
    Scene scene = read_bench_scene(subject.scene, 128);
    for (Medium& medium : scene.media)
        medium.sigma_a *= subject.density, medium.sigma_s *= subject.density;
    const Effects effects = compute_effects(scene);
    Effects without = effects;
    without.features.has_equiangular = 0;
    std::array<Renderer, 2> renderers{Renderer(context(), scene, without, {}),
                                      Renderer(context(), scene, effects, {})};
    for (Renderer& renderer : renderers)
        renderer.render(0, 1);
    std::array<Cost, 2> costs;
    std::uint64_t seed = 0;
    for (auto _ : state) {
        for (std::size_t i = 0; i < 2; ++i)
            add_round(renderers[i], seed, subject.samples, costs[i]);
        ++seed;
    }
    const double variance = costs[0].variance / costs[1].variance;
    const double cpu = costs[1].cpu / costs[0].cpu;
    state.SetLabel(subject.scene);
    state.counters["density"] = subject.density;
    state.counters["variance"] = variance;
    state.counters["cpu"] = cpu;
    state.counters["gain"] = variance / cpu;
}
BENCHMARK(equiangular_gain)
    ->DenseRange(0, int(kSubjects.size()) - 1)
    ->Iterations(4)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

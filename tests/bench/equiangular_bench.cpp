/// What it gains to look for light of small lights where paths pass.
#include "bench/gain.h"

#include <array>
#include <benchmark/benchmark.h>

namespace tyndall::bench {
namespace {

struct Subject {
    const char* scene;
    double density; ///< Its media are so many times as dense.
    std::uint32_t samples;
};
constexpr std::array<Subject, 6> kSubjects{{{"../scenes/beam", 1, 64},
                                            {"../scenes/beam", 20, 16},
                                            {"bench/lantern", 0.01, 64},
                                            {"bench/lantern", 0.1, 64},
                                            {"bench/lantern", 1, 64},
                                            {"device/pbrt/fog-room", 1, 16}}};

void equiangular_gain(benchmark::State& state) {
    const Subject& subject = kSubjects[static_cast<std::size_t>(state.range(0))];
    Scene scene = read_bench_scene(subject.scene, 128);
    for (Medium& medium : scene.media)
        medium.sigma_a *= subject.density, medium.sigma_s *= subject.density;
    Effects effects = compute_effects(scene);
    Renderer looking(context(), scene, effects, {});
    effects.features.has_equiangular = 0;
    Renderer plain(context(), scene, effects, {});
    report_gain(state, plain, looking, subject.samples);
    state.SetLabel(subject.scene);
    state.counters["density"] = subject.density;
}
BENCHMARK(equiangular_gain)
    ->DenseRange(0, int(kSubjects.size()) - 1)
    ->Iterations(4)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

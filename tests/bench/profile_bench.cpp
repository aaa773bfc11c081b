/// Where the time of a render goes: for each stage its share of the device's time, the paths that
/// it is given each time as a share of the slots, what it takes for one, and what it moves of its
/// state.
#include "bench/bench.h"
#include "bench/state_traffic.h"
#include "gpu/specialize.h"

#include <array>
#include <benchmark/benchmark.h>

namespace tyndall::bench {
namespace {

/// One round in a submission is timed: enough samples for dozens of them.
struct Subject {
    const char* scene;
    std::uint32_t samples;
};
constexpr std::array<Subject, 5> kSubjects{{{"homogeneous-cube", 4096},
                                            {"chromatic-ball", 4096},
                                            {"fog-room", 128},
                                            {"smoke-grid", 128},
                                            {"vdb-smoke", 128}}};

void tell_stages(benchmark::State& state, const Renderer& renderer, double samples) {
    const double slots = double(renderer.stage_times().front().paths); // over all rounds
    double all = 0;
    for (const StageTime& stage : renderer.stage_times())
        all += stage.seconds;
    for (const StageTime& stage : renderer.stage_times()) {
        state.counters[stage.name + ".percent"] = 100 * stage.seconds / all;
        if (stage.paths == 0) continue;
        const double paths = double(stage.paths);
        state.counters[stage.name + ".occupancy"] = paths / slots;
        state.counters[stage.name + ".per_sample"] = paths / samples;
        state.counters[stage.name + ".ns_per_path"] = stage.seconds / paths * 1e9;
    }
}

void tell_traffic(benchmark::State& state, const Wavefront& wavefront) {
    for (const StageKind* kind : wavefront.stages()) {
        if (kind->input != StageInput::slots && kind->input != StageInput::queue) continue;
        const StateTraffic traffic = state_traffic(
            gpu::specialize(kind->spirv, kind->features(wavefront.features()), kind->name));
        state.counters[std::string(kind->name) + ".bytes_read"] = traffic.read;
        state.counters[std::string(kind->name) + ".bytes_written"] = traffic.written;
    }
}

void profile(benchmark::State& state) {
    constexpr int size = 256;
    const auto& [scene, samples] = kSubjects.at(static_cast<std::size_t>(state.range(0)));
    Renderer renderer(context(), read_bench_scene(std::string("device/pbrt/") + scene, size));
    renderer.render(0, 1);
    for (auto _ : state)
        renderer.render(0, samples);
    tell_stages(state, renderer, double(size) * size * samples);
    tell_traffic(state, renderer.wavefront());
    state.counters["state_bytes_per_path"] = 16.0 * path_texels(renderer.wavefront().features());
    state.SetLabel(scene);
}
BENCHMARK(profile)
    ->DenseRange(0, int(kSubjects.size()) - 1)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

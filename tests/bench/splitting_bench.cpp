/// What splitting paths where they first scatter could gain at best: the variance of pixels that
/// the place of it decides (between) and that of what follows (within), by the reference; and the
/// time of the device before and after.
///
/// With n goes from each such place, an estimate has the variance between + within / n and takes
/// before + n after. What both gain together is a bound: to keep the place, and to go back to it,
/// is taken for free.
#include "bench/bench.h"
#include "reference/camera.h"
#include "reference/walk.h"

#include <algorithm>
#include <array>
#include <benchmark/benchmark.h>
#include <limits>

namespace tyndall::bench {
namespace {

using namespace reference;

constexpr std::array<const char*, 4> kScenes{"device/pbrt/homogeneous-cube",
                                             "device/pbrt/smoke-grid", "device/pbrt/fog-room",
                                             "../scenes/beam"};
constexpr int kSize = 24;

struct Tracer {
    explicit Tracer(const Scene& scene)
        : camera(scene), geometry(scene, camera.position()),
          lights(scene, geometry, camera.position()), tracer(scene, geometry, lights) {}

    /// Mean of the channels.
    double radiance(int x, int y, const RandomPath& random, Replay* replay) const {
        PathReport report{.replay = replay};
        const Rgb light = tracer.radiance(camera.sample(x, y, random).ray, random, report);
        return (light.x + light.y + light.z) / 3;
    }

    PathCamera camera;
    Geometry geometry;
    Lights lights;
    PathTracer tracer;
};

/// Sums over pairs of paths that are one up to where they first scatter.
struct Split {
    double total = 0, within = 0; ///< Variances of all pixels.
    double before = 0, after = 0; ///< CPU time.

    /// Variance times work with so many goes.
    double cost(int n) const {
        return (std::max(0.0, total - within) + within / n) * (before + n * after);
    }
    int best_count() const {
        int best = 1;
        for (int n = 2; n <= 16; ++n)
            if (cost(n) < cost(best)) best = n;
        return best;
    }
};

/// Null if it does not scatter.
const PathEvent* first_scattering(const Replay& replay) {
    for (const PathEvent& e : replay.events)
        if (e.kind == PathEvent::Kind::collision || e.kind == PathEvent::Kind::surface) return &e;
    return nullptr;
}

void add_pixel(const Tracer& tracer, int x, int y, std::uint32_t samples, Split& split) {
    double sum = 0, squares = 0, within = 0;
    for (std::uint32_t i = 0; i < samples; ++i) {
        RandomPath random{{7, 0}, static_cast<std::uint32_t>(y * kSize + x), i};
        Replay replay;
        const double value = tracer.radiance(x, y, random, &replay);
        sum += value;
        squares += value * value;
        const PathEvent* scattering = first_scattering(replay);
        if (!scattering) continue;
        random.branch_event = scattering->event;
        const double other = tracer.radiance(x, y, random, nullptr);
        within += (value - other) * (value - other) / 2;
    }
    const double mean = sum / samples;
    split.total += squares / samples - mean * mean;
    split.within += within / samples;
}

/// The same program, without and with what follows.
void measure_work(Scene scene, Split& split) {
    const Effects effects = compute_effects(scene);
    Renderer whole(context(), scene, effects, {});
    scene.integrator.max_depth = 0;
    Renderer beginning(context(), scene, effects, {});
    double least_whole = std::numeric_limits<double>::max();
    split.before = least_whole;
    for (int i = 0; i < 4; ++i) {
        least_whole = std::min(least_whole, cost_of([&] { whole.render(0, 64); }));
        split.before = std::min(split.before, cost_of([&] { beginning.render(0, 64); }));
    }
    split.after = least_whole - split.before;
}

void splitting(benchmark::State& state) {
    const std::string name = kScenes[static_cast<std::size_t>(state.range(0))];
    const Scene scene = read_bench_scene(name, kSize);
    const Tracer tracer(scene);
    Split split;
    for (auto _ : state) {
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x)
                add_pixel(tracer, x, y, 256, split);
        measure_work(read_bench_scene(name, 96), split);
    }
    state.SetLabel(name);
    state.counters["within_percent"] = 100 * split.within / split.total;
    state.counters["after_percent"] = 100 * split.after / (split.before + split.after);
    state.counters["best_count"] = split.best_count();
    state.counters["best_gain"] = split.cost(1) / split.cost(split.best_count());
}
BENCHMARK(splitting)
    ->DenseRange(0, int(kScenes.size()) - 1)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

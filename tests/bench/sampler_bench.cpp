/// What a sampler is worth: mean square error times CPU time, that of independent random numbers
/// over that of Sobol' points. The error is that against an image of many times the samples from
/// another seed.
#include "bench/bench.h"

#include <algorithm>
#include <array>
#include <benchmark/benchmark.h>
#include <filesystem>
#include <limits>

namespace tyndall::bench {
namespace {

constexpr std::array<const char*, 18> kScenes{"tests/device/pbrt/homogeneous-cube",
                                              "tests/device/pbrt/chromatic-ball",
                                              "tests/device/pbrt/fog-room",
                                              "tests/device/pbrt/smoke-grid",
                                              "tests/device/pbrt/vdb-smoke",
                                              "scenes/absorb",
                                              "scenes/beam",
                                              "scenes/clear-sky",
                                              "scenes/explosion",
                                              "scenes/fogbow",
                                              "scenes/fog-room",
                                              "scenes/haze",
                                              "scenes/hazy-sky",
                                              "scenes/instances",
                                              "scenes/milk-in-glass",
                                              "scenes/nested",
                                              "scenes/slab",
                                              "scenes/smoke"};

/// Sums over pixels and channels of squares of means, and of differences from others.
struct Squares {
    double own = 0, difference = 0;
};
Squares compare(const Image& film, const Image& other) {
    Squares squares;
    for (std::size_t i = 0; i < film.pixels.size(); i += 6)
        for (std::size_t c = 0; c < 3; ++c) {
            const double a = film.pixels[i + c], b = other.pixels[i + c];
            squares.own += a * a;
            squares.difference += (a - b) * (a - b);
        }
    return squares;
}

/// Mean square difference of the images of two seeds, halved: the variance of a pixel, without a
/// reference.
struct Cost {
    double cpu = std::numeric_limits<double>::max();
    double variance = 0;
    double stated = 0; ///< By the error that the render states.
};
void add_round(Renderer& renderer, std::uint64_t seed, std::uint32_t samples, Cost& cost) {
    std::array<Image, 2> films;
    for (std::size_t i = 0; i < 2; ++i) {
        renderer.set_seed(seed + i);
        cost.cpu = std::min(cost.cpu, cpu_of([&] { renderer.render(0, samples); }));
        films[i] = renderer.read_film();
        if (const auto error = renderer.error())
            cost.stated += error->relative_rmse * error->relative_rmse / 2;
    }
    const Squares squares = compare(films[0], films[1]);
    cost.variance += squares.difference / 2 / squares.own;
}

void sampler_gain(benchmark::State& state) {
    const std::string name = kScenes[static_cast<std::size_t>(state.range(0))];
    const auto samples = static_cast<std::uint32_t>(state.range(1));
    Scene scene = read_bench_scene("../" + name, 96);
    Renderer independent(context(), scene);
    scene.sampler = Sampler::sobol;
    Renderer sobol(context(), scene);
    independent.render(0, 1);
    sobol.render(0, 1);
    Cost a, b;
    std::uint64_t seed = 0;
    for (auto _ : state) {
        add_round(independent, seed, samples, a);
        add_round(sobol, seed, samples, b);
        seed += 2;
    }
    state.SetLabel(name);
    state.counters["variance_ratio"] = a.variance / b.variance;
    state.counters["cpu_ratio"] = b.cpu / a.cpu;
    state.counters["gain"] = a.variance * a.cpu / (b.variance * b.cpu);
    state.counters["stated_independent"] = a.stated / a.variance;
    state.counters["stated_sobol"] = b.stated / b.variance;
}
BENCHMARK(sampler_gain)
    ->ArgsProduct({benchmark::CreateDenseRange(0, int(kScenes.size()) - 1, 1), {16, 64, 256}})
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

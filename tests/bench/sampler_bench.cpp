/// What a sampler is worth: the square error of an image times time, that of independent random
/// numbers over that of Sobol' points, as they are and in Z order; and the same of errors that are
/// left when the eye, a Gaussian of a pixel, has blurred them.
#include "bench/bench.h"

#include <algorithm>
#include <array>
#include <benchmark/benchmark.h>
#include <cmath>
#include <deque>
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
constexpr int kSize = 96;

using Plane = std::vector<double>;

/// Each row blurred, and the picture transposed.
Plane blur_rows(const Plane& plane) {
    Plane result(plane.size());
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x)
            for (int d = -4; d <= 4; ++d)
                result[static_cast<std::size_t>(x * kSize + y)] +=
                    std::exp(-0.5 * d * d) / 2.5066 *
                    plane[static_cast<std::size_t>(y * kSize + (x + d + kSize) % kSize)];
    return result;
}

double square_of(const Plane& plane) {
    double sum = 0;
    for (const double value : plane)
        sum += value * value;
    return sum;
}

struct Cost {
    double seconds = std::numeric_limits<double>::max();
    double error = 0, blurred = 0; ///< Squares.
    double stated = 0;             ///< As the render states it; the square of the image is 1.
    double power = 0;
};

/// Renders with two seeds: half the square of the difference is that of the error of each.
void add_round(Renderer& renderer, std::uint64_t seed, std::uint32_t samples, Cost& cost) {
    std::array<Image, 2> films;
    for (std::size_t i = 0; i < 2; ++i) {
        films[i] = render_timed(renderer, seed + i, samples, cost.seconds);
        if (const auto error = renderer.error())
            cost.stated += error->relative_rmse * error->relative_rmse / 2;
    }
    for (std::size_t c = 0; c < 3; ++c) {
        Plane first, difference;
        for (std::size_t i = c; i < films[0].pixels.size(); i += 6) {
            first.push_back(films[0].pixels[i]);
            difference.push_back(double{films[0].pixels[i]} - films[1].pixels[i]);
        }
        cost.power += square_of(first);
        cost.error += square_of(difference) / 2;
        cost.blurred += square_of(blur_rows(blur_rows(difference))) / 2;
    }
}

void sampler_gain(benchmark::State& state) {
    const std::string name = kScenes[static_cast<std::size_t>(state.range(0))];
    const auto samples = static_cast<std::uint32_t>(state.range(1));
    Scene scene = read_bench_scene("../" + name, kSize);
    scene.samples_per_pixel = static_cast<int>(samples);
    std::deque<Renderer> renderers;
    for (const Sampler sampler : {Sampler::independent, Sampler::sobol, Sampler::zsobol}) {
        scene.sampler = sampler;
        renderers.emplace_back(context(), scene).render(0, 1);
    }
    std::array<Cost, 3> costs;
    std::uint64_t seed = 0;
    for (auto _ : state) {
        for (std::size_t i = 0; i < 3; ++i)
            add_round(renderers[i], seed, samples, costs[i]);
        seed += 2;
    }
    state.SetLabel(name);
    const Cost& independent = costs[0];
    for (const std::size_t i : {1, 2}) {
        const Cost& cost = costs[i];
        const std::string p = i == 1 ? "sobol_" : "zsobol_";
        state.counters[p + "variance"] = independent.error / cost.error;
        state.counters[p + "time"] = cost.seconds / independent.seconds;
        state.counters[p + "gain"] =
            independent.error * independent.seconds / (cost.error * cost.seconds);
        state.counters[p + "blurred"] = independent.blurred / cost.blurred;
        state.counters[p + "stated"] =
            cost.stated * cost.power / (cost.error * double(state.iterations()));
    }
}
BENCHMARK(sampler_gain)
    ->ArgsProduct({benchmark::CreateDenseRange(0, int(kScenes.size()) - 1, 1), {4, 64, 256}})
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

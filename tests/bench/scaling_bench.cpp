/// How time grows with what a scene holds: lights, triangles, voxels; with a plot.
#include "bench/bench.h"
#include "bench/made_scenes.h"
#include "scene/cloud.h"
#include "study/gnuplot.h"
#include "volume/majorants.h"

#include <algorithm>
#include <array>
#include <benchmark/benchmark.h>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace tyndall::bench {
namespace {

constexpr int kPixels = 96;

/// The lamp of bench/plain cut into so many in a circle, as bright together.
Scene with_lights(int count) {
    Scene scene = read_bench_scene("bench/plain", kPixels);
    const PointLight lamp = std::get<PointLight>(scene.lights.at(0).emitter);
    scene.lights.clear();
    for (int i = 0; i < count; ++i) {
        PointLight part = lamp;
        const double angle = 2 * glm::pi<double>() * i / count;
        part.position += 0.5 * glm::dvec3(std::cos(angle), 0, std::sin(angle));
        part.intensity /= double(count);
        scene.lights.push_back({part});
    }
    return scene;
}

/// A diffuse ball in the fog of bench/plain.
Scene with_triangles(int n) {
    Scene scene = read_bench_scene("bench/plain", kPixels);
    Shape ball = scene.shapes.back(); // the floor: its material
    ball.geometry = bumpy_ball(n);
    ball.world_from_object = glm::translate(glm::dmat4(1), glm::dvec3(1.2, 0.5, 0)) *
                             glm::scale(glm::dmat4(1), glm::dvec3(0.6));
    scene.shapes.push_back(ball);
    return scene;
}

/// The fog of bench/plain as a cloud of so many voxels along an edge: the same density at the same
/// places.
Scene with_voxels(int edge) {
    Scene scene = read_bench_scene("bench/plain", kPixels);
    GridDensity density;
    density.index_from_medium = glm::translate(glm::dmat4(1), glm::dvec3(-0.5)) *
                                glm::scale(glm::dmat4(1), glm::dvec3(edge / 2.0)) *
                                glm::translate(glm::dmat4(1), glm::dvec3(1, 0.5, 1));
    density.lower = glm::dvec3(-0.5);
    density.upper = glm::dvec3(edge - 0.5);
    density.density = std::make_shared<const Grid>(make_field(edge, [&](const glm::ivec3& v) {
        return std::max(0.0, 1 + 2 * gradient_noise(4.0 * (glm::dvec3(v) + 0.5) / double(edge)));
    }));
    const Rgb sigma_t = scene.media[0].sigma_a + scene.media[0].sigma_s;
    density.majorants = choose_majorants(*density.density, 2.0 / edge, sigma_t.g);
    scene.media[0].density = density;
    return scene;
}

/// The least of several renders.
double seconds_per_million_paths(const Scene& scene) {
    constexpr std::uint32_t samples = 16;
    Renderer renderer(context(), scene);
    renderer.render(0, 1);
    double best = std::numeric_limits<double>::max();
    for (int i = 0; i < 5; ++i)
        best = std::min(best, cost_of([&] { renderer.render(0, samples); }));
    return best / (double(kPixels) * kPixels * samples) * 1e6;
}

/// What is counted, a scene with about so many, and how many.
struct Sweep {
    const char* what;
    Scene (*scene)(int);
    std::vector<int> counts;
    int few, many; ///< Of which the growth is told: twice as many, or ten times the resolution.
};
Scene with_about_triangles(int count) {
    return with_triangles(int(std::lround(std::sqrt(count / 2.0))));
}
Scene with_about_voxels(int count) {
    return with_voxels(int(std::lround(std::cbrt(count))));
}
const std::array<Sweep, 3> kSweeps{{
    {"lights", with_lights, {1, 4, 16, 64, 128, 256}, 64, 128},
    {"triangles", with_about_triangles, {1000, 4000, 16000, 70000, 140000, 280000}, 70000, 140000},
    {"voxels", with_about_voxels, {1000, 8000, 64000, 1000000, 8000000}, 8000, 8000000},
}};

/// What the sweeps so far took: seconds per million paths by count.
std::array<std::map<int, double>, kSweeps.size()> costs;

/// Draws them, each relative to its first scene, into scaling.svg in the working directory.
void draw_costs() {
    std::string script = "set terminal svg size 720,420 background 'white'\n"
                         "set logscale xy\nset grid\nset key left top\nset yrange [0.5:4]\nset "
                         "ytics (0.5, 1, 2, 4)\n"
                         "set xlabel 'how many the scene has'\n"
                         "set ylabel 'CPU time of a path, relative to the fewest'\n";
    std::string plots;
    for (std::size_t i = 0; i < kSweeps.size(); ++i) {
        script += fmt::format("$d{} << END\n", i);
        for (const auto& [count, cost] : costs[i])
            script += fmt::format("{} {:.6g}\n", count, cost / costs[i].begin()->second);
        script += "END\n";
        plots += fmt::format("{}$d{} with linespoints lw 2 title '{}'", i == 0 ? "plot " : ", ", i,
                             kSweeps[i].what);
    }
    std::ofstream("scaling.svg") << study::run_gnuplot(script + plots + "\n");
}

/// All scenes of a sweep. The last sweep draws.
void scaling(benchmark::State& state) {
    const std::size_t index = std::size_t(state.range(0));
    const Sweep& sweep = kSweeps.at(index);
    for (auto _ : state)
        for (const int count : sweep.counts) {
            costs.at(index)[count] = seconds_per_million_paths(sweep.scene(count));
            state.counters[std::to_string(count)] = costs.at(index)[count];
        }
    state.counters["times_as_long"] = costs.at(index)[sweep.many] / costs.at(index)[sweep.few];
    state.SetLabel(fmt::format("{}: CPU seconds per Mpath by how many; {} to {} takes", sweep.what,
                               sweep.few, sweep.many));
    if (index + 1 == kSweeps.size()) draw_costs();
}
BENCHMARK(scaling)
    ->DenseRange(0, int(kSweeps.size()) - 1)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

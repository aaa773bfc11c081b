/// How CPU time grows with what a scene holds: lights, triangles, voxels.
#include "bench/bench.h"
#include "bench/made_scenes.h"
#include "scene/cloud.h"
#include "volume/majorants.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace tyndall::bench {
namespace {

constexpr int kPixels = 96;

/// CPU time of the second scene over that of the first, of the best of runs in turns.
void tell_growth(benchmark::State& state, const Scene& few, const Scene& many) {
    constexpr std::uint32_t samples = 16;
    Renderer a(context(), few), b(context(), many);
    a.render(0, 1);
    b.render(0, 1);
    double of_few = std::numeric_limits<double>::max(), of_many = of_few;
    for (auto _ : state) {
        of_few = std::min(of_few, cpu_of([&] { a.render(0, samples); }));
        of_many = std::min(of_many, cpu_of([&] { b.render(0, samples); }));
    }
    state.counters["times_as_long"] = of_many / of_few;
    state.counters["cpu_seconds_per_Mpath"] = of_few / (double(kPixels) * kPixels * samples) * 1e6;
}

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

void scaling_lights(benchmark::State& state) {
    tell_growth(state, with_lights(64), with_lights(128));
}
void scaling_triangles(benchmark::State& state) {
    tell_growth(state, with_triangles(187), with_triangles(264));
}
void scaling_voxels(benchmark::State& state) {
    tell_growth(state, with_voxels(20), with_voxels(200));
}
BENCHMARK(scaling_lights)->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK(scaling_triangles)->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK(scaling_voxels)->Iterations(5)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

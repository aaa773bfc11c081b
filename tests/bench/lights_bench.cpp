/// What it gains to choose among lights by what they bring to a place: the square error of an image
/// times CPU time, without the choice over with it.
#include "bench/bench.h"
#include "bench/made_scenes.h"

#include <algorithm>
#include <array>
#include <benchmark/benchmark.h>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace tyndall::bench {
namespace {

constexpr int kSize = 64;
constexpr std::uint32_t kSamples = 64;

/// bench/hall with so many lamps under its ceiling, as bright together.
/// @param are_balls  else points
Scene with_lamps(int across, int along, bool are_balls) {
    Scene scene = read_bench_scene("bench/hall", kSize);
    Shape lamp = scene.shapes.back();
    scene.shapes.pop_back();
    const double count = double(across) * along;
    scene.area_lights[0].radiance *= 32 / count;
    const double radius = std::get<Sphere>(lamp.geometry).radius;
    const Rgb intensity = scene.area_lights[0].radiance * (glm::pi<double>() * radius * radius);
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < along; ++j) {
            const glm::dvec3 place(-4 + 8 * (i + 0.5) / across, 2.6, 16 * (j + 0.5) / along);
            lamp.world_from_object[3] = glm::dvec4(place, 1);
            if (are_balls)
                scene.shapes.push_back(lamp);
            else
                scene.lights.push_back({PointLight{intensity, place}});
        }
    return scene;
}

/// One lamp, a mesh, half of which is turned away from any place.
Scene with_mesh_lamp() {
    Scene scene = with_lamps(1, 1, true);
    Shape& lamp = scene.shapes.back();
    lamp.geometry = bumpy_ball(16);
    lamp.world_from_object = glm::translate(glm::dmat4(1), glm::dvec3(0, 2.6, 4)) *
                             glm::scale(glm::dmat4(1), glm::dvec3(0.3));
    return scene;
}

struct Cost {
    double cpu = std::numeric_limits<double>::max();
    double error = 0; ///< Square.
};

/// Renders with two seeds: half the square of the difference is that of the error of each.
void add_round(Renderer& renderer, std::uint64_t seed, Cost& cost) {
    std::array<Image, 2> films;
    for (std::size_t i = 0; i < 2; ++i) {
        renderer.set_seed(seed + i);
        cost.cpu = std::min(cost.cpu, cpu_of([&] { renderer.render(0, kSamples); }));
        films[i] = renderer.read_film();
    }
    for (std::size_t i = 0; i < films[0].pixels.size(); i += 6)
        for (std::size_t c = i; c < i + 3; ++c)
            cost.error += std::pow(double{films[0].pixels[c]} - films[1].pixels[c], 2);
}

struct Subject {
    const char* label;
    Scene (*make)();
};
const std::array<Subject, 10> kSubjects{{
    {"256 balls", [] { return with_lamps(8, 32, true); }},
    {"64 balls", [] { return with_lamps(4, 16, true); }},
    {"16 balls", [] { return with_lamps(2, 8, true); }},
    {"4 balls", [] { return with_lamps(1, 4, true); }},
    {"2 balls", [] { return with_lamps(1, 2, true); }},
    {"256 points", [] { return with_lamps(8, 32, false); }},
    {"16 points", [] { return with_lamps(2, 8, false); }},
    {"2 points", [] { return with_lamps(1, 2, false); }},
    {"a ball of 512 triangles", with_mesh_lamp},
    {"fog-room", [] { return read_bench_scene("device/pbrt/fog-room", kSize); }},
}};

void light_choice(benchmark::State& state) {
    const Subject& subject = kSubjects[static_cast<std::size_t>(state.range(0))];
    const Scene scene = subject.make();
    Effects effects = compute_effects(scene);
    Renderer choosing(context(), scene, effects, {});
    effects.features.light_candidates = 1;
    Renderer plain(context(), scene, effects, {});
    plain.render(0, 1);
    choosing.render(0, 1);
    Cost without, with;
    std::uint64_t seed = 0;
    for (auto _ : state) {
        add_round(plain, seed, without);
        add_round(choosing, seed, with);
        seed += 2;
    }
    state.SetLabel(subject.label);
    state.counters["variance"] = without.error / with.error;
    state.counters["cpu"] = with.cpu / without.cpu;
    state.counters["gain"] = without.error * without.cpu / (with.error * with.cpu);
}
BENCHMARK(light_choice)
    ->DenseRange(0, int(kSubjects.size()) - 1)
    ->Iterations(2)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

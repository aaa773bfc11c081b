/// What it gains to choose among lights by what they bring to a place.
#include "bench/gain.h"
#include "bench/made_scenes.h"

#include <array>
#include <benchmark/benchmark.h>
#include <glm/gtc/matrix_transform.hpp>

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
    report_gain(state, plain, choosing, kSamples);
    state.SetLabel(subject.label);
}
BENCHMARK(light_choice)
    ->DenseRange(0, int(kSubjects.size()) - 1)
    ->Iterations(2)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

/// The cells of majorants: what a step and a null collision cost, and what the size of cells is
/// worth.
#include "bench/bench.h"
#include "bench/made_scenes.h"
#include "scene/cloud.h"
#include "volume/majorants.h"

#include <algorithm>
#include <array>
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <map>

namespace tyndall::bench {
namespace {

constexpr int kEdge = 256; ///< Voxels along an edge of the clouds.
constexpr int kPixels = 96;

GridDensity& density_of(Scene& scene) {
    return std::get<GridDensity>(scene.media[0].density);
}

/// Seconds per million paths with the majorants that the scene has, the least of some runs.
double cpu_per_million(const Scene& scene, std::uint32_t samples, int runs = 3) {
    Renderer renderer(context(), scene);
    renderer.render(0, 1);
    double least = std::numeric_limits<double>::max();
    for (int run = 0; run < runs; ++run)
        least = std::min(least, cost_of([&] { renderer.render(0, samples); }));
    return least / (double(kPixels) * kPixels * samples) * 1e6;
}

/// The price of a null collision in steps, for choose_majorants. Rays cross a cube of voxels along
/// its x axis, more or less: through a field of nearly nothing in cells of 2 and of 8 voxels, which
/// differ by steps alone; and through one cell whose bound is due to a corner that they do not see,
/// at two depths of that bound, which differ by null collisions alone.
void majorant_price(benchmark::State& state) {
    Scene scene = read_bench_scene("bench/cloud", kPixels);
    scene.lights.resize(1); // the sky
    scene.integrator.max_depth = 0;
    scene.camera.world_from_camera = glm::dmat4(0);
    scene.camera.world_from_camera[0] = {0, 0, -1, 0};
    scene.camera.world_from_camera[1] = {0, 1, 0, 0};
    scene.camera.world_from_camera[2] = {1, 0, 0, 0};
    scene.camera.world_from_camera[3] = {-2, 0.5, 0.5, 1};
    scene.camera.fov = 8;
    const auto cpu = [&](const Grid& field, double sigma, int size) {
        GridDensity& density = density_of(scene);
        density.density = std::make_shared<const Grid>(field);
        density.majorants = build_majorants(field, size);
        scene.media[0].sigma_s = Rgb(sigma);
        return cpu_per_million(scene, 32);
    };
    const Grid thin = make_field(kEdge, [](const glm::ivec3&) { return 1e-6; });
    const Grid corner =
        make_field(kEdge, [](const glm::ivec3& v) { return v == glm::ivec3(0) ? 1 : 1e-6; });
    constexpr double few = 30, many = 90;
    for (auto _ : state) {
        const double step = (cpu(thin, 1, 2) - cpu(thin, 1, 8)) / (kEdge / 2 - kEdge / 8);
        const double null =
            (cpu(corner, many, kEdge + 2) - cpu(corner, few, kEdge + 2)) / (many - few);
        state.counters["ns_per_step"] = step * 1e3;
        state.counters["ns_per_null_collision"] = null * 1e3;
        state.counters["price"] = null / step;
    }
}
BENCHMARK(majorant_price)->Iterations(3)->Unit(benchmark::kMillisecond);

/// A cloud in the sun of which a part is empty.
struct Cloud {
    const char* name;
    int cells_of_pbrt; ///< Along an edge of its box.
    std::function<Scene()> make;
};

Scene cloud_of(const Grid& field, double sigma) {
    Scene scene = read_bench_scene("bench/cloud", kPixels);
    GridDensity& density = density_of(scene);
    density.density = std::make_shared<const Grid>(field);
    scene.media[0].sigma_s = Rgb(sigma);
    density.majorants = choose_majorants(field, 1.0 / kEdge, sigma);
    return scene;
}

/// Balls of 8 to 20 voxels' radius: 4 % of the voxels, the rest is empty.
double puffs(const glm::ivec3& voxel) {
    const glm::ivec3 block = voxel / 64;
    const unsigned hash = (unsigned(block.x) * 73856093u ^ unsigned(block.y) * 19349663u ^
                           unsigned(block.z) * 83492791u) *
                          2654435761u;
    const double radius = 8 + hash % 13;
    const glm::dvec3 center = 64.0 * glm::dvec3(block) + 32.0;
    return std::max(0.0, 1 - glm::length(glm::dvec3(voxel) - center) / radius);
}

/// Thin sheets and threads where noise is near 0.
double wisps(const glm::ivec3& voxel) {
    const glm::dvec3 p = glm::dvec3(voxel) / 40.0;
    return std::max(0.0, 1 - 12 * std::abs(gradient_noise(p)) -
                             8 * std::abs(gradient_noise(1.7 * p + 9.3)));
}

const std::array<Cloud, 4> kClouds{{
    {"dense", 16, [] { return read_bench_scene("bench/cloud", kPixels); }},
    {"puffs", 16, [] { return cloud_of(make_field(kEdge, puffs), 200); }},
    {"wisps", 16, [] { return cloud_of(make_field(kEdge, wisps), 300); }},
    {"smoke.vdb", 64, [] { return read_bench_scene("../scenes/smoke", kPixels); }},
}};

/// Time with the cells that choose_majorants takes, over the same with others.
void majorant_cells(benchmark::State& state) {
    const Cloud& cloud = kClouds[static_cast<std::size_t>(state.range(0))];
    Scene scene = cloud.make();
    GridDensity& density = density_of(scene);
    const MajorantGrid chosen = density.majorants;
    const glm::ivec3 extent = chosen.size * chosen.count;
    const int longest = std::max({extent.x, extent.y, extent.z});
    const auto cpu = [&](int size) {
        density.majorants = size == chosen.size ? chosen : build_majorants(*density.density, size);
        return cpu_per_million(scene, 8, 1);
    };
    std::map<int, double> least; // by size
    for (const int size : {1, 2, 4, 8, 16, 32, 64, longest + 2, chosen.size,
                           std::max(1, (longest + cloud.cells_of_pbrt / 2) / cloud.cells_of_pbrt)})
        least[size] = std::numeric_limits<double>::max();
    for (auto _ : state)
        for (auto& [size, seconds] : least)
            seconds = std::min(seconds, cpu(size));
    state.SetLabel(fmt::format("{}, {} voxels a cell", cloud.name, chosen.size));
    for (const auto& [size, seconds] : least)
        state.counters[size > longest ? "one_majorant" : fmt::format("cells_of_{:03}", size)] =
            seconds / least[chosen.size];
    state.counters["seconds_per_Mpath"] = least[chosen.size];
}
BENCHMARK(majorant_cells)
    ->DenseRange(0, int(kClouds.size()) - 1)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench

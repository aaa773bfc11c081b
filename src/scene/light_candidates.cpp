#include "scene/light_candidates.h"

#include "scene/emitting_voxels.h"

#include <algorithm>

namespace tyndall {
namespace {

/// More than these gain little, and take their time (tests/bench/lights_bench.cpp).
constexpr std::size_t kMost = 16;

std::size_t count_emitters(const Shape& shape) {
    if (shape.area_light < 0) return 0;
    const auto* mesh = std::get_if<Mesh>(&shape.geometry);
    return mesh ? mesh->triangles.size() + mesh->patches.size() : 1;
}

} // namespace

std::uint32_t light_candidates(const Scene& scene) {
    if (scene.integrator.kind == Integrator::Kind::singlescatter) return 1;
    std::size_t near = emitting_grids(scene).size(), far = 0;
    for (const Light& light : scene.lights) {
        if (std::holds_alternative<InfiniteLight>(light.emitter)) continue;
        ++(std::holds_alternative<DistantLight>(light.emitter) ? far : near);
    }
    for (const Shape& shape : scene.shapes)
        near += count_emitters(shape);
    return near == 0 ? 1 : static_cast<std::uint32_t>(std::min(near + far, kMost));
}

} // namespace tyndall

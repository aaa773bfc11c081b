#include "scene/emitting_voxels.h"

#include "scene/blackbody.h"

namespace tyndall {
namespace {

using ChannelGrids = std::array<std::shared_ptr<const Grid>, 3>;

Rgb scaled(Rgb coefficient, const ChannelGrids& grids, const glm::ivec3& voxel) {
    for (int c = 0; c < 3; ++c)
        if (grids[c]) coefficient[c] *= grids[c]->value(voxel);
    return coefficient;
}

bool stores(const Grid* grid, const glm::ivec3& brick) {
    if (!grid || grid->is_empty()) return false;
    const glm::ivec3 b = brick - grid->first_brick, n = grid->brick_count;
    if (glm::any(glm::lessThan(b, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(b, n)))
        return false;
    const auto index = b.x + std::size_t(n.x) * (b.y + std::size_t(n.y) * b.z);
    return grid->brick_index[index] != Grid::empty;
}

} // namespace

std::vector<int> emitting_grids(const Scene& scene) {
    std::vector<bool> used(scene.media.size(), false);
    const auto use = [&](int medium) {
        if (medium >= 0) used[medium] = true;
    };
    use(scene.camera.medium);
    for (const Shape& shape : scene.shapes) {
        if (!shape.media.is_transition()) continue;
        use(shape.media.inside);
        use(shape.media.outside);
    }
    std::vector<int> grids;
    if (scene.integrator.kind == Integrator::Kind::path) return grids;
    for (std::size_t i = 0; i < scene.media.size(); ++i) {
        const Medium& m = scene.media[i];
        const bool emits = m.emission != Rgb(0) && m.sigma_a != Rgb(0);
        if (used[i] && emits && std::holds_alternative<GridDensity>(m.density))
            grids.push_back(static_cast<int>(i));
    }
    return grids;
}

Rgb voxel_absorption(const Medium& medium, const GridDensity& density, const glm::ivec3& voxel) {
    const Rgb sigma_a = scaled(medium.sigma_a, density.sigma_a, voxel);
    return density.density ? sigma_a * double{density.density->value(voxel)} : sigma_a;
}

Rgb voxel_emission(const Medium& medium, const GridDensity& density, const glm::ivec3& voxel) {
    Rgb emission = voxel_absorption(medium, density, voxel);
    if (emission == Rgb(0)) return emission;
    emission *= scaled(medium.emission, density.emission, voxel);
    if (density.emission_scale) emission *= density.emission_scale->value(voxel);
    if (density.temperature) emission *= blackbody_radiance(density.temperature->value(voxel));
    return emission;
}

Rgb voxel_extinction(const Medium& medium, const GridDensity& density, const glm::ivec3& voxel) {
    const Rgb sigma_t = scaled(medium.sigma_a, density.sigma_a, voxel) +
                        scaled(medium.sigma_s, density.sigma_s, voxel);
    return density.density ? sigma_t * double{density.density->value(voxel)} : sigma_t;
}

std::vector<EmittingVoxel> emitting_voxels(const Medium& medium) {
    std::vector<EmittingVoxel> voxels;
    const auto* density = std::get_if<GridDensity>(&medium.density);
    if (!density || medium.emission == Rgb(0)) return voxels;
    // Where there is nothing to absorb, there is no emission.
    std::array<const Grid*, 4> absorbing{density->density.get()};
    for (int c = 0; c < 3; ++c)
        absorbing[c + 1] = density->sigma_a[c].get();
    glm::ivec3 lower(std::numeric_limits<int>::max()), upper(std::numeric_limits<int>::min());
    for (const Grid* grid : absorbing)
        if (grid && !grid->is_empty()) {
            lower = glm::min(lower, grid->first_brick);
            upper = glm::max(upper, grid->first_brick + grid->brick_count);
        }
    for (glm::ivec3 b = lower; b.z < upper.z; ++b.z)
        for (b.y = lower.y; b.y < upper.y; ++b.y)
            for (b.x = lower.x; b.x < upper.x; ++b.x) {
                bool is_stored = false;
                for (const Grid* grid : absorbing)
                    is_stored = is_stored || stores(grid, b);
                for (int i = 0; is_stored && i < kBrickVoxels; ++i) {
                    const glm::ivec3 voxel = kBrickSize * b + glm::ivec3(i & 7, i >> 3 & 7, i >> 6);
                    const Rgb e = voxel_emission(medium, *density, voxel);
                    if (const double power = (e.r + e.g + e.b) / 3; power > 0)
                        voxels.push_back({voxel, power});
                }
                if (voxels.size() > max_emitting_voxels) return {};
            }
    return voxels;
}

} // namespace tyndall

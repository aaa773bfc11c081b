#include "support/volumes.h"

#include "support/scenes.h"
#include "volume/majorants.h"

namespace tyndall::support {
namespace {

using ChannelGrids = std::array<std::shared_ptr<const Grid>, 3>;

ChannelGrids channel_grids(const Lattice& lattice,
                           const std::function<Rgb(const glm::ivec3&)>& value) {
    ChannelGrids grids;
    for (int c = 0; c < 3; ++c)
        grids[static_cast<std::size_t>(c)] =
            lattice.grid([&](const glm::ivec3& v) { return value(v)[c]; });
    return grids;
}

/// Bounds the field, and cuts the box to the cells.
void set_majorants(GridDensity& density, const Grid& field, int cell_size) {
    const MajorantGrid m = density.majorants = build_majorants(field, cell_size);
    density.lower = glm::max(density.lower, glm::dvec3(m.lower));
    density.upper = glm::min(density.upper, glm::dvec3(m.lower + m.size * m.count));
}

glm::dvec3 intervals(const Lattice& lattice) {
    return glm::dvec3(lattice.count - 1);
}

} // namespace

glm::dvec3 Lattice::place(const glm::ivec3& voxel) const {
    return lower + (upper - lower) * glm::dvec3(voxel) / intervals(*this);
}

std::shared_ptr<const Grid> Lattice::grid(const VoxelFunction& value) const {
    std::vector<float> values;
    for (int z = 0; z < count.z; ++z)
        for (int y = 0; y < count.y; ++y)
            for (int x = 0; x < count.x; ++x)
                values.push_back(static_cast<float>(value({x, y, z})));
    return std::make_shared<const Grid>(make_dense_grid(values, count));
}

GridDensity Lattice::density(const VoxelFunction& value, int cell_size) const {
    GridDensity density;
    density.index_from_medium = scaling(intervals(*this) / (upper - lower)) * translation(-lower);
    density.lower = glm::dvec3(0);
    density.upper = intervals(*this);
    density.density = grid(value);
    set_majorants(density, *density.density, cell_size);
    return density;
}

void set_channel_grids(Medium& medium, const Lattice& lattice,
                       const std::function<Rgb(const glm::ivec3&)>& sigma_a,
                       const std::function<Rgb(const glm::ivec3&)>& sigma_s) {
    GridDensity density = lattice.density([](const glm::ivec3&) { return 1; });
    density.density = nullptr;
    density.sigma_a = channel_grids(lattice, sigma_a);
    density.sigma_s = channel_grids(lattice, sigma_s);
    set_majorants(density, max_extinction(density.sigma_a, density.sigma_s), 3);
    medium.sigma_a = medium.sigma_s = Rgb(1);
    medium.density = std::move(density);
}

Scene scene_behind_two_grids() {
    Scene scene = empty_scene(8);
    scene.integrator.max_depth = 1;
    for (const double z : {2.0, 4.0}) {
        const int medium = add_medium(scene, Rgb(0.5), Rgb(0.5));
        scene.media.back().density = Lattice{{-1e3, -1e3, z}, {1e3, 1e3, z + 1}, {4, 4, 4}}.density(
            [](const glm::ivec3&) { return 1.0; });
        add_slab(scene, medium, z, z + 1);
    }
    add_shape(scene, square_mesh(10, 1, 1), {.material = add_diffuse(scene, Rgb(0.5))});
    add_light(scene, DistantLight{Rgb(1), {0, 0, -1}});
    scene.camera.world_from_camera = look_at({0, 0, 1.5}, {0, 0, 0}, {0, 1, 0});
    return scene;
}

} // namespace tyndall::support

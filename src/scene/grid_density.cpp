// What all media on voxels share.
#include "scene/grid_media.h"
#include "scene/transform.h"
#include "volume/majorants.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace tyndall {

std::optional<std::array<glm::dvec3, 2>> read_box(Parameters& parameters) {
    const glm::dvec3 p0 = parameters.get_point3("p0", {0, 0, 0});
    const glm::dvec3 p1 = parameters.get_point3("p1", {1, 1, 1});
    if (glm::all(glm::notEqual(p0, p1))) return std::array{glm::min(p0, p1), glm::max(p0, p1)};
    parameters.diagnostics().error(
        parameters.where(), fmt::format("{}: the box from \"p0\" to \"p1\" has no volume (expected "
                                        "two corners that differ on each axis)",
                                        parameters.subject()));
    return std::nullopt;
}

VoxelLattice make_lattice(const glm::ivec3& count, const std::array<glm::dvec3, 2>& box) {
    return {count, translation(glm::dvec3(-0.5)) * scaling(glm::dvec3(count) / (box[1] - box[0])) *
                       translation(-box[0])};
}

Grid read_temperature(Parameters& parameters, const Grid& raw, const VoxelBox& around) {
    const double cutoff = parameters.get_float("temperaturecutoff", 0); // the older name
    const double offset = parameters.get_float("temperatureoffset", cutoff);
    const double scale = parameters.get_float("temperaturescale", 1);
    const auto kelvin = [&](float value) { return static_cast<float>((value - offset) * scale); };
    GridBuilder builder(around);
    each_brick_of(around, [&](const glm::ivec3& brick) { builder.set_tile(brick, kelvin(0)); });
    const auto matters = [&](const glm::ivec3& brick) {
        const VoxelBox bricks{around.lower >> 3, around.upper >> 3};
        return bricks.contains(brick);
    };
    std::array<float, kBrickVoxels> values;
    raw.each_brick(
        [&](const glm::ivec3& brick, std::span<const float, kBrickVoxels> from) {
            if (!matters(brick)) return;
            std::transform(from.begin(), from.end(), values.begin(), kelvin);
            builder.set_brick(brick, values);
        },
        [&](const glm::ivec3& brick, float value) {
            if (matters(brick)) builder.set_tile(brick, kelvin(value));
        });
    return builder.finish();
}

void finish_density(GridDensity& density, const Medium& medium) {
    const bool is_rgb = !density.density;
    const Grid extinction = is_rgb ? max_extinction(density.sigma_a, density.sigma_s) : Grid{};
    const Grid& field = is_rgb ? extinction : *density.density;
    const VoxelBox support = find_support(field);
    density.lower = glm::max(density.lower, glm::dvec3(support.lower) - 1.0);
    density.upper = glm::min(density.upper, glm::dvec3(support.upper) + 1.0);
    if (support.is_empty() || glm::any(glm::greaterThanEqual(density.lower, density.upper)))
        density.lower = density.upper = glm::dvec3(0);
    const glm::dmat4 world_from_index =
        medium.world_from_medium * glm::inverse(density.index_from_medium);
    const double voxel_length = std::cbrt(std::abs(glm::determinant(glm::dmat3(world_from_index))));
    const Rgb sigma_t = medium.sigma_a + medium.sigma_s;
    density.majorants = choose_majorants(field, voxel_length,
                                         is_rgb ? 1 : std::max({sigma_t.r, sigma_t.g, sigma_t.b}));
}

} // namespace tyndall

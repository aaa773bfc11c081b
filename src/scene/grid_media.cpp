#include "scene/grid_media.h"

#include "scene/transform.h"
#include "volume/majorants.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <optional>

namespace tyndall {
namespace {

/// nx, ny, nz voxels between p0 and p1 in medium space.
struct VoxelLattice {
    glm::ivec3 count{1};
    glm::dmat4 index_from_medium{1};

    std::size_t size() const { return std::size_t(count.x) * count.y * count.z; }
    /// Of index space: voxels reach half of their size beyond their centres.
    glm::dvec3 lower() const { return glm::dvec3(-0.5); }
    glm::dvec3 upper() const { return glm::dvec3(count) - 0.5; }
};

/// Nothing after an error.
std::optional<VoxelLattice> read_lattice(Parameters& parameters) {
    VoxelLattice lattice;
    constexpr Requirement is_count{[](double x) { return x >= 1; }, "a value >= 1"};
    for (int axis = 0; axis < 3; ++axis)
        lattice.count[axis] = parameters.get_integer(std::string{'n', "xyz"[axis]}, 1, is_count);
    const glm::dvec3 p0 = parameters.get_point3("p0", {0, 0, 0});
    const glm::dvec3 p1 = parameters.get_point3("p1", {1, 1, 1});
    const glm::dvec3 lower = glm::min(p0, p1), extent = glm::abs(p1 - p0);
    if (extent.x == 0 || extent.y == 0 || extent.z == 0) {
        parameters.diagnostics().error(
            parameters.where(), fmt::format("{}: the box from \"p0\" to \"p1\" has no volume "
                                            "(expected two corners that differ on each axis)",
                                            parameters.subject()));
        return std::nullopt;
    }
    lattice.index_from_medium = translation(glm::dvec3(-0.5)) *
                                scaling(glm::dvec3(lattice.count) / extent) * translation(-lower);
    return lattice;
}

/// Values by voxel, or nothing: not given, or an error was reported.
std::optional<std::vector<float>> read_voxels(Parameters& parameters, const Parameter* parameter,
                                              const VoxelLattice& lattice,
                                              const Requirement& requirement) {
    if (!parameter) return std::nullopt;
    const glm::ivec3 n = lattice.count;
    if (parameter->numbers.size() != lattice.size()) {
        parameters.diagnostics().error(
            parameter->where,
            fmt::format("parameter {} has {} values (expected nx ny nz = {} x {} x {} = {})",
                        parameter->title(), parameter->numbers.size(), n.x, n.y, n.z,
                        double(n.x) * n.y * n.z));
        return std::nullopt;
    }
    std::vector<float> values;
    values.reserve(parameter->numbers.size());
    for (const double number : parameter->numbers) {
        if (!requirement.holds(number)) {
            const std::size_t at = values.size();
            parameters.report_value(*parameter,
                                    fmt::format("{} at voxel ({}, {}, {})", number, at % n.x,
                                                at / n.x % n.y, at / n.x / n.y),
                                    requirement.expected);
            return std::nullopt;
        }
        values.push_back(static_cast<float>(number));
    }
    return values;
}

std::shared_ptr<const Grid> make_shared_grid(std::span<const float> values,
                                             const glm::ivec3& count) {
    return std::make_shared<const Grid>(make_dense_grid(values, count));
}

/// Cuts the box to where the medium is, and bounds it.
void finish_density(GridDensity& density, const Medium& medium) {
    const VoxelBox support = find_support(*density.density);
    density.lower = glm::max(density.lower, glm::dvec3(support.lower) - 1.0);
    density.upper = glm::min(density.upper, glm::dvec3(support.upper) + 1.0);
    if (support.is_empty()) density.lower = density.upper = glm::dvec3(0);
    const glm::dmat4 world_from_index =
        medium.world_from_medium * glm::inverse(density.index_from_medium);
    const double voxel_length = std::cbrt(std::abs(glm::determinant(glm::dmat3(world_from_index))));
    const Rgb sigma_t = medium.sigma_a + medium.sigma_s;
    density.majorants = choose_majorants(*density.density, voxel_length,
                                         std::max({sigma_t.r, sigma_t.g, sigma_t.b}));
}

} // namespace

void read_uniform_grid(Parameters& parameters, Medium& medium) {
    const std::optional<VoxelLattice> lattice = read_lattice(parameters);
    const Parameter* values = parameters.find_required("float", "density");
    if (!lattice || !values) return;
    GridDensity density{.index_from_medium = lattice->index_from_medium,
                        .lower = lattice->lower(),
                        .upper = lattice->upper()};
    const auto voxels = read_voxels(parameters, values, *lattice, require::non_negative);
    if (!voxels) return;
    density.density = make_shared_grid(*voxels, lattice->count);
    finish_density(density, medium);
    medium.density = std::move(density);
}

} // namespace tyndall

#include "volume/majorants.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tyndall {
namespace {

/// Cells of that size over all points where the field is not 0; their bounds are 0.
MajorantGrid make_cells(const VoxelBox& support, int size) {
    MajorantGrid cells;
    cells.size = size;
    if (support.is_empty()) return cells;
    cells.lower = support.lower - 1;
    cells.count = (support.upper + 1 - cells.lower + size - 1) / size;
    return cells;
}

std::uint64_t cell_count(const MajorantGrid& cells) {
    return std::uint64_t(cells.count.x) * std::uint64_t(cells.count.y) *
           std::uint64_t(cells.count.z);
}

/// Raises the bounds of all cells whose points depend on a voxel. Voxel v shapes the field between
/// v - 1 and v + 1: it belongs to its own cell and, if it is the first voxel there, to the cell
/// before.
class CellRaiser {
  public:
    explicit CellRaiser(MajorantGrid& cells) : cells_(cells) {}

    /// Divisions are dear: one brick at a time.
    void raise(const glm::ivec3& brick, std::span<const float, kBrickVoxels> values) {
        std::array<glm::ivec3, kBrickSize> first, last;
        for (int i = 0; i < kBrickSize; ++i) {
            first[i] = first_cell(kBrickSize * brick + i);
            last[i] = last_cell(kBrickSize * brick + i);
        }
        for (int i = 0; i < kBrickVoxels; ++i) {
            const int x = i & 7, y = i >> 3 & 7, z = i >> 6;
            if (values[i] > 0)
                raise_cells({first[x].x, first[y].y, first[z].z}, {last[x].x, last[y].y, last[z].z},
                            values[i]);
        }
    }
    void raise(const glm::ivec3& brick, float value) {
        raise_cells(first_cell(kBrickSize * brick),
                    last_cell(kBrickSize * brick + (kBrickSize - 1)), value);
    }

  private:
    // Voxels beyond the support are 0: their cells are not used, and need not be there.
    glm::ivec3 first_cell(const glm::ivec3& voxel) const {
        return (voxel - cells_.lower - 1) / cells_.size;
    }
    glm::ivec3 last_cell(const glm::ivec3& voxel) const {
        return (voxel - cells_.lower) / cells_.size;
    }

    void raise_cells(const glm::ivec3& first, const glm::ivec3& last, float value) {
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) {
                    float& bound =
                        cells_.bounds[x + cells_.count.x * (y + std::size_t(cells_.count.y) * z)];
                    bound = std::max(bound, value);
                }
    }

    MajorantGrid& cells_;
};

/// The grid of cells of twice the size, whose bounds are the largest of their eight parts.
MajorantGrid coarsen(const MajorantGrid& fine) {
    MajorantGrid coarse{.lower = fine.lower, .size = 2 * fine.size, .count = (fine.count + 1) / 2};
    coarse.bounds.assign(cell_count(coarse), 0.0f);
    std::size_t at = 0;
    for (int z = 0; z < fine.count.z; ++z)
        for (int y = 0; y < fine.count.y; ++y)
            for (int x = 0; x < fine.count.x; ++x) {
                float& bound =
                    coarse.bounds[x / 2 +
                                  coarse.count.x * (y / 2 + std::size_t(coarse.count.y) * (z / 2))];
                bound = std::max(bound, fine.bounds[at++]);
            }
    return coarse;
}

double sum_of_voxels(const Grid& grid) {
    double sum = 0;
    grid.each_brick(
        [&](const glm::ivec3&, std::span<const float, kBrickVoxels> values) {
            double part = 0;
            for (const float value : values)
                part += value;
            sum += part;
        },
        [&](const glm::ivec3&, float value) { sum += double{value} * kBrickVoxels; });
    return sum;
}

/// Expected cost of tracking through a voxel's length, summed over the points where the field is
/// not 0 [voxels].
double tracking_cost(const MajorantGrid& cells, const VoxelBox& support, double density_sum,
                     double sigma_per_voxel) {
    // A null collision draws random numbers, takes a logarithm and reads a voxel through the brick
    // table; a step reads one bound. On lavapipe (2 cores) they take 16 ns and 3.9 ns a path:
    // `tyndall-bench --benchmark_filter=majorant_price`, three runs, ratios 4.0 to 4.4. Costs are
    // flat about their minimum (majorant_cells): the ratio need not be exact.
    constexpr double step_cost = 1, collision_cost = 4;
    const glm::dvec3 extent = glm::dvec3(support.upper - cells.lower) + 1.0;
    double bound_sum = 0;
    std::size_t at = 0;
    for (int z = 0; z < cells.count.z; ++z)
        for (int y = 0; y < cells.count.y; ++y)
            for (int x = 0; x < cells.count.x; ++x) {
                // The part of the cell that lies where the field is not 0.
                const glm::dvec3 edge = glm::min(glm::dvec3(cells.size),
                                                 extent - double(cells.size) * glm::dvec3(x, y, z));
                bound_sum += double{cells.bounds[at++]} * edge.x * edge.y * edge.z;
            }
    return step_cost * 1.5 / cells.size * extent.x * extent.y * extent.z +
           collision_cost * sigma_per_voxel * (bound_sum - density_sum);
}

} // namespace

MajorantGrid build_majorants(const Grid& grid, int size) {
    const VoxelBox support = find_support(grid);
    MajorantGrid cells = make_cells(support, size);
    TYNDALL_ASSERT(cell_count(cells) <= max_majorant_cells);
    cells.bounds.assign(cell_count(cells), 0.0f);
    CellRaiser raiser(cells);
    grid.each_brick([&](const glm::ivec3& brick, auto values) { raiser.raise(brick, values); },
                    [&](const glm::ivec3& brick, float value) { raiser.raise(brick, value); });
    return cells;
}

MajorantGrid choose_majorants(const Grid& grid, double voxel_length, double sigma) {
    const VoxelBox support = find_support(grid);
    int size = 2;
    while (cell_count(make_cells(support, size)) > max_majorant_cells)
        size *= 2;
    MajorantGrid cells = build_majorants(grid, size);
    const double density_sum = sum_of_voxels(grid);
    MajorantGrid best;
    double least = std::numeric_limits<double>::infinity();
    while (true) {
        const double cost = tracking_cost(cells, support, density_sum, sigma * voxel_length);
        if (cost < least) {
            least = cost;
            best = cells;
        }
        if (cells.size >= 64) return best;
        cells = coarsen(cells);
    }
}

Grid max_extinction(const std::array<std::shared_ptr<const Grid>, 3>& sigma_a,
                    const std::array<std::shared_ptr<const Grid>, 3>& sigma_s) {
    VoxelBox box;
    for (const auto* triple : {&sigma_a, &sigma_s})
        for (const auto& grid : *triple)
            box = box.joined({grid->lower(), grid->upper()});
    GridBuilder builder(box);
    std::array<float, kBrickVoxels> values;
    each_brick_of(box, [&](const glm::ivec3& brick) {
        for (int i = 0; i < kBrickVoxels; ++i) {
            const glm::ivec3 voxel = brick_voxel(brick, i);
            values[i] = 0;
            for (int c = 0; c < 3; ++c) {
                const float sum = sigma_a[c]->value(voxel) + sigma_s[c]->value(voxel);
                // Up, whatever way the sum was rounded, and the sum of two trilinear values may be.
                values[i] =
                    std::max(values[i],
                             sum > 0 ? std::nextafter(sum, std::numeric_limits<float>::max()) : 0);
            }
        }
        builder.set_brick(brick, values);
    });
    return builder.finish();
}

} // namespace tyndall

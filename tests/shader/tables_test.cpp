/// Tables that both sides make use of: the pixel filter's, and the batches of samples.

#include "scene/filter.h"
#include "shader/kernel.h"
#include "shared/schedule.h"
#include "spirv/batch.h"
#include "spirv/filter.h"

#include <cmath>

namespace tyndall::shader_test {

class Tables : public GpuTest {};

/// As the renderer packs it (render/scene_tables.cpp).
std::vector<glm::vec4> pack(const FilterTable& table) {
    std::vector<glm::vec4> nodes;
    for (int i = 0; i <= FilterTable::cell_count; ++i)
        nodes.emplace_back(table.density[i], table.cdf[i], table.sign_change, 0);
    return nodes;
}

/// Every 16th of all u on the grid, against the table in double precision. A table in float32 has
/// the cumulative integral to 2^-25, which is worth 2^-25 / density in position: where the density
/// vanishes that is much, so the bound is on the mass between both positions.
TEST_F(Tables, FilterSamplesAreThoseOfTheDoubleTable) {
    using Kind = PixelFilter::Kind;
    const std::vector<PixelFilter> filters{
        {.kind = Kind::gaussian, .x_radius = 1.5, .y_radius = 1.5, .sigma = 0.5},
        {.kind = Kind::gaussian, .x_radius = 3, .y_radius = 3, .sigma = 0.4},
        {.kind = Kind::mitchell, .x_radius = 2, .y_radius = 2, .b = 1 / 3.0, .c = 1 / 3.0},
        {.kind = Kind::mitchell, .x_radius = 1, .y_radius = 1, .b = 0, .c = 0.5}};
    constexpr std::uint32_t count = 1u << 20;
    Kernel kernel("filter", filter_spirv, 256, count);
    kernel.push.shapes = FilterTable::cell_count;
    for (const PixelFilter& filter : filters) {
        const FilterTable table = make_filter_table(filter, filter.x_radius);
        const auto worst_mass = [&](const std::vector<glm::vec4>& nodes) {
            double worst = 0;
            for (std::uint32_t first = 0; first < 1u << 24; first += 1u << 22) {
                const Task task{.first = first, .number = static_cast<float>(filter.x_radius)};
                const auto found = kernel.run<glm::vec4>(task, nodes, count);
                for (const glm::vec4& f : found) {
                    const FilterSample exact = sample_filter(table, double{f.z});
                    const double density =
                        std::abs(evaluate_filter(filter, filter.x_radius, exact.offset));
                    const double off = std::abs(double{f.x} - exact.offset);
                    worst = std::max(worst,
                                     off * density / evaluate_filter(filter, filter.x_radius, 0));
                    EXPECT_LE(std::abs(f.x), filter.x_radius);
                    const double from_change = std::abs(exact.offset) - table.sign_change;
                    if (f.y != exact.weight && std::abs(from_change) > off + 1e-6) worst = INFINITY;
                }
            }
            return worst;
        };
        const double bound = 4 * 0x1p-24 * filter.x_radius;
        EXPECT_LT(worst_mass(pack(table)), bound);
        const PixelFilter wrong{.kind = filter.kind,
                                .x_radius = filter.x_radius,
                                .y_radius = filter.x_radius,
                                .sigma = filter.sigma * 1.02,
                                .b = filter.b + 0.02,
                                .c = filter.c};
        EXPECT_GT(worst_mass(pack(make_filter_table(wrong, filter.x_radius))), 10 * bound)
            << "no teeth";
    }
}

TEST_F(Tables, BatchesAreTheSameOnBothSides) {
    constexpr std::uint32_t count = 1u << 20;
    Kernel kernel("batch", batch_spirv, 1, count);
    for (const std::uint32_t first : {0u, (1u << 25) - count}) {
        const auto found = kernel.run<glm::uvec4>({.first = first}, count);
        constexpr std::uint32_t batches = shared::BATCH_LOG2_LIMIT;
        constexpr std::uint32_t pieces = shared::PIECE_LOG2_LIMIT;
        for (std::uint32_t i = first; i < first + count; ++i)
            ASSERT_EQ(found[i - first],
                      glm::uvec4(shared::batch_first_sample(i), shared::first_sample_of(i, pieces),
                                 shared::number_of(i, batches), shared::number_of(i, pieces)))
                << i;
    }
}

/// Four batches of one sample, two in each doubling, then 64 samples each; no gap, no overlap.
/// Pieces likewise, up to their own length; each batch begins with one.
TEST_F(Tables, EverySampleIsInExactlyOneBatch) {
    for (const std::uint32_t limit : {shared::PIECE_LOG2_LIMIT, shared::BATCH_LOG2_LIMIT}) {
        ASSERT_EQ(shared::first_sample_of(0, limit), 0u);
        std::uint32_t first = 0;
        for (std::uint32_t i = 0; i < 1u << 20; ++i) {
            const std::uint32_t end = shared::first_sample_of(i + 1, limit);
            ASSERT_EQ(shared::first_sample_of(i, limit), first);
            std::uint32_t length = 1;
            while (length < 1u << limit && first >= 4 * length)
                length *= 2;
            ASSERT_EQ(end - first, length) << "number " << i << " from sample " << first;
            ASSERT_EQ(shared::number_of(first, limit), i);
            ASSERT_EQ(shared::number_of(end - 1, limit), i);
            first = end;
        }
    }
    for (std::uint32_t batch = 0; batch < 1u << 20; ++batch) {
        const std::uint32_t first = shared::batch_first_sample(batch);
        const std::uint32_t piece = shared::number_of(first, shared::PIECE_LOG2_LIMIT);
        ASSERT_EQ(shared::first_sample_of(piece, shared::PIECE_LOG2_LIMIT), first);
    }
}

} // namespace tyndall::shader_test

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
        for (std::uint32_t i = 0; i < count; ++i)
            ASSERT_EQ(found[i].x, shared::batch_first_sample(first + i)) << first + i;
    }
}

/// Four batches of one sample, two in each doubling, then 64 samples each; no gap, no overlap.
TEST_F(Tables, EverySampleIsInExactlyOneBatch) {
    ASSERT_EQ(shared::batch_first_sample(0), 0u);
    std::uint32_t sample = 0;
    for (std::uint32_t batch = 0; batch < 1u << 20; ++batch) {
        const std::uint32_t end = shared::batch_first_sample(batch + 1);
        ASSERT_EQ(shared::batch_first_sample(batch), sample);
        ASSERT_GT(end, sample);
        std::uint32_t length = 1;
        while (length < 64 && sample >= 4 * length)
            length *= 2;
        ASSERT_EQ(end - sample, length) << "batch " << batch << " from sample " << sample;
        sample = end;
    }
}

} // namespace tyndall::shader_test

// Counts that outgrow 32 bits, and sample indices next to their end.
#include "render/batch_range.h"
#include "render/health_counts.h"
#include "shared/schedule.h"

#include <cmath>
#include <gtest/gtest.h>

namespace tyndall::stability {
namespace {

/// The counters of the device after so many mishaps of a kind: they wrap.
shared::Control counted(std::uint64_t paths) {
    shared::Control control{};
    control.health[shared::HEALTH_NEGATIVE] = static_cast<std::uint32_t>(paths);
    control.health_pixel[shared::HEALTH_NEGATIVE] = 3 | 5 << 16;
    control.health_sample[shared::HEALTH_NEGATIVE] = static_cast<std::uint32_t>(paths);
    const std::uint64_t lost = paths << 16; // each carried 1
    control.lost_throughput_low = static_cast<std::uint32_t>(lost);
    control.lost_throughput_high = static_cast<std::uint32_t>(lost >> 32);
    return control;
}

TEST(Counters, MishapsGoBeyond2To32) {
    HealthCounts counts;
    constexpr std::uint64_t step = 3'000'000'000;
    for (std::uint64_t i = 1; i <= 10; ++i) {
        counts.take_in(counted(i * step));
        counts.take_in(counted(i * step)); // seen twice
    }
    const shared::Mishap& mishap = counts.health().kinds[shared::HEALTH_NEGATIVE];
    EXPECT_EQ(mishap.count, 10 * step);
    EXPECT_EQ(counts.health().lost_throughput, 10.0 * step);
    EXPECT_EQ(mishap.x, 3);
    EXPECT_EQ(mishap.y, 5);
    EXPECT_EQ(mishap.sample, static_cast<std::uint32_t>(step)); // of the first
    counts.restart();
    counts.take_in(counted(7));
    EXPECT_EQ(mishap.count, 10 * step + 7);
    EXPECT_EQ(counts.health()[shared::HEALTH_NONFINITE], 0);
}

/// A search over batches goes astray from sample 2^27 on: there the first sample of a batch next to
/// the middle of the search is beyond 2^32.
TEST(Counters, EverySampleHasItsBatch) {
    for (std::uint32_t power = 1; power <= 0x40000000u; power *= 2)
        for (const double factor : {1.0, 1.26, 1.59, 1.999}) {
            const auto sample = static_cast<std::uint32_t>(factor * power);
            for (const std::uint32_t s : {sample - 1, sample, sample + 1}) {
                const std::uint32_t batch = BatchRange(s, s + 1).first();
                EXPECT_LE(shared::batch_first_sample(batch), s);
                EXPECT_GT(shared::batch_first_sample(batch + 1), s) << "sample " << s;
            }
        }
}

/// Samples that are told are those that were asked for, from any to the last that there is.
TEST(Counters, RangesEndWhereTheyShould) {
    constexpr std::uint32_t last = 0x7FFFFFFF;
    for (const std::uint32_t first : {0u, 1u, 255u, 1u << 28, 400'000'001u, last - 1}) {
        const BatchRange range(first, last);
        EXPECT_EQ(range.samples_before(range.first()), 0);
        EXPECT_EQ(range.samples_before(range.end()), last - first);
        EXPECT_LT(range.samples_before(range.end() - 1), last - first);
    }
}

} // namespace
} // namespace tyndall::stability

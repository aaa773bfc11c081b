// The share of the brightest samples, from counts by brightness.
#include "stats/sample_tail.h"

#include <algorithm>
#include <bit>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <vector>

namespace tyndall::stats {
namespace {

SampleHistogram count(const std::vector<float>& samples) {
    SampleHistogram counts{};
    for (float sample : samples)
        ++counts[shared::sample_bin(std::bit_cast<std::uint32_t>(sample))];
    return counts;
}

/// By sorting.
double share_of_largest(std::vector<float> samples) {
    std::sort(samples.begin(), samples.end());
    const auto tail = samples.end() - static_cast<std::ptrdiff_t>(samples.size() / 1000);
    return std::accumulate(tail, samples.end(), 0.0) /
           std::accumulate(samples.begin(), samples.end(), 0.0);
}

TEST(SampleTail, IsTheShareOfTheBrightestThousandth) {
    std::mt19937_64 engine(1);
    for (float scale : {1e-12F, 1.F, 1e15F}) {
        for (float sigma : {0.5F, 1.5F, 3.F}) {
            std::lognormal_distribution<float> noise(0, sigma);
            std::vector<float> samples(20000);
            for (float& sample : samples)
                sample = scale * noise(engine);
            const double share = share_of_largest(samples);
            EXPECT_NEAR(*tail_share(count(samples)) / share, 1, 0.1) << sigma;
            EXPECT_EQ(share > kHeavyTailShare, sigma == 3.F); // 0.5 % and 3 %, against 46 %
        }
    }
}

TEST(SampleTail, OneBrightSampleAmongBlack) {
    std::vector<float> samples(5000, 0.F);
    EXPECT_FALSE(tail_share(count(samples)).has_value());
    EXPECT_FALSE(tail_share(count({})).has_value());
    samples[17] = 3;
    EXPECT_EQ(tail_share(count(samples)), 1);
}

TEST(SampleTail, LessThanOneSampleIsAPartOfTheBrightest) {
    EXPECT_NEAR(*tail_share(count(std::vector<float>(100, 1.F))), 0.001, 1e-12);
}

} // namespace
} // namespace tyndall::stats

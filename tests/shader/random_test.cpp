/// Random numbers: the definition, equal on both sides, without correlations or repetitions.

#include "shared/random.h"

#include "shader/kernel.h"
#include "spirv/random.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <random>

namespace tyndall::shader_test {
namespace {

using glm::uvec2;
using glm::uvec4;

struct PhiloxInput {
    uvec4 counter;
    uvec4 key;
};

constexpr std::uint32_t kMost = 1u << 20;

class Random : public GpuTest {
  protected:
    /// Words of blocks (pixel, sample, event, block) on the device.
    std::vector<uvec4> blocks(uvec2 seed, const std::vector<uvec4>& at) {
        kernel_.push.seed = seed;
        return kernel_.run<uvec4>({.function = 1}, at, static_cast<std::uint32_t>(at.size()));
    }
    std::vector<uvec4> blocks(uvec2 seed, const std::function<uvec4(std::uint32_t)>& at) {
        std::vector<uvec4> inputs(kMost);
        for (std::uint32_t i = 0; i < kMost; ++i)
            inputs[i] = at(i);
        return blocks(seed, inputs);
    }
    std::vector<uvec4> philox(const std::vector<PhiloxInput>& inputs, int rounds) {
        return kernel_.run<uvec4>({.function = 0, .number = static_cast<float>(rounds)}, inputs,
                                  static_cast<std::uint32_t>(inputs.size()));
    }
    Kernel kernel_{"random", random_spirv, 2 * kMost, kMost};
};

/// Pearson's coefficient of one word of each block.
double correlation(const std::vector<uvec4>& a, int i, const std::vector<uvec4>& b, int j) {
    double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
    const double n = static_cast<double>(a.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        const double x = a[k][i] * 0x1p-32 - 0.5, y = b[k][j] * 0x1p-32 - 0.5;
        sum_a += x;
        sum_b += y;
        aa += x * x;
        bb += y * y;
        ab += x * y;
    }
    return (n * ab - sum_a * sum_b) /
           std::sqrt((n * aa - sum_a * sum_a) * (n * bb - sum_b * sum_b));
}

bool has_repetition(std::vector<uvec4> blocks) {
    std::vector<std::array<std::uint32_t, 4>> keys;
    for (const uvec4& b : blocks)
        keys.push_back({b.x, b.y, b.z, b.w});
    std::sort(keys.begin(), keys.end());
    return std::adjacent_find(keys.begin(), keys.end()) != keys.end();
}

} // namespace

/// Known answers of Philox4x32-10: Random123's kat_vectors (Salmon et al. 2011).
TEST_F(Random, PhiloxGivesItsKnownAnswersOnBothSides) {
    const std::uint32_t ones = 0xFFFFFFFFu;
    const std::vector<PhiloxInput> inputs{
        {uvec4(0), uvec4(0)},
        {uvec4(ones), uvec4(ones)},
        {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0, 0, 0}}};
    const std::vector<uvec4> answers{{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8},
                                     {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd},
                                     {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}};
    EXPECT_EQ(philox(inputs, 10), answers);
    EXPECT_NE(philox(inputs, 9), answers) << "no teeth";
    for (std::size_t i = 0; i < inputs.size(); ++i)
        EXPECT_EQ(shared::philox(inputs[i].counter, uvec2(inputs[i].key), 10), answers[i]);
}

TEST_F(Random, DeviceAndHostDrawTheSameBits) {
    std::mt19937 random(1);
    std::vector<uvec4> at(kMost);
    for (uvec4& a : at)
        a = {random(), random(), random(), random()};
    for (const uvec2 seed : {uvec2(0), uvec2(7, 0), uvec2(0xDEADBEEF, 0x12345678)}) {
        const std::vector<uvec4> found = blocks(seed, at);
        for (std::size_t i = 0; i < at.size(); ++i)
            ASSERT_EQ(found[i], shared::random_block(seed, at[i].x, at[i].y, at[i].z, at[i].w));
    }
    const auto floats = kernel_.run<glm::vec4>({.function = 2}, at, kMost);
    for (std::size_t i = 0; i < at.size(); ++i)
        ASSERT_EQ(floats[i].x, shared::unit_float(at[i].x));
    const auto ends = kernel_.run<glm::vec4>({.function = 2}, std::vector{uvec4(0), uvec4(~0u)}, 2);
    EXPECT_EQ(ends[0].x, 0);
    EXPECT_EQ(ends[1].x, 1 - 0x1p-24f);
}

/// ORACLES T35, over 2^20 pairs: |rho| < 5 / sqrt(N).
TEST_F(Random, NeighboursAreUncorrelated) {
    const uvec2 seed(3, 0);
    const std::uint32_t width = 1024;
    const double bound = 5 / std::sqrt(double{kMost});
    const auto base = blocks(seed, [](std::uint32_t i) { return uvec4(i, 0, 1, 0); });
    const auto expect_none = [&](const char* what, const std::vector<uvec4>& other) {
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j)
                EXPECT_LT(std::abs(correlation(base, i, other, j)), bound)
                    << what << ", words " << i << " and " << j;
    };
    expect_none("the pixel to the right",
                blocks(seed, [](std::uint32_t i) { return uvec4(i + 1, 0, 1, 0); }));
    expect_none("the pixel below",
                blocks(seed, [](std::uint32_t i) { return uvec4(i + width, 0, 1, 0); }));
    expect_none("the next sample", blocks(seed, [](std::uint32_t i) { return uvec4(i, 1, 1, 0); }));
    expect_none("the next event", blocks(seed, [](std::uint32_t i) { return uvec4(i, 0, 2, 0); }));
    expect_none("the other block", blocks(seed, [](std::uint32_t i) { return uvec4(i, 0, 1, 1); }));
    expect_none("the next seed",
                blocks(seed + 1u, [](std::uint32_t i) { return uvec4(i, 0, 1, 0); }));
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j)
            EXPECT_LT(std::abs(correlation(base, i, base, j)), bound) << "words " << i << ", " << j;
    // The control: a linear congruential generator that the index seeds.
    std::vector<uvec4> a(kMost), b(kMost);
    for (std::uint32_t i = 0; i < kMost; ++i) {
        a[i] = uvec4(i * 1664525u + 1013904223u);
        b[i] = uvec4((i + 1) * 1664525u + 1013904223u);
    }
    EXPECT_GT(std::abs(correlation(a, 0, b, 0)), 0.9) << "no teeth";
}

/// ORACLES T36: a path of any length gets new numbers at each event.
TEST_F(Random, NoCounterRepeats) {
    const auto at = [](std::uint32_t i) { // 4 pixels, 4 samples, 32768 events, 2 blocks
        return uvec4(i & 3, i >> 2 & 3, i >> 5, i >> 4 & 1);
    };
    EXPECT_FALSE(has_repetition(blocks(uvec2(5, 0), at)));
    const auto wrapped = [&](std::uint32_t i) {
        const uvec4 a = at(i);
        return uvec4(a.x, a.y, a.z & 255, a.w); // an event counter of eight bits
    };
    EXPECT_TRUE(has_repetition(blocks(uvec2(5, 0), wrapped))) << "no teeth";
}

} // namespace tyndall::shader_test

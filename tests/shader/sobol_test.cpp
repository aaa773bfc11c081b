/// Sobol' points: equal on both sides, spread as they should be within a pixel, and independent
/// from pixel to pixel, event to event, block to block and pair to pair.

#include "shared/sobol.h"

#include "shader/kernel.h"
#include "shared/random.h"
#include "spirv/random.h"
#include "support/estimates.h"

#include <cmath>
#include <functional>
#include <random>

namespace tyndall::shader_test {
namespace {

using glm::uvec2;
using glm::uvec4;

using Block = decltype(&shared::sobol_block);

class Sobol : public GpuTest {};

/// The words that are a pair.
constexpr std::pair<int, int> kPairs[] = {{0, 3}, {1, 2}};

/// Whether of 2^m samples from `first` each pair has one in every rectangle of area 2^-m.
bool is_net(Block block, std::uint32_t pixel, std::uint32_t first, int m) {
    const std::uint32_t count = 1u << m;
    for (const auto& [i, j] : kPairs)
        for (int bits = 0; bits <= m; ++bits) {
            std::vector<int> cells(count);
            for (std::uint32_t s = first; s < first + count; ++s) {
                const uvec4 words = block({1, 2}, pixel, s, 3, pixel & 1u);
                const std::uint64_t column = std::uint64_t{words[i]} << bits >> 32;
                const std::uint64_t row = std::uint64_t{words[j]} << (m - bits) >> 32;
                ++cells[column << (m - bits) | row];
            }
            for (const int cell : cells)
                if (cell != 1) return false;
        }
    return true;
}

/// The samples, 2^bits each, of a square of 4 x 4 pixels, as one sequence.
uvec4 square_block(uvec2 seed, std::uint32_t square, std::uint32_t s, std::uint32_t event,
                   std::uint32_t block) {
    constexpr std::uint32_t bits = 3;
    const std::uint32_t pixel = s >> bits, sample = s & 7u;
    const std::uint32_t x = 4 * square + (pixel & 3u), y = 8 + pixel / 4;
    return shared::zsobol_block(seed, shared::morton_code(x, y), sample, event, block, bits);
}
/// The same without the order of pixels.
uvec4 separate_block(uvec2 seed, std::uint32_t square, std::uint32_t s, std::uint32_t event,
                     std::uint32_t block) {
    return shared::sobol_block(seed, 16 * square + (s >> 3), s & 7u, event, block);
}

/// Chi-squared over 64 x 64 cells of two words, in standard deviations from its mean, for so many
/// pixels.
double joint_excess(const std::function<std::pair<std::uint32_t, std::uint32_t>(std::uint32_t)>& at,
                    std::uint32_t pixels) {
    std::vector<double> cells(4096);
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
        const auto [a, b] = at(pixel);
        ++cells[(a >> 26) << 6 | b >> 26];
    }
    const double expected = pixels / 4096.0;
    double sum = 0;
    for (const double n : cells)
        sum += (n - expected) * (n - expected) / expected;
    return (sum - 4095) / std::sqrt(2 * 4095.0);
}

/// Variance, over pixels, of the mean of word i + word j over `samples` samples.
double variance_of_sum(Block block, int i, int j, std::uint32_t samples, std::uint32_t pixels) {
    double sum = 0;
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
        double mean = 0;
        for (std::uint32_t s = 0; s < samples; ++s) {
            const uvec4 words = block({5, 0}, pixel, s, 1, 0);
            mean += (words[i] + 0.5) * 0x1p-32 + (words[j] + 0.5) * 0x1p-32;
        }
        const double error = mean / samples - 1;
        sum += error * error;
    }
    return sum / pixels;
}

} // namespace

TEST_F(Sobol, DeviceAndHostDrawTheSameBits) {
    constexpr std::uint32_t count = 1u << 18;
    Kernel kernel("random", random_spirv, count, count);
    std::mt19937 random(1);
    std::vector<uvec4> at(count);
    for (uvec4& a : at)
        a = {random(), random(), random() >> 1, random() & 1u};
    for (const uvec2 seed : {uvec2(0), uvec2(0xDEADBEEF, 0x12345678)}) {
        kernel.push.seed = seed;
        const auto found = kernel.run<uvec4>({.function = 3}, at, count);
        for (std::uint32_t i = 0; i < count; ++i)
            ASSERT_EQ(found[i], shared::sobol_block(seed, at[i].x, at[i].y, at[i].z, at[i].w));
    }
}

TEST_F(Sobol, EachPowerOfTwoIsANet) {
    for (std::uint32_t pixel = 0; pixel < 20; ++pixel)
        for (int m = 0; m <= 9; ++m)
            for (const std::uint32_t at : {0u, 1u, 6u, (1u << 20) + 5u}) {
                EXPECT_TRUE(is_net(shared::sobol_block, pixel, at << m, m)) << pixel << ' ' << m;
                if (m > 2) {
                    EXPECT_FALSE(is_net(shared::random_block, pixel, at << m, m)) << "no teeth";
                    EXPECT_FALSE(is_net(shared::sobol_block, pixel, (at << m) + 1, m))
                        << "no teeth: not where a power of two begins";
                }
            }
}

TEST_F(Sobol, InZOrderPixelsTogetherAreANet) {
    for (std::uint32_t square = 0; square < 50; ++square) {
        EXPECT_TRUE(is_net(square_block, square, 0, 7)) << square; // 16 pixels of 8 samples
        EXPECT_TRUE(is_net(square_block, square, 8, 3)) << square; // each of them
        EXPECT_FALSE(is_net(separate_block, square, 0, 7)) << "no teeth";
    }
    // A picture of any size and any count has no two samples in one place.
    using shared::zsobol_block;
    EXPECT_NE(zsobol_block({1, 0}, 5, 3, 1, 0, 2), zsobol_block({1, 0}, 5, 7, 1, 0, 2));
    EXPECT_NE(zsobol_block({1, 0}, 5, 3, 1, 0, 31), zsobol_block({1, 0}, 7, 3, 1, 0, 31));
    EXPECT_NE(zsobol_block({1, 0}, 5, 0, 1, 0, 0), zsobol_block({1, 0}, 5, 1, 1, 0, 0));
}

/// Of one sample, any two words are independent, whether of one block or of neighbours.
TEST_F(Sobol, WordsAreIndependent) {
    constexpr std::uint32_t pixels = 1u << 17;
    const auto expect_none = [&](const char* what, const std::function<uvec4(std::uint32_t)>& one,
                                 const std::function<uvec4(std::uint32_t)>& other) {
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j)
                if (what[0] != '-' || i != j) {
                    const auto pair = [&](std::uint32_t p) {
                        return std::pair(one(p)[i], other(p)[j]);
                    };
                    EXPECT_LT(std::abs(joint_excess(pair, pixels)), support::pass)
                        << what << ", words " << i << " and " << j;
                }
    };
    const auto words = [](std::uint32_t pixel, std::uint32_t s, std::uint32_t event,
                          std::uint32_t block) {
        return shared::sobol_block({3, 0}, pixel, s, event, block);
    };
    for (const std::uint32_t s : {0u, 1u, 37u}) {
        const auto base = [&](std::uint32_t p) { return words(p, s, 1, 0); };
        expect_none("- itself", base, base);
        expect_none("the next pixel", base, [&](std::uint32_t p) { return words(p + 1, s, 1, 0); });
        expect_none("the next event", base, [&](std::uint32_t p) { return words(p, s, 2, 0); });
        expect_none("the other block", base, [&](std::uint32_t p) { return words(p, s, 1, 1); });
    }
    // The control: the next sample of the pixel keeps its distance.
    EXPECT_GT(
        joint_excess(
            [&](std::uint32_t p) { return std::pair(words(p, 0, 1, 0)[0], words(p, 1, 1, 0)[0]); },
            pixels),
        support::reject)
        << "no teeth";
}

/// n points, one anywhere in each interval of length 1 / n, have a mean of variance 1 / (12 n^3);
/// scrambled by Owen's rule, the two of a pair do not depend on each other within their intervals
/// (nor do words of different pairs): their sum has 1 / (6 n^3).
TEST_F(Sobol, SumsHaveTheVarianceOfOwensScrambling) {
    constexpr std::uint32_t pixels = 8192;
    for (const std::uint32_t n : {16u, 64u}) {
        const double expected = 1 / (6.0 * n * n * n);
        const double spread = expected * std::sqrt(2.0 / pixels); // sums of n terms: all but normal
        for (const auto& [i, j] : {std::pair(0, 3), std::pair(1, 2), std::pair(0, 1)}) {
            const double found = variance_of_sum(shared::sobol_block, i, j, n, pixels);
            EXPECT_LT(std::abs(found - expected), support::pass * spread) << i << ' ' << j;
            EXPECT_GT(variance_of_sum(shared::random_block, i, j, n, pixels) - expected,
                      support::reject * spread)
                << "no teeth";
        }
    }
}

} // namespace tyndall::shader_test

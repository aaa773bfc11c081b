// Bias and noise from made-up pictures whose bias and noise are known.
#include "study/error_split.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace tyndall::study {
namespace {

constexpr double pass = 4.5, reject = 6; // standard errors, as in all statistical tests here
constexpr std::size_t pixels = 400;
constexpr int trials = 400;

/// Grey pictures of brightness 1 ... 2: exact, times 1 + bias, with noise that is much larger in
/// some pixels, and skewed.
struct World {
    double bias = 0, noise = 0.5, reference_noise = 0.1;
    std::mt19937_64 engine{7};

    double truth(std::size_t pixel) const { return 1 + double(pixel) / pixels; }
    Picture picture(double shift, double sigma) {
        std::exponential_distribution<> skewed(1);
        Picture result(pixels);
        for (std::size_t i = 0; i < pixels; ++i) {
            const double spread = sigma * (i % 10 == 0 ? 3 : 1);
            result[i] = glm::dvec3(truth(i) * (1 + shift) + spread * (skewed(engine) - 1));
        }
        return result;
    }
    std::vector<Picture> pictures(double shift, double sigma) {
        std::vector<Picture> runs;
        for (std::size_t run = 0; run < kRuns; ++run)
            runs.push_back(picture(shift, sigma));
        return runs;
    }
    double power() const {
        double sum = 0;
        for (std::size_t i = 0; i < pixels; ++i)
            sum += 3 * truth(i) * truth(i);
        return sum;
    }
    /// Of a single picture.
    double noise_square() const { return noise * noise * (0.9 + 0.1 * 9) * 3 * pixels / power(); }
};

/// Mean and scatter of an estimate over many worlds, and the mean of what it says of its scatter.
struct Series {
    double sum = 0, square = 0, stated = 0;
    void add(const Estimate& e) {
        sum += e.value, square += e.value * e.value, stated += e.sd * e.sd;
    }
    double mean() const { return sum / trials; }
    double variance() const { return (square - sum * sum / trials) / (trials - 1); }
    double z(double expected) const {
        return std::abs(mean() - expected) / std::sqrt(variance() / trials);
    }
};

struct Found {
    Series bias, noise, total, naive;
};

Found repeat(World world, bool has_parts) {
    Found found;
    for (int trial = 0; trial < trials; ++trial) {
        Reference reference = make_reference(world.pictures(0, world.reference_noise));
        if (!has_parts) reference.parts.clear();
        const std::vector<Picture> runs = world.pictures(world.bias, world.noise);
        const ErrorSplit split = split_error(runs, reference);
        found.bias.add(split.bias);
        found.noise.add(split.noise);
        found.total.add(split.total);
        const Picture mean = average(runs);
        double square = 0;
        for (std::size_t i = 0; i < pixels; ++i)
            square += 3 * std::pow(mean[i].r - reference.mean[i].r, 2);
        found.naive.add({square / reference.power(), 0});
    }
    return found;
}

class ErrorSplitTest : public testing::TestWithParam<bool> {};

TEST_P(ErrorSplitTest, FindsNoBiasWhereThereIsNone) {
    const Found found = repeat({}, GetParam());
    EXPECT_LT(found.bias.z(0), pass);
    EXPECT_LT(found.noise.z(World{}.noise_square()), pass);
    EXPECT_LT(found.total.z(World{}.noise_square()), pass);
    EXPECT_GT(found.naive.z(0), reject); // teeth: the distance of the means alone is full of noise
}

TEST_P(ErrorSplitTest, FindsABiasFarBelowTheNoise) {
    const World world{.bias = 0.05};
    const Found found = repeat(world, GetParam());
    EXPECT_LT(found.bias.z(0.05 * 0.05), pass);
    EXPECT_GT(found.bias.z(0.07 * 0.07), reject); // teeth
    EXPECT_GT(found.bias.z(0), reject);
    EXPECT_LT(found.total.z(0.05 * 0.05 + world.noise_square()), pass);
}

TEST_P(ErrorSplitTest, StatesItsOwnScatter) {
    // Channels are copies of each other here, as the deviations assume. Variances of 400 trials
    // scatter by about a tenth.
    const Found found = repeat({.bias = 0.05}, GetParam());
    for (const Series* series : {&found.bias, &found.noise}) {
        const double ratio = series->stated / trials / series->variance();
        EXPECT_GT(ratio, 0.65);
        EXPECT_LT(ratio, 1.5);
    }
}

INSTANTIATE_TEST_SUITE_P(Reference, ErrorSplitTest, testing::Bool(),
                         [](const auto& test) { return test.param ? "InParts" : "AsAFile"; });

TEST(ErrorSplit, IsNotSureOfItselfWhereOnePixelDecides) {
    // Two runs saw a lamp in the only pixel that matters, two did not.
    const std::vector<Picture> dark(kRuns, Picture(2, glm::dvec3(1, 1, 1)));
    const Reference reference = make_reference(dark);
    std::vector<Picture> runs = dark;
    runs[0][0] = runs[1][0] = glm::dvec3(10, 10, 10);
    runs[2][0] = runs[3][0] = glm::dvec3(-8, -8, -8);
    const ErrorSplit split = split_error(runs, reference);
    EXPECT_LT(split.bias.value, 0);
    EXPECT_LT(std::abs(split.bias.value), 2 * split.bias.sd);
    EXPECT_GT(split.noise.sd, 0);
}

TEST(ErrorSplit, ReferenceStatesItsError) {
    World world;
    Series error;
    for (int trial = 0; trial < trials; ++trial)
        error.add(make_reference(world.pictures(0, world.noise)).error());
    EXPECT_LT(error.z(world.noise_square() / kRuns), pass);
    EXPECT_GT(error.z(world.noise_square()), reject);
}

TEST(ErrorSplit, ComparesBrightness) {
    World world;
    Series same, brighter;
    for (int trial = 0; trial < trials; ++trial) {
        const Reference reference = make_reference(world.pictures(0, world.reference_noise));
        same.add(brightness_error(world.pictures(0, world.noise), reference));
        brighter.add(brightness_error(world.pictures(0.01, world.noise), reference));
    }
    EXPECT_LT(same.z(0), pass);
    EXPECT_LT(brighter.z(0.01), pass);
    EXPECT_GT(brighter.z(0), reject);
    EXPECT_NEAR(same.stated / trials / same.variance(), 1, 0.4);
}

} // namespace
} // namespace tyndall::study

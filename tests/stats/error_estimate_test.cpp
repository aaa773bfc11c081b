// Intervals cover the error that a picture really has as often as they say, from normal samples to
// those with heavy tails.
#include "shared/schedule.h"
#include "stats/batch_film.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace tyndall::stats {
namespace {

using Engine = std::mt19937_64;

/// A kind of noise: one sample, of expectation 1.
struct Noise {
    const char* name;
    std::function<double(Engine&)> draw;
    double teeth = 0.5; ///< Intervals of this share of the width must be found too narrow.
};

double lognormal(Engine& engine, double sigma) {
    return std::lognormal_distribution<>(-0.5 * sigma * sigma, sigma)(engine);
}
/// One sample in 500 carries a tenth of the light.
double rarely_bright(Engine& engine) {
    const bool is_bright = std::bernoulli_distribution(0.002)(engine);
    return 0.9 + (is_bright ? std::exponential_distribution<>(1)(engine) * 50 : 0);
}

const Noise kSmooth[] = {
    {"normal", [](Engine& e) { return std::normal_distribution<>(1, 0.5)(e); }},
    {"exponential", [](Engine& e) { return std::exponential_distribution<>(1)(e); }},
};
const Noise kHeavy[] = {
    {"lognormal 1.5", [](Engine& e) { return lognormal(e, 1.5); }},
    {"lognormal 2.5", [](Engine& e) { return 0.8 + 0.2 * lognormal(e, 2.5); }},
    {"rarely bright", rarely_bright, 0.25},
};

constexpr std::size_t kPixels = 256;

/// Brightness of a pixel: a picture with light and shade.
double brightness(std::size_t pixel) {
    return std::exp(2 * std::sin(0.07 * static_cast<double>(pixel)));
}

/// The film after the first batches of the schedule (1 1 1 1 2 2 4 4 8 8 ...).
BatchFilm render(Engine& engine, const Noise& noise, int batches) {
    BatchFilm film(kPixels);
    std::vector<glm::dvec4> sums(kPixels);
    for (int batch = 0; batch < batches; ++batch) {
        const int samples = batch < 4 ? 1 : 1 << (batch - 2) / 2;
        for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
            double sum = 0;
            for (int i = 0; i < samples; ++i)
                sum += noise.draw(engine);
            sums[pixel] = glm::dvec4(glm::dvec3(sum * brightness(pixel)), samples);
        }
        film.fold(sums, samples);
    }
    return film;
}

double true_error(const BatchFilm& film) {
    double error = 0, truth = 0;
    for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
        const glm::dvec4& sum = film.sums()[pixel];
        const double expected = brightness(pixel), miss = sum.x / sum.w - expected;
        error += miss * miss;
        truth += expected * expected;
    }
    return std::sqrt(error / truth);
}

/// How often the interval covers the error, and how often it would with a share of its width and
/// with twice that.
struct Coverage {
    double stated = 0, narrow = 0, twice = 0;
};

Coverage coverage(const Noise& noise, int batches, int runs) {
    Engine engine(static_cast<std::uint64_t>(batches));
    Coverage covered;
    for (int run = 0; run < runs; ++run) {
        const BatchFilm film = render(engine, noise, batches);
        const auto estimate = film.error();
        if (!estimate) continue; // not covered
        const double error = true_error(film);
        const auto covers = [&](double width) {
            const double e = estimate->relative_rmse;
            return error >= e * std::pow(estimate->low / e, width) &&
                   error <= e * std::pow(estimate->high / e, width);
        };
        covered.stated += covers(1) / double(runs);
        covered.narrow += covers(noise.teeth) / double(runs);
        covered.twice += covers(2) / double(runs);
    }
    return covered;
}

/// Standard error of a share p of `runs`.
double binomial_error(double p, int runs) {
    return std::sqrt(p * (1 - p) / runs);
}

TEST(ErrorEstimate, CoversAsOftenAsItSays) {
    constexpr int runs = 600;
    for (const Noise& noise : kSmooth) {
        for (int batches : {3, 4, 8, 10}) {
            const Coverage found = coverage(noise, batches, runs);
            EXPECT_GT(found.stated, 0.90) << noise.name << ", batches: " << batches;
            EXPECT_LT(found.stated, 0.99) << noise.name << ", batches: " << batches;
            EXPECT_LT(found.narrow, 0.90 - 6 * binomial_error(0.9, runs)) << noise.name;
            EXPECT_GT(found.twice, 0.99) << noise.name;
        }
    }
}

TEST(ErrorEstimate, CoversWithHeavyTails) {
    constexpr int runs = 1000;
    for (const Noise& noise : kHeavy) {
        for (int batches : {10, 12}) { // 32 and 64 samples: some of the rare ones occur
            const Coverage found = coverage(noise, batches, runs);
            EXPECT_GT(found.stated, 0.90) << noise.name << ", batches: " << batches;
            EXPECT_LT(found.stated, 0.99 + 4.5 * binomial_error(0.99, runs)) << noise.name;
            EXPECT_LT(found.narrow, 0.90 - 6 * binomial_error(0.9, runs)) << noise.name;
        }
    }
}

/// Two batches say little, and one nothing.
TEST(ErrorEstimate, FewBatchesGiveWideIntervals) {
    Engine engine(5);
    const auto width = [&](int batches) {
        const auto estimate = render(engine, kSmooth[0], batches).error();
        return estimate ? estimate->high / estimate->low : 0;
    };
    EXPECT_EQ(width(1), 0);
    const double two = width(2), many = width(12);
    EXPECT_GT(std::log(two), 1.2 * std::log(many));
    EXPECT_GT(many, 1.1);
    const Coverage found = coverage(kSmooth[0], 2, 600);
    EXPECT_GT(found.stated, 0.9);
    EXPECT_LT(found.stated, 0.99);
}

TEST(ErrorEstimate, IsTheErrorThatTheVariancesGive) {
    Engine engine(6);
    // With batches of one size all weights are alike.
    const BatchFilm film = render(engine, kSmooth[1], 4);
    const Image image = film.image(16);
    double variance = 0, square = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 6)
        for (std::size_t c = 0; c < 3; ++c) {
            square += std::pow(double{image.pixels[i + c]}, 2);
            variance += double{image.pixels[i + 3 + c]};
        }
    EXPECT_NEAR(film.error()->relative_rmse / std::sqrt(variance / (square - variance)), 1, 1e-6);
}

TEST(ErrorEstimate, ExactPicturesHaveNone) {
    BatchFilm film(4);
    for (int batch = 0; batch < 5; ++batch)
        film.fold(std::vector<glm::dvec4>(4, glm::dvec4(0.25, 0.5, 2, 1)), 1);
    ASSERT_TRUE(film.error().has_value());
    EXPECT_EQ(film.error()->relative_rmse, 0);
    EXPECT_EQ(film.error()->high, 0);
}

/// Black as well: a render that waits for its error to fall must end.
TEST(ErrorEstimate, BlackPicturesHaveNone) {
    BatchFilm film(4);
    for (int batch = 0; batch < 5; ++batch)
        film.fold(std::vector<glm::dvec4>(4, glm::dvec4(0, 0, 0, 1)), 1);
    ASSERT_TRUE(film.error().has_value());
    EXPECT_EQ(film.error()->high, 0);
}

TEST(ErrorEstimate, BrokenPicturesHaveNoEstimate) {
    BatchFilm film(4);
    for (int batch = 0; batch < 5; ++batch)
        film.fold(std::vector<glm::dvec4>(4, glm::dvec4(1e200 * batch, 0, 0, 1)), 1);
    EXPECT_FALSE(film.error().has_value());
}

/// One sample that outshines the rest together: the error is about its size, but nothing tells how
/// bright the picture is.
TEST(ErrorEstimate, MayHaveNoUpperEnd) {
    Engine engine(7);
    BatchFilm film(64);
    std::exponential_distribution<> dim(1);
    for (int batch = 0; batch < 4; ++batch) {
        std::vector<glm::dvec4> sums(64);
        for (glm::dvec4& sum : sums)
            sum = glm::dvec4(glm::dvec3(dim(engine)), 1);
        if (batch == 2) sums[1] = glm::dvec4(40, 40, 40, 1);
        film.fold(sums, 1);
    }
    ASSERT_TRUE(film.error().has_value());
    EXPECT_TRUE(std::isinf(film.error()->high));
    EXPECT_GT(film.error()->low, 0.1);
    EXPECT_GT(film.error()->variation, 0.5);
}

/// What the weights are for: a bright sample counts the same wherever it is in the render.
TEST(ErrorEstimate, ABrightSampleCountsTheSameInEveryBatch) {
    const auto variance_with = [](int bright_batch) {
        BatchContrasts contrasts;
        double total = 0, weighted = 0, plain = 0, by_samples = 0;
        for (std::uint32_t batch = 0; batch < 13; ++batch) {
            const double before = contrasts.samples;
            const auto first = shared::batch_first_sample(batch);
            const double m = batch == 12 ? 5 : shared::batch_first_sample(batch + 1) - first;
            const double w = contrasts.add(batch, m);
            const double sum = int(batch) == bright_batch ? 1 : 0;
            if (before > 0) {
                const double c = sum - m * total / before;
                weighted += w * c * c * before / (m * (before + m));
                by_samples += m * c * c * before / (m * (before + m));
                plain += m;
            }
            total += sum;
        }
        return std::pair(weighted / contrasts.weight * contrasts.samples,
                         by_samples / plain * contrasts.samples);
    };
    for (int batch = 0; batch < 13; ++batch)
        EXPECT_NEAR(variance_with(batch).first, 1, 1e-6) << batch;
    EXPECT_GT(variance_with(0).second, 1.5) << "no teeth";
}

} // namespace
} // namespace tyndall::stats

// Stopping by the error that is seen must not make it look smaller than it is.
#include "cli/limits.h"
#include "stats/batch_film.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace tyndall::cli {
namespace {

constexpr std::size_t kPixels = 256;
using Engine = std::mt19937_64;

/// A film of samples with expectation 1, as it looks at each of the looks of a render.
class Simulation {
  public:
    explicit Simulation(std::uint64_t seed) : engine_(seed), film_(kPixels) {}

    /// Renders up to the next look.
    Progress next_look() {
        const std::uint32_t look = batches_.next_look(batch_);
        std::vector<glm::dvec4> sums(kPixels);
        for (; batch_ < look; ++batch_) {
            const std::uint32_t samples = batches_.samples_of(batch_);
            for (glm::dvec4& sum : sums) {
                // A sum of exponential samples.
                std::gamma_distribution<> noise(samples, 1);
                sum = glm::dvec4(glm::dvec3(noise(engine_)), samples);
            }
            film_.fold(sums, samples);
        }
        return {
            .samples = film_.samples(), .error = film_.error(), .is_look = true, .batches = batch_};
    }

    double true_error() const {
        double sum = 0;
        for (const glm::dvec4& pixel : film_.sums())
            sum += std::pow(pixel.x / pixel.w - 1, 2) / double(kPixels);
        return std::sqrt(sum);
    }

  private:
    Engine engine_;
    BatchRange batches_{0, Limits::kUnlimited};
    std::uint32_t batch_ = 0;
    stats::BatchFilm film_;
};

struct Stopped {
    double covered = 0; ///< Share of renders whose interval covers their error.
    double bias = 0;    ///< Mean of log(true / stated error).
    double width = 0;   ///< Mean of log(high / low) / 2.
    std::uint32_t least = Limits::kUnlimited, most = 0; ///< Samples.
};

template<typename Rule>
Stopped stop_by(const Rule& rule, int runs) {
    Stopped stopped;
    for (int run = 0; run < runs; ++run) {
        Simulation simulation(static_cast<std::uint64_t>(run));
        Progress progress = simulation.next_look();
        while (!rule(progress))
            progress = simulation.next_look();
        const stats::ErrorEstimate& e = progress.error.value();
        const double error = simulation.true_error();
        stopped.covered += (error >= e.low && error <= e.high) / double(runs);
        stopped.bias += std::log(error / e.relative_rmse) / runs;
        stopped.width += std::log(e.high / e.low) / 2 / runs;
        stopped.least = std::min(stopped.least, progress.samples);
        stopped.most = std::max(stopped.most, progress.samples);
    }
    return stopped;
}

TEST(Stopping, DoesNotBendTheError) {
    constexpr int runs = 600;
    for (double target : {0.24, 0.15, 0.1}) {
        const Limits limits{.end_samples = Limits::kUnlimited, .target_error = target};
        const Stopped found =
            stop_by([&](const Progress& p) { return limits.meets_target(p); }, runs);
        EXPECT_LT(found.least, found.most) << "no choice was made";
        EXPECT_GT(found.covered, 0.90);
        EXPECT_LT(found.covered, 0.99);
        EXPECT_LT(std::abs(found.bias), 0.25 * found.width);
    }
}

/// Control: who stops at the first glimpse of a small error is misled.
TEST(Stopping, TheTestSeesARuleThatBends) {
    Engine engine(1);
    std::normal_distribution<> noise;
    const Stopped found = stop_by(
        [&](Progress& p) {
            // A glimpse: an estimate with noise of its own, at each look.
            const double glimpse = 0.2 * noise(engine);
            p.error->relative_rmse *= std::exp(glimpse);
            p.error->low *= std::exp(glimpse);
            p.error->high *= std::exp(glimpse);
            return p.error->relative_rmse < 0.3;
        },
        600);
    EXPECT_GT(std::abs(found.bias), 0.25 * found.width);
    EXPECT_LT(found.covered, 0.9);
}

} // namespace
} // namespace tyndall::cli

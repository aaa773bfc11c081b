// The error that a render states: its interval covers the error that the image has as often as it
// says, and what it foresees comes true.
#include "cli/limits.h"
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "stats/batch_film.h"

#include <algorithm>
#include <cmath>

namespace tyndall::device_test {
namespace {

using namespace support;
using stats::ErrorEstimate;

/// Grey fog without a light. The more forward it scatters, the rarer and brighter are the samples
/// that find one.
Scene grey_fog(double sigma_s, double g) {
    Scene scene = plain_scene();
    scene.lights.clear();
    scene.media[0].sigma_a = Rgb(0.2);
    scene.media[0].sigma_s = Rgb(sigma_s);
    scene.media[0].phases.front().g = g;
    return scene;
}

Scene sunlit_fog(double sigma_s, double g) {
    Scene scene = grey_fog(sigma_s, g);
    add_light(scene, DistantLight{.irradiance = Rgb(1), .direction = {0.6, -0.64, 0.48}});
    return scene;
}

/// A point of light within: nearby, paths gain without bound, and samples have no variance.
Scene lamp_in_fog() {
    Scene scene = grey_fog(1, 0.3);
    add_light(scene, PointLight{.intensity = Rgb(1), .position = {0.3, 0.2, 0.1}});
    return scene;
}

/// A scene with its image as it should be.
class Subject {
  public:
    /// The same radiance everywhere.
    Subject(const Scene& scene, double radiance) : renderer(context(), scene) {
        renderer.render(0, 1);
        truth_ = renderer.read_film();
        std::ranges::fill(truth_.pixels, static_cast<float>(radiance));
        square_ = double(truth_.pixels.size() / 2) * radiance * radiance;
    }
    /// As good as known, by many times the samples from another seed.
    Subject(const Scene& scene, std::uint32_t reference_samples) : renderer(context(), scene) {
        renderer.set_seed(0xABCDEF);
        renderer.render(0, reference_samples);
        truth_ = renderer.read_film();
        noise_ = std::pow(renderer.error().value().relative_rmse, 2);
        for (std::size_t i = 0; i < truth_.pixels.size(); i += 6)
            for (std::size_t c = 0; c < 3; ++c)
                square_ += std::pow(double{truth_.pixels[i + c]}, 2) / (1 + noise_);
    }

    /// Relative RMSE of the film: sqrt(sum (mean - truth)^2 / sum truth^2), without what the noise
    /// of the truth adds.
    double true_error() {
        const Image film = renderer.read_film();
        double sum = 0;
        for (std::size_t i = 0; i < film.pixels.size(); i += 6)
            for (std::size_t c = 0; c < 3; ++c)
                sum += std::pow(double{film.pixels[i + c]} - double{truth_.pixels[i + c]}, 2);
        return std::sqrt(std::max(0.0, sum / square_ - noise_));
    }

    Renderer renderer;

  private:
    Image truth_;
    double noise_ = 0;  ///< Its squared relative error, as it states it.
    double square_ = 0; ///< sum truth^2
};

/// How often stated intervals cover the error, and how often they would with half and twice their
/// width; how often none is stated.
struct Coverage {
    double stated = 0, half = 0, twice = 0, none = 0;
    double below = 0,
           below_half = 0; ///< How often the error is below the upper end, or half of it.

    void add(const std::optional<ErrorEstimate>& estimate, double error) {
        if (!estimate) {
            ++none;
            return;
        }
        const double e = estimate->relative_rmse;
        const auto covers = [&](double width) {
            return error >= e * std::pow(estimate->low / e, width) &&
                   error <= e * std::pow(estimate->high / e, width);
        };
        stated += covers(1);
        below += error <= estimate->high;
        below_half += error <= 0.5 * estimate->high;
        half += covers(0.5);
        twice += covers(2);
    }
};

/// Over seeds 0 ... seeds - 1; shares.
Coverage coverage(Subject& subject, int seeds, std::uint32_t samples) {
    Coverage covered;
    for (int seed = 0; seed < seeds; ++seed) {
        subject.renderer.set_seed(static_cast<std::uint64_t>(seed));
        subject.renderer.render(0, samples);
        covered.add(subject.renderer.error(), subject.true_error());
    }
    for (double* count :
         {&covered.stated, &covered.half, &covered.twice, &covered.below, &covered.below_half})
        *count /= seeds - covered.none;
    covered.none /= seeds;
    return covered;
}

double binomial_error(double p, int n) {
    return std::sqrt(p * (1 - p) / n);
}

class ErrorTest : public DeviceTest {
  protected:
    static void expect_coverage(const Scene& scene, std::uint32_t samples, int seeds) {
        Subject subject(scene, 100 * samples);
        expect_coverage(subject, samples, seeds);
    }
    static void expect_coverage(Subject& subject, std::uint32_t samples, int seeds) {
        const Coverage found = coverage(subject, seeds, samples);
        EXPECT_GT(found.stated, 0.90);
        EXPECT_LT(found.stated, 0.99);
        EXPECT_LT(found.none, 0.05);
        EXPECT_LT(found.half, 0.90 - reject * binomial_error(0.9, seeds)) << "no teeth";
        EXPECT_GT(found.twice, 0.99) << "no teeth";
    }
};

TEST_F(ErrorTest, CoversAsOftenAsItSaysSmooth) {
    expect_coverage(plain_scene(), 16, 300);
}

TEST_F(ErrorTest, CoversAsOftenAsItSaysNoisy) {
    expect_coverage(sunlit_fog(1, 0.3), 16, 300);
}

TEST_F(ErrorTest, CoversAsOftenAsItSaysForward) {
    expect_coverage(sunlit_fog(3, 0.8), 64, 300);
}

TEST_F(ErrorTest, CoversAsOftenAsItSaysHeavyTailed) {
    expect_coverage(lamp_in_fog(), 32, 300);
}

/// Against closed forms.
TEST_F(ErrorTest, CoversAsOftenAsItSaysThinAndThick) {
    for (const double thickness : {0.1, 3.0}) {
        Subject subject(box_of_tosses(thickness), std::exp(-thickness));
        expect_coverage(subject, 32, 300);
        // The control: held against another picture, errors are others.
        Subject wrong(box_of_tosses(thickness), 0.5 * std::exp(-thickness));
        EXPECT_LT(coverage(wrong, 20, 256).stated, 0.1) << "no teeth";
    }
}

/// Batches of Sobol' points know nothing of how well they fit together: errors are stated too
/// large, but not by much, and never too small.
TEST_F(ErrorTest, StatesNoLessThanTheErrorOnSobolPoints) {
    for (Scene scene : {plain_scene(), sunlit_fog(1, 0.3)}) {
        scene.sampler = Sampler::sobol;
        for (const std::uint32_t samples : {16u, 128u}) {
            Subject subject(scene, 100 * samples);
            const Coverage found = coverage(subject, 100, samples);
            EXPECT_GT(found.below, 0.95) << samples;
            EXPECT_LT(found.below_half, 0.5) << "no teeth, at " << samples;
            EXPECT_LT(found.none, 0.05);
        }
    }
}

/// What renders foresee at their looks: how often, how often that comes true within a quarter, and
/// how often it would if errors fell as 1 / samples.
struct Foresight {
    int looks = 0, shown = 0, right = 0, wrong_law = 0;
};

/// Renders until the target is met, as the command line does.
void foresee(Renderer& renderer, double target, Foresight& found) {
    const cli::Limits limits{.end_samples = 1u << 20, .target_error = target};
    std::vector<std::pair<double, double>> foreseen; // by both laws
    renderer.render(0, limits.end_samples, [&](const Progress& progress) {
        if (limits.meets_target(progress)) return false;
        if (!progress.is_look || progress.batches < cli::Limits::kFewestBatches) return true;
        ++found.looks;
        if (const auto samples = cli::samples_to_target(progress, target))
            foreseen.emplace_back(*samples, progress.samples * progress.error->high / target);
        return true;
    });
    for (const auto& [samples, by_wrong_law] : foreseen) {
        ++found.shown;
        found.right += std::abs(samples / renderer.samples() - 1) <= 0.25;
        found.wrong_law += std::abs(by_wrong_law / renderer.samples() - 1) <= 0.25;
    }
}

Foresight foresight(const Scene& scene, double target) {
    Renderer renderer(context(), scene);
    Foresight found;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        renderer.set_seed(seed);
        foresee(renderer, target, found);
    }
    return found;
}

/// Nine times in ten, what is foreseen comes true.
TEST_F(ErrorTest, ForeseesTheSamplesThatItNeeds) {
    for (const auto& [scene, target] :
         {std::pair(plain_scene(), 0.011), std::pair(sunlit_fog(1, 0.3), 0.05)}) {
        const Foresight found = foresight(scene, target);
        EXPECT_GT(found.shown, 0.5 * found.looks);
        EXPECT_GT(found.right, 0.9 * found.shown);
        EXPECT_LT(found.wrong_law, 0.5 * found.shown) << "no teeth";
    }
}

/// Where tails are heavy, it says so.
TEST_F(ErrorTest, ForeseesNothingWhereTailsAreHeavy) {
    Scene scene = lamp_in_fog();
    set_size(scene, 32, 32);
    const Foresight found = foresight(scene, 0.3);
    EXPECT_GT(found.looks, 50);
    EXPECT_LT(found.shown, 0.05 * found.looks);
}

/// The film of the host, batch by batch.
stats::BatchFilm host_film(const Scene& scene, std::uint32_t samples) {
    stats::BatchFilm film(static_cast<std::size_t>(scene.film.bounds.width()) *
                          static_cast<std::size_t>(scene.film.bounds.height()));
    const BatchRange batches(0, samples);
    Renderer renderer(context(), scene);
    for (std::uint32_t batch = 0; batch < batches.end(); ++batch) {
        renderer.render(batches.samples_before(batch), batches.samples_before(batch + 1));
        film.fold(renderer.read_sums(), batches.samples_of(batch));
    }
    return film;
}

TEST_F(ErrorTest, DeviceAndHostStateTheSame) {
    for (const Scene& scene : {busy_scene(), plain_scene()}) {
        Renderer renderer(context(), scene);
        renderer.render(0, 27);
        const stats::BatchFilm film = host_film(scene, 27);
        ASSERT_TRUE(renderer.error() && film.error());
        EXPECT_NEAR(renderer.error()->relative_rmse / film.error()->relative_rmse, 1, 1e-5);
        EXPECT_NEAR(renderer.error()->low / film.error()->low, 1, 1e-4);
        EXPECT_NEAR(renderer.error()->high / film.error()->high, 1, 1e-4);
        EXPECT_NEAR(renderer.error()->variation / film.error()->variation, 1, 1e-3);
        EXPECT_EQ(renderer.tail_share(), stats::tail_share(film.histogram()));
        // Control: one batch less.
        EXPECT_GT(
            std::abs(host_film(scene, 24).error()->relative_rmse / film.error()->relative_rmse - 1),
            1e-3);
    }
}

TEST_F(ErrorTest, BrightnessDoesNotMatter) {
    for (Scene scene : {busy_scene(), plain_scene()}) {
        const auto estimate = [&](int exponent) {
            scene.film.iso = 100 * std::ldexp(1, exponent);
            Renderer renderer(context(), scene);
            renderer.render(0, 8);
            return renderer.error().value();
        };
        const ErrorEstimate here = estimate(0);
        for (int exponent : {-45, 45}) {
            const ErrorEstimate there = estimate(exponent);
            EXPECT_NEAR(there.relative_rmse / here.relative_rmse, 1, 1e-6) << exponent;
            EXPECT_NEAR(there.high / here.high, 1, 1e-6) << exponent;
        }
    }
}

} // namespace
} // namespace tyndall::device_test

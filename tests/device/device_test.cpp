#include "device/device_test.h"

#include "scene/reader.h"

#include <cmath>
#include <cstdlib>
#include <memory>

namespace tyndall::device_test {
namespace {

std::unique_ptr<gpu::Context>& shared_context() {
    static std::unique_ptr<gpu::Context> context;
    return context;
}

constexpr std::uint32_t kBatches = 16; ///< Of a comparison.

std::pair<std::uint32_t, std::uint32_t> batch_range(std::uint32_t samples, std::uint32_t batch) {
    return {samples * batch / kBatches, samples * (batch + 1) / kBatches};
}

} // namespace

const gpu::Context& context() {
    if (!shared_context()) {
        const char* device = std::getenv("TYNDALL_TEST_DEVICE");
        shared_context() = std::make_unique<gpu::Context>(
            gpu::ContextOptions{.device = device ? device : "llvmpipe", .validate = true});
    }
    return *shared_context();
}

void close_context() {
    shared_context().reset();
}

void DeviceTest::SetUp() {
    messages_before_ = context().validation_messages();
}

void DeviceTest::TearDown() {
    if (!shared_context()) return; // SetUp has failed
    EXPECT_EQ(context().validation_messages(), messages_before_) << "validation layer: see above";
}

Image render(const Scene& scene, std::uint32_t samples, const Tuning& tuning) {
    Renderer renderer(context(), scene, tuning);
    EXPECT_EQ(renderer.render(0, samples), samples);
    for (std::size_t kind = 0; kind < kHealthNames.size(); ++kind)
        EXPECT_EQ(renderer.health()[kind], 0) << kHealthNames[kind];
    return renderer.read_film();
}

std::vector<glm::dvec4> render_sums(const Scene& scene, std::uint32_t first, std::uint32_t end,
                                    const Tuning& tuning) {
    Renderer renderer(context(), scene, tuning);
    EXPECT_EQ(renderer.render(first, end), end - first);
    return renderer.read_sums();
}

support::Estimate mean_of(const Image& film) {
    Rgb sum(0), variance(0);
    const std::size_t pixels = film.pixels.size() / film.channels.size();
    for (std::size_t i = 0; i < pixels; ++i) {
        const float* p = &film.pixels[i * film.channels.size()];
        sum += Rgb(p[0], p[1], p[2]);
        variance += Rgb(p[3], p[4], p[5]);
    }
    const double n = static_cast<double>(pixels);
    return {sum / n, glm::sqrt(variance) / n};
}

support::Estimate mean_of(const Scene& scene, std::uint32_t samples) {
    return mean_of(render(scene, samples));
}

void expect_mean(const support::Estimate& estimate, double truth, double wrong, int channel) {
    EXPECT_LT(estimate.z(truth, channel), support::pass)
        << estimate.mean[channel] << " +- " << estimate.standard_error[channel] << ", not "
        << truth;
    EXPECT_GT(estimate.z(wrong, channel), support::reject)
        << "no teeth: " << estimate.mean[channel] << " +- " << estimate.standard_error[channel]
        << " could be " << wrong;
}

std::vector<stats::PixelSums> device_batches(const Scene& scene, std::uint32_t samples) {
    Renderer renderer(context(), scene);
    std::vector<stats::PixelSums> batches;
    for (std::uint32_t i = 0; i < kBatches; ++i) {
        const auto [first, end] = batch_range(samples, i);
        if (first == end) {
            ADD_FAILURE() << "a test needs a sample for each of " << kBatches << " batches";
            break;
        }
        EXPECT_EQ(renderer.render(first, end), end - first);
        batches.push_back(renderer.read_sums());
    }
    return batches;
}

std::vector<stats::PixelSums> reference_batches(const Scene& scene, std::uint32_t samples) {
    reference::ReferenceRenderer renderer(scene);
    std::vector<stats::PixelSums> batches;
    for (std::uint32_t i = 0; i < kBatches; ++i) {
        const auto [first, end] = batch_range(samples, i);
        batches.push_back(renderer.render(first, end - first));
    }
    return batches;
}

void expect_agreement(const std::vector<stats::PixelSums>& batches,
                      const std::vector<stats::PixelSums>& expected, int width, double teeth) {
    const stats::Agreement same = stats::test_agreement(batches, expected, width);
    EXPECT_TRUE(same.agrees) << "p = " << same.p_value << "; means " << same.mean_a[0] << ' '
                             << same.mean_a[1] << ' ' << same.mean_a[2] << ", expected "
                             << same.mean_b[0] << ' ' << same.mean_b[1] << ' ' << same.mean_b[2]
                             << "; worst block (" << same.worst_x << ", " << same.worst_y
                             << "), channel " << same.worst_channel << ", t = " << same.worst_t;
    auto brighter = batches;
    for (stats::PixelSums& batch : brighter)
        for (glm::dvec4& sum : batch)
            sum = glm::dvec4((1 + teeth) * glm::dvec3(sum), sum.w);
    EXPECT_FALSE(stats::test_agreement(brighter, expected, width).agrees)
        << "no teeth: " << 100 * teeth << " % more light went unseen";
}

void expect_agreement(const Scene& scene, std::uint32_t samples, double teeth) {
    expect_agreement(device_batches(scene, samples), reference_batches(scene, samples),
                     scene.film.bounds.width(), teeth);
}

std::vector<Rgb> colors_of(const Image& film) {
    std::vector<Rgb> colors;
    for (std::size_t i = 0; i < film.pixels.size(); i += film.channels.size())
        colors.emplace_back(film.pixels[i], film.pixels[i + 1], film.pixels[i + 2]);
    return colors;
}

std::string source_folder() {
    return TYNDALL_TEST_SOURCES;
}

void set_size(Scene& scene, int width, int height) {
    scene.film.width = width;
    scene.film.height = height;
    scene.film.bounds = {0, width, 0, height};
    fit_screen_window(scene);
}

} // namespace tyndall::device_test

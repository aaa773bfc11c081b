/// What the tests of the device renderer share: one Vulkan context for the process, with the
/// validation layer and synchronization validation on, any message of which fails the test.
///
/// The device is llvmpipe, or the one that TYNDALL_TEST_DEVICE names. A test never skips: without
/// Vulkan or the layer it fails, and says what is missing.
#pragma once

#include "gpu/context.h"
#include "render/renderer.h"
#include "stats/agreement.h"
#include "support/estimates.h"
#include "support/scenes.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace tyndall::device_test {

/// The context of this process; made by the first call.
const gpu::Context& context();
/// Ends it. Called by main, after the last test.
void close_context();

class DeviceTest : public testing::Test {
  protected:
    void SetUp() override;
    void TearDown() override; ///< Fails if the validation layer had anything to say.

  private:
    std::uint32_t messages_before_ = 0;
};

/// The film after so many samples per pixel; R G B and their variances.
Image render(const Scene& scene, std::uint32_t samples, const Tuning& tuning = {});
/// Sums of weighted radiance and of weights over samples first <= s < end, to the last bit.
std::vector<glm::dvec4> render_sums(const Scene& scene, std::uint32_t first, std::uint32_t end,
                                    const Tuning& tuning = {});

/// Mean over all pixels, with the standard error that the film's own variances give.
support::Estimate mean_of(const Image& film);
support::Estimate mean_of(const Scene& scene, std::uint32_t samples);

/// The project's one policy (support/estimates.h): the estimate is within 4.5 standard errors of
/// the truth, and 6 or more from a wrong answer.
void expect_mean(const support::Estimate& estimate, double truth, double wrong, int channel = 1);

/// Sums of equal batches of samples, as stats::test_agreement takes them.
std::vector<stats::PixelSums> device_batches(const Scene& scene, std::uint32_t samples);
std::vector<stats::PixelSums> reference_batches(const Scene& scene, std::uint32_t samples);

/// Batches with the same random numbers agree; were the first brighter by `teeth`, they would not.
void expect_agreement(const std::vector<stats::PixelSums>& batches,
                      const std::vector<stats::PixelSums>& expected, int width,
                      double teeth = 0.01);
/// The device agrees with the reference.
void expect_agreement(const Scene& scene, std::uint32_t samples, double teeth = 0.01);

/// Pixels of a film as colours, row by row.
std::vector<Rgb> colors_of(const Image& film);

/// Folder of the sources; tests read their scenes there.
std::string source_folder();

/// Sets the size of the film and fits the window of the camera to it.
void set_size(Scene& scene, int width, int height);

} // namespace tyndall::device_test

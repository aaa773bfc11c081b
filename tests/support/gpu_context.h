/// The one Vulkan context of a test program, with validation and synchronization validation on, any
/// message of which fails the test.
///
/// The device is llvmpipe, or the one that TYNDALL_TEST_DEVICE names. A test never skips: without
/// Vulkan or the layer it fails, and says what is missing. Programs end with
/// support::run_gpu_tests, which closes the context before Vulkan's layers go.
#pragma once

#include "gpu/context.h"

#include <gtest/gtest.h>

namespace tyndall::support {

/// Made by the first call.
const gpu::Context& gpu_context();

class GpuTest : public testing::Test {
  protected:
    void SetUp() override;
    void TearDown() override; ///< Fails if the validation layer had anything to say.

  private:
    std::uint32_t messages_before_ = 0;
};

/// The whole of main(). A filter that matches no test fails.
int run_gpu_tests(int argc, char** argv);

} // namespace tyndall::support

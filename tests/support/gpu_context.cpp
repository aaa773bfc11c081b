#include "support/gpu_context.h"

#include <cstdio>
#include <cstdlib>
#include <memory>

namespace tyndall::support {
namespace {

std::unique_ptr<gpu::Context>& shared_context() {
    static std::unique_ptr<gpu::Context> context;
    return context;
}

} // namespace

const gpu::Context& gpu_context() {
    if (!shared_context()) {
        const char* device = std::getenv("TYNDALL_TEST_DEVICE");
        shared_context() = std::make_unique<gpu::Context>(
            gpu::ContextOptions{.device = device ? device : "llvmpipe", .validate = true});
    }
    return *shared_context();
}

void GpuTest::SetUp() {
    messages_before_ = gpu_context().validation_messages();
}

void GpuTest::TearDown() {
    EXPECT_EQ(gpu_context().validation_messages(), messages_before_) << "validation: see above";
}

int run_gpu_tests(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    const int status = RUN_ALL_TESTS();
    shared_context().reset();
    if (testing::UnitTest::GetInstance()->test_to_run_count() > 0) return status;
    std::fprintf(stderr, "no test has such a name\n");
    return 1;
}

} // namespace tyndall::support

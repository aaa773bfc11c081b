// The control of all other tests here: a mistake does reach the validation layer, and is counted.
#include "device/device_test.h"
#include "gpu/commands.h"

#include <cstdlib>

namespace tyndall::device_test {
namespace {

class ValidationTest : public DeviceTest {};

TEST_F(ValidationTest, AMissingBarrierIsCounted) {
    const gpu::Context own({.device = context().info().name, .validate = true});
    const gpu::Buffer buffer(own, "filled twice", 256, {});
    for (bool with_barrier : {true, false}) {
        gpu::Commands commands(own);
        commands.begin();
        commands.fill_zero(buffer);
        if (with_barrier) commands.barrier();
        commands.fill_zero(buffer);
        commands.submit();
        commands.wait();
        EXPECT_EQ(own.validation_messages() > 0, !with_barrier);
    }
}

TEST_F(ValidationTest, TheDeviceIsTheOneThatWasAskedFor) {
    const char* wanted = std::getenv("TYNDALL_TEST_DEVICE");
    EXPECT_NE(context().info().name.find(wanted ? wanted : "llvmpipe"), std::string::npos)
        << context().info().name;
}

} // namespace
} // namespace tyndall::device_test

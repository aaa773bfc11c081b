/// Shaders are specialized before the driver sees them (gpu/specialize.h).

#include "core/error.h"
#include "gpu/specialize.h"
#include "spirv/medium.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace tyndall::shader_test {
namespace {

using Words = std::vector<std::uint32_t>;

/// How many instructions are of an opcode first ... last.
int count(std::span<const std::uint32_t> module, std::uint32_t first, std::uint32_t last) {
    int found = 0;
    for (std::size_t at = 5; at < module.size(); at += std::max(1u, module[at] >> 16)) {
        const std::uint32_t opcode = module[at] & 0xFFFFu;
        found += opcode >= first && opcode <= last;
    }
    return found;
}
int constants(std::span<const std::uint32_t> module) {
    return count(module, 48, 52); // OpSpecConstantTrue ... OpSpecConstantOp
}
int branches(std::span<const std::uint32_t> module) {
    return count(module, 250, 250); // OpBranchConditional
}

TEST(Specialization, LeavesNoConstantAndNoBranchThatOneDecides) {
    shared::Features grey;
    grey.is_chromatic = grey.has_emission = grey.is_grey = 0;
    const Words all = gpu::specialize(medium_spirv, {}, "medium");
    const Words few = gpu::specialize(medium_spirv, grey, "medium");
    EXPECT_GT(constants(medium_spirv), 20) << "no teeth";
    EXPECT_EQ(constants(all), 0);
    EXPECT_EQ(constants(few), 0);
    EXPECT_LT(branches(all), branches(medium_spirv));
    EXPECT_LT(branches(few), branches(all));
}

TEST(Specialization, RefusesWhatIsNoModule) {
    const Words junk(8, 0x12345678u);
    EXPECT_THROW(gpu::specialize(junk, {}, "junk"), Error);
}

} // namespace
} // namespace tyndall::shader_test

#include "gpu/specialize.h"

#include "core/error.h"

#include <algorithm>
#include <spirv-tools/optimizer.hpp>
#include <unordered_map>

namespace tyndall::gpu {
namespace {

/// Words of the constants by their ids.
std::unordered_map<std::uint32_t, std::vector<std::uint32_t>>
constants(const shared::Features& features) {
    return {
#define TYNDALL_FEATURE_VALUE(id, name, value) {id, {features.name}},
        TYNDALL_FEATURES(TYNDALL_FEATURE_VALUE)
#undef TYNDALL_FEATURE_VALUE
    };
}

} // namespace

std::vector<std::uint32_t> specialize(std::span<const std::uint32_t> spirv,
                                      const shared::Features& features, const std::string& name) {
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
    std::string message;
    optimizer.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                                     const char* text) { message = text; });
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(constants(features)))
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass()) // some are left by the first
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    std::vector<std::uint32_t> result;
    if (!optimizer.Run(spirv.data(), spirv.size(), &result, options))
        throw Error(ExitStatus::failed, "specialize stage " + name + ": " + message);
    return result;
}

std::size_t count_instructions(std::span<const std::uint32_t> spirv) {
    constexpr std::size_t header = 5;                         // words
    constexpr std::uint32_t function = 54, function_end = 56; // opcodes
    std::size_t count = 0;
    bool is_inside = false;
    for (std::size_t at = header; at < spirv.size(); at += std::max(1u, spirv[at] >> 16)) {
        const std::uint32_t opcode = spirv[at] & 0xFFFFu;
        is_inside = opcode == function || (is_inside && opcode != function_end);
        count += is_inside;
    }
    return count;
}

} // namespace tyndall::gpu

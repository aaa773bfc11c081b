#include "selftest/evaluator.h"

#include "spirv/evaluate.h"

namespace tyndall::selftest {
namespace {

constexpr gpu::Buffer::Options kTexels{.texels = true};
constexpr std::uint64_t kTexelBytes = 16;

} // namespace

Evaluator::Evaluator(const gpu::Context& context)
    : context_(&context), arguments_(context, "arguments", most * kTexelBytes, kTexels),
      values_(context, "values", most * kTexelBytes, kTexels),
      unused_paths_(context, "paths", kTexelBytes, kTexels),
      unused_pieces_(context, "pieces", kTexelBytes, kTexels),
      unused_voxels_(context, "voxels", kTexelBytes, kTexels),
      control_(context, "control", sizeof(shared::Control), {}),
      queues_(context, "queues", kTexelBytes, {}),
      descriptors_(context,
                   {{&arguments_, &unused_paths_, &unused_pieces_, &values_, &unused_voxels_},
                    &control_,
                    &queues_},
                   sizeof(shared::PushConstants)),
      stage_(context, descriptors_, "evaluate", evaluate_spirv, {}) {}

std::vector<glm::vec4> Evaluator::evaluate(std::uint32_t function,
                                           const std::vector<glm::vec4>& arguments) {
    gpu::upload(*context_, arguments_, std::as_bytes(std::span(arguments)));
    const auto count = static_cast<std::uint32_t>(arguments.size());
    const shared::PushConstants push{.slot_count = count, .shapes = function};
    gpu::Commands commands(*context_);
    commands.begin();
    commands.bind(descriptors_, std::as_bytes(std::span(&push, 1)));
    commands.dispatch(stage_, count);
    commands.barrier();
    commands.submit();
    commands.wait();
    std::vector<glm::vec4> values(arguments.size());
    gpu::download(*context_, values_, 0, std::as_writable_bytes(std::span(values)));
    return values;
}

} // namespace tyndall::selftest

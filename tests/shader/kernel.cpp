#include "shader/kernel.h"

#include <bit>

namespace tyndall::shader_test {
namespace {

constexpr gpu::Buffer::Options kTexels{.texels = true};

shared::Features with_fallback(shared::Features features, const gpu::Descriptors& descriptors) {
    features.storage_fallback = descriptors.storage_fallback();
    return features;
}

} // namespace

Kernel::Kernel(const char* name, std::span<const std::uint32_t> spirv, std::uint32_t input_texels,
               std::uint32_t output_texels, const shared::Features& features)
    : input_(support::gpu_context(), "input", std::uint64_t{input_texels} * 16, kTexels),
      output_(support::gpu_context(), "output", std::uint64_t{output_texels} * 16, kTexels),
      unused_paths_(support::gpu_context(), "paths", 16, kTexels),
      unused_pieces_(support::gpu_context(), "pieces", 16, kTexels),
      unused_voxels_(support::gpu_context(), "voxels", 16, kTexels),
      control_(support::gpu_context(), "control", sizeof(shared::Control), {}),
      queues_(support::gpu_context(), "queues", 16, {}),
      descriptors_(support::gpu_context(),
                   {{&input_, &unused_paths_, &unused_pieces_, &output_, &unused_voxels_},
                    &control_,
                    &queues_,
                    &queues_}, // the log is not used
                   sizeof(shared::PushConstants)),
      stage_(support::gpu_context(), descriptors_, name, spirv,
             with_fallback(features, descriptors_)) {}

void Kernel::run_bytes(const Task& task, std::span<const std::byte> input, std::uint32_t count,
                       std::span<std::byte> output) {
    const gpu::Context& context = support::gpu_context();
    ASSERT_LE(input.size(), input_.bytes());
    ASSERT_LE(output.size(), output_.bytes());
    if (!input.empty()) gpu::upload(context, input_, input);
    push.slot_count = count;
    push.first_sample = task.first;
    push.first_piece = task.function;
    push.piece_count = task.variant;
    push.full_width = std::bit_cast<std::uint32_t>(task.number);
    gpu::Commands commands(context);
    commands.begin();
    commands.bind(descriptors_, std::as_bytes(std::span(&push, 1)));
    commands.dispatch(stage_, count);
    commands.barrier();
    commands.submit();
    commands.wait();
    gpu::download(context, output_, 0, output);
}

shared::Control Kernel::read_control() const {
    shared::Control control;
    gpu::download(support::gpu_context(), control_, 0,
                  std::as_writable_bytes(std::span(&control, 1)));
    return control;
}

} // namespace tyndall::shader_test

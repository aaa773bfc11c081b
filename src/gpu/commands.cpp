#include "gpu/commands.h"

#include "core/error.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace tyndall::gpu {
namespace {

constexpr std::uint64_t kStagingBytes = 16u << 20;

} // namespace

Timestamps::Timestamps(const Context& context, std::uint32_t count)
    : context_(&context), count_(count) {
    const VkQueryPoolCreateInfo create{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                       .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                       .queryCount = count};
    VkQueryPool pool = VK_NULL_HANDLE;
    check(vkCreateQueryPool(context.device(), &create, nullptr, &pool), "create timestamps");
    pool_ = {context.device(), pool};
}

std::vector<double> Timestamps::intervals() const {
    std::vector<double> seconds(count_ - 1, 0.0);
    if (context_->timestamp_period() == 0) return seconds;
    std::vector<std::uint64_t> ticks(count_);
    const VkResult result =
        vkGetQueryPoolResults(context_->device(), pool_.get(), 0, count_, count_ * sizeof(ticks[0]),
                              ticks.data(), sizeof(ticks[0]), VK_QUERY_RESULT_64_BIT);
    if (result != VK_SUCCESS) return seconds; // not all were written
    for (std::uint32_t i = 0; i + 1 < count_; ++i)
        seconds[i] = static_cast<double>((ticks[i + 1] - ticks[i]) & context_->timestamp_mask()) *
                     context_->timestamp_period() * 1e-9;
    return seconds;
}

Commands::Commands(const Context& context) : context_(&context) {
    const VkDevice device = context.device();
    const VkCommandPoolCreateInfo create_pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                              .flags =
                                                  VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                              .queueFamilyIndex = context.queue_family()};
    VkCommandPool pool = VK_NULL_HANDLE;
    check(vkCreateCommandPool(device, &create_pool, nullptr, &pool), "create a command pool");
    pool_ = {device, pool};
    const VkCommandBufferAllocateInfo allocate{.sType =
                                                   VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                               .commandPool = pool,
                                               .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                               .commandBufferCount = 1};
    check(vkAllocateCommandBuffers(device, &allocate, &commands_), "allocate a command buffer");
    const VkFenceCreateInfo create_fence{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkFence fence = VK_NULL_HANDLE;
    check(vkCreateFence(device, &create_fence, nullptr, &fence), "create a fence");
    fence_ = {device, fence};
}

void Commands::begin() {
    TYNDALL_ASSERT(!submitted_);
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    check(vkBeginCommandBuffer(commands_, &begin), "begin a command buffer");
}

void Commands::bind(const Descriptors& descriptors, std::span<const std::byte> push) {
    TYNDALL_ASSERT(push.size() == descriptors.push_bytes());
    const VkDescriptorSet set = descriptors.set();
    vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, descriptors.layout(), 0, 1,
                            &set, 0, nullptr);
    vkCmdPushConstants(commands_, descriptors.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       static_cast<std::uint32_t>(push.size()), push.data());
}

void Commands::dispatch(const Stage& stage, std::uint32_t invocations) {
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, stage.pipeline());
    const std::uint32_t size = stage.workgroup_size();
    vkCmdDispatch(commands_, (invocations + size - 1) / size, 1, 1);
}

void Commands::dispatch_indirect(const Stage& stage, const Buffer& arguments,
                                 std::uint64_t offset) {
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, stage.pipeline());
    vkCmdDispatchIndirect(commands_, arguments.get(), offset);
}

void Commands::barrier() {
    const VkMemoryBarrier everything{
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
        .srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT,
        .dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT |
                         VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT |
                         VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_HOST_READ_BIT};
    constexpr VkPipelineStageFlags from =
        VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    constexpr VkPipelineStageFlags to =
        from | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_HOST_BIT;
    vkCmdPipelineBarrier(commands_, from, to, 0, 1, &everything, 0, nullptr, 0, nullptr);
}

void Commands::copy(const Buffer& from, std::uint64_t from_offset, const Buffer& to,
                    std::uint64_t to_offset, std::uint64_t bytes) {
    const VkBufferCopy region{from_offset, to_offset, bytes};
    vkCmdCopyBuffer(commands_, from.get(), to.get(), 1, &region);
}

void Commands::fill_zero(const Buffer& buffer) {
    vkCmdFillBuffer(commands_, buffer.get(), 0, VK_WHOLE_SIZE, 0);
}

void Commands::write(const Buffer& to, std::uint64_t offset, std::uint32_t value) {
    vkCmdUpdateBuffer(commands_, to.get(), offset, sizeof(value), &value);
}

void Commands::reset(const Timestamps& timestamps) {
    if (context_->timestamp_period() > 0)
        vkCmdResetQueryPool(commands_, timestamps.pool(), 0, timestamps.count());
}

void Commands::mark(const Timestamps& timestamps, std::uint32_t index) {
    if (context_->timestamp_period() > 0)
        vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, timestamps.pool(),
                            index);
}

void Commands::submit() {
    check(vkEndCommandBuffer(commands_), "record a command buffer");
    const VkSubmitInfo submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                              .commandBufferCount = 1,
                              .pCommandBuffers = &commands_};
    check(vkQueueSubmit(context_->queue(), 1, &submit, fence_.get()), "submit work to the device");
    submitted_ = true;
}

void Commands::wait() {
    if (!submitted_) return;
    submitted_ = false;
    const VkFence fence = fence_.get();
    constexpr std::uint64_t forever = std::numeric_limits<std::uint64_t>::max();
    check(vkWaitForFences(context_->device(), 1, &fence, VK_TRUE, forever), "wait for the device");
    check(vkResetFences(context_->device(), 1, &fence), "reset a fence");
}

void upload(const Context& context, const Buffer& to, std::span<const std::byte> data) {
    if (data.empty()) return;
    const std::uint64_t chunk = std::min<std::uint64_t>(data.size(), kStagingBytes);
    const Buffer staging(context, "staging", chunk, {.host_visible = true});
    Commands commands(context);
    for (std::uint64_t at = 0; at < data.size(); at += chunk) {
        const std::uint64_t bytes = std::min<std::uint64_t>(chunk, data.size() - at);
        std::memcpy(staging.mapped(), data.data() + at, bytes);
        commands.begin();
        commands.copy(staging, 0, to, at, bytes);
        commands.barrier();
        commands.submit();
        commands.wait();
    }
}

void download(const Context& context, const Buffer& from, std::uint64_t offset,
              std::span<std::byte> data) {
    if (data.empty()) return;
    const std::uint64_t chunk = std::min<std::uint64_t>(data.size(), kStagingBytes);
    const Buffer staging(context, "staging", chunk, {.host_visible = true});
    Commands commands(context);
    for (std::uint64_t at = 0; at < data.size(); at += chunk) {
        const std::uint64_t bytes = std::min<std::uint64_t>(chunk, data.size() - at);
        commands.begin();
        commands.barrier();
        commands.copy(from, offset + at, staging, 0, bytes);
        commands.barrier();
        commands.submit();
        commands.wait();
        std::memcpy(data.data() + at, staging.mapped(), bytes);
    }
}

} // namespace tyndall::gpu

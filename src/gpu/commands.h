/// Recording and submitting work.
#pragma once

#include "gpu/stage.h"

#include <cstddef>
#include <span>
#include <vector>

namespace tyndall::gpu {

/// Device times at points of a command buffer.
class Timestamps {
  public:
    Timestamps(const Context& context, std::uint32_t count);
    /// Seconds between consecutive points, count - 1 of them; all 0 where the device has no clock.
    /// The submission that wrote them must have ended.
    std::vector<double> intervals() const;
    VkQueryPool pool() const { return pool_.get(); }
    std::uint32_t count() const { return count_; }

  private:
    const Context* context_;
    std::uint32_t count_;
    Handle<VkQueryPool, &vkDestroyQueryPool> pool_;
};

/// One command buffer with its fence: begin, record, submit, wait; then again.
class Commands {
  public:
    explicit Commands(const Context& context);

    /// Starts recording. The previous submission must have been waited for.
    void begin();
    /// Binds descriptors and push constants for the dispatches that follow.
    void bind(const Descriptors& descriptors, std::span<const std::byte> push);
    /// Runs enough workgroups for `invocations`.
    void dispatch(const Stage& stage, std::uint32_t invocations);
    /// Runs the workgroups that the device wrote at `offset` of `arguments`.
    void dispatch_indirect(const Stage& stage, const Buffer& arguments, std::uint64_t offset);
    /// Makes everything written so far visible to everything after: shaders, indirect arguments,
    /// transfers, and the host.
    void barrier();
    void copy(const Buffer& from, std::uint64_t from_offset, const Buffer& to,
              std::uint64_t to_offset, std::uint64_t bytes);
    void fill_zero(const Buffer& buffer);
    /// Writes a word. A barrier must follow before it is read.
    void write(const Buffer& to, std::uint64_t offset, std::uint32_t value);
    /// Before the first mark of a recording.
    void reset(const Timestamps& timestamps);
    /// Notes the time at which everything recorded so far is done.
    void mark(const Timestamps& timestamps, std::uint32_t index);
    void submit();
    /// Waits for the submission to end. Does nothing if there is none.
    void wait();

  private:
    const Context* context_;
    Handle<VkCommandPool, &vkDestroyCommandPool> pool_;
    Handle<VkFence, &vkDestroyFence> fence_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE; // owned by pool_
    bool submitted_ = false;
};

/// Copies host data into a buffer, through a staging buffer of bounded size.
void upload(const Context& context, const Buffer& to, std::span<const std::byte> data);
/// Copies a part of a buffer to the host, likewise.
void download(const Context& context, const Buffer& from, std::uint64_t offset,
              std::span<std::byte> data);

} // namespace tyndall::gpu

/// Device buffers, and the ways data gets in and out of them.
#pragma once

#include "gpu/context.h"

#include <cstddef>
#include <span>

namespace tyndall::gpu {

/// A buffer in device memory. Every buffer can be a storage buffer and a transfer source and
/// target. With `texels` it can also be seen as a texel buffer, as far as the device's
/// maxTexelBufferElements allows.
class Buffer {
  public:
    struct Options {
        bool texels = false; ///< May be bound as texel buffer of texel_format.
        VkFormat texel_format =
            VK_FORMAT_R32G32B32A32_UINT; ///< Or rgba16f, rgba32f: those only to be read.
        bool indirect = false;           ///< May hold indirect dispatch arguments.
        bool host_visible = false;       ///< Mapped for the life of the buffer; see mapped().
    };
    Buffer() = default;
    /// Throws Error, naming the buffer and its size, if memory or a limit does not allow it.
    Buffer(const Context& context, std::string name, std::uint64_t bytes, const Options& options);

    VkBuffer get() const { return buffer_.get(); }
    std::uint64_t bytes() const { return bytes_; }
    /// Host pointer of a host_visible (and coherent) buffer.
    std::byte* mapped() const { return mapped_; }
    /// View of as many texels as the device allows; VK_NULL_HANDLE without `texels`.
    VkBufferView view() const { return view_.get(); }
    /// Whether the view is of less than the whole buffer.
    bool exceeds_view() const { return exceeds_view_; }

  private:
    std::uint64_t bytes_ = 0;
    Handle<VkDeviceMemory, &vkFreeMemory> memory_; // outlives buffer_ and view_
    Handle<VkBuffer, &vkDestroyBuffer> buffer_;
    Handle<VkBufferView, &vkDestroyBufferView> view_;
    std::byte* mapped_ = nullptr;
    bool exceeds_view_ = false;
};

/// "1.5 GiB"
std::string format_bytes(std::uint64_t bytes);

} // namespace tyndall::gpu

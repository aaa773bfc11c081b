#include "gpu/buffer.h"

#include "core/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace tyndall::gpu {
namespace {

constexpr std::uint64_t kLeastBytes = 16;

std::uint64_t texel_bytes(VkFormat format) {
    return format == VK_FORMAT_R16G16B16A16_SFLOAT ? 8 : 16;
}

VkBufferUsageFlags usage(const Buffer::Options& options) {
    VkBufferUsageFlags flags = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                               VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (options.texels) flags |= VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    if (options.texels && options.texel_format == VK_FORMAT_R32G32B32A32_UINT)
        flags |= VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
    if (options.indirect) flags |= VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    return flags;
}

VkMemoryPropertyFlags memory_properties(const Buffer::Options& options) {
    if (options.host_visible)
        return VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    return VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
}

} // namespace

std::string format_bytes(std::uint64_t bytes) {
    if (bytes < 1024) return fmt::format("{} B", bytes);
    double value = static_cast<double>(bytes) / 1024;
    const char* unit = "KiB";
    for (const char* next : {"MiB", "GiB", "TiB"}) {
        if (value < 1024) break;
        value /= 1024;
        unit = next;
    }
    return fmt::format("{:.1f} {}", value, unit);
}

Buffer::Buffer(const Context& context, std::string name, std::uint64_t bytes,
               const Options& options)
    : bytes_(std::max(bytes, kLeastBytes)) {
    const std::string attempt =
        fmt::format("create buffer \"{}\" ({})", name, format_bytes(bytes_));
    const VkDevice device = context.device();
    const VkBufferCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes_, .usage = usage(options)};
    VkBuffer buffer = VK_NULL_HANDLE;
    check(vkCreateBuffer(device, &create, nullptr, &buffer), attempt);
    buffer_ = {device, buffer};
    context.name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(buffer), name);

    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device, buffer, &needs);
    const VkMemoryAllocateInfo allocate{
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
        .allocationSize = needs.size,
        .memoryTypeIndex = context.memory_type(needs.memoryTypeBits, memory_properties(options))};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(device, &allocate, nullptr, &memory), attempt);
    memory_ = {device, memory};
    check(vkBindBufferMemory(device, buffer, memory, 0), attempt);

    if (options.host_visible) {
        void* mapped = nullptr;
        check(vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &mapped), attempt);
        mapped_ = static_cast<std::byte*>(mapped);
    }
    if (options.texels) {
        const std::uint64_t texel = texel_bytes(options.texel_format);
        const std::uint64_t limit = context.limits().maxTexelBufferElements * texel;
        exceeds_view_ = bytes_ > limit;
        const VkBufferViewCreateInfo view{.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                          .buffer = buffer,
                                          .format = options.texel_format,
                                          .range = std::min(bytes_ / texel * texel, limit)};
        VkBufferView handle = VK_NULL_HANDLE;
        check(vkCreateBufferView(device, &view, nullptr, &handle), attempt);
        view_ = {device, handle};
    }
}

} // namespace tyndall::gpu

/// Move-only owner of one Vulkan object, and the check that every Vulkan call goes through.
#pragma once

#include <string>
#include <utility>
#include <volk.h>

namespace tyndall::gpu {

/// Throws Error with what was attempted and why it failed ("cannot create buffer 'paths' (1.2 MiB):
/// out of device memory"). A device or driver that is missing maps to ExitStatus::no_device, every
/// other failure to ExitStatus::failed.
void check(VkResult result, const std::string& attempt);

/// Owns a device object. Destroy is the address of volk's function pointer, e.g. &vkDestroyBuffer.
template<typename T, auto* Destroy>
class Handle {
  public:
    Handle() = default;
    Handle(VkDevice device, T object) : device_(device), object_(object) {}
    Handle(Handle&& other) noexcept
        : device_(other.device_), object_(std::exchange(other.object_, VK_NULL_HANDLE)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(object_, other.object_);
        return *this;
    }
    ~Handle() {
        if (object_ != VK_NULL_HANDLE) (*Destroy)(device_, object_, nullptr);
    }
    T get() const { return object_; }

  private:
    VkDevice device_ = VK_NULL_HANDLE;
    T object_ = VK_NULL_HANDLE;
};

} // namespace tyndall::gpu

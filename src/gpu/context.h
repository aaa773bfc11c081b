/// The Vulkan instance, one device and its compute queue.
#pragma once

#include "gpu/handle.h"
#include "gpu/pipeline_cache.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tyndall::gpu {

/// One device as `tyndall devices` lists it.
struct DeviceInfo {
    std::string name;
    std::string driver; ///< Name and version as the driver states them.
    std::string type;   ///< "cpu", "integrated", "discrete", "virtual" or "other".
    std::string api_version;
    std::string missing; ///< What it lacks for Tyndall; empty if it can be used.
    std::uint32_t max_texel_buffer_elements = 0;
    std::uint64_t max_storage_buffer_bytes = 0;
    std::uint64_t memory_bytes = 0; ///< Largest device-local heap.
};

/// Every Vulkan device of this machine, in the loader's order. Empty if there is no Vulkan at all.
std::vector<DeviceInfo> list_devices();

struct ContextOptions {
    /// Index into list_devices(), or a part of a device's name (any case). Empty: the first usable
    /// device, discrete before integrated before virtual before CPU.
    std::string device;
    /// Turns on the validation layer with synchronization validation; its messages are counted and
    /// printed to stderr. Throws if the layer is not installed.
    bool validate = false;
    /// Where compiled pipelines are kept between runs (pipeline_cache.h); empty: nowhere.
    std::filesystem::path cache_folder;
};

/// Owns instance and device. Not copied, not moved: everything else points to it.
class Context {
  public:
    /// Throws Error: no_device where no usable device is found (and says what to install).
    explicit Context(const ContextOptions& options);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    VkDevice device() const { return device_; }
    VkQueue queue() const { return queue_; }
    std::uint32_t queue_family() const { return queue_family_; }
    const PipelineCache& pipelines() const { return pipelines_; }
    const DeviceInfo& info() const { return info_; }
    const VkPhysicalDeviceLimits& limits() const { return limits_; }
    /// Nanoseconds per timestamp tick; 0 where the queue has no timestamps.
    double timestamp_period() const { return timestamp_period_; }
    /// Bits that a timestamp has; it wraps.
    std::uint64_t timestamp_mask() const { return timestamp_mask_; }
    /// Messages of the validation layer so far (warnings and errors).
    std::uint32_t validation_messages() const { return validation_messages_; }

    /// Index of a memory type with the wanted properties among the allowed ones.
    std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags wanted) const;
    /// Names an object for validation messages and captures; does nothing without validation.
    void name(VkObjectType type, std::uint64_t handle, const std::string& name) const;

  private:
    void create_instance(bool validate);
    void destroy();
    void create_device(const ContextOptions& options);

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::uint32_t queue_family_ = 0;
    PipelineCache pipelines_;
    DeviceInfo info_;
    VkPhysicalDeviceLimits limits_{};
    double timestamp_period_ = 0;
    std::uint64_t timestamp_mask_ = 0;
    VkPhysicalDeviceMemoryProperties memory_{};
    std::atomic<std::uint32_t> validation_messages_ = 0;
};

} // namespace tyndall::gpu

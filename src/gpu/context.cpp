#include "gpu/context.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <fmt/format.h>
#include <mutex>
#include <string_view>

namespace tyndall::gpu {
namespace {

constexpr std::uint32_t kApiVersion = VK_API_VERSION_1_2;
/// Bindings of the renderer (shaders/shared/bindings.h): texels with their storage twins, control,
/// queues, log.
constexpr std::uint32_t kStorageBuffers = 8;
constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kInstallHint =
    "install a Vulkan driver, e.g. the package mesa-vulkan-drivers (lavapipe runs on any CPU)";

const char* result_text(VkResult result) {
    switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return "out of host memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return "out of device memory";
    case VK_ERROR_INITIALIZATION_FAILED:
        return "initialization failed";
    case VK_ERROR_DEVICE_LOST:
        return "the device was lost";
    case VK_ERROR_MEMORY_MAP_FAILED:
        return "memory could not be mapped";
    case VK_ERROR_LAYER_NOT_PRESENT:
        return "a layer is not installed";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
        return "an extension is not present";
    case VK_ERROR_FEATURE_NOT_PRESENT:
        return "a feature is not present";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
        return "the driver is incompatible";
    case VK_ERROR_TOO_MANY_OBJECTS:
        return "too many objects";
    case VK_TIMEOUT:
        return "timed out";
    default:
        return "Vulkan error";
    }
}

std::string version_text(std::uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

const char* type_text(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return "cpu";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return "virtual";
    default:
        return "other";
    }
}

/// Order of preference when no device was asked for.
int type_rank(const std::string& type) {
    constexpr std::array<std::string_view, 5> order{"discrete", "integrated", "virtual", "cpu",
                                                    "other"};
    return static_cast<int>(std::find(order.begin(), order.end(), type) - order.begin());
}

std::vector<VkPhysicalDevice> physical_devices(VkInstance instance) {
    std::uint32_t count = 0;
    if (vkEnumeratePhysicalDevices(instance, &count, nullptr) != VK_SUCCESS) return {};
    std::vector<VkPhysicalDevice> devices(count);
    if (vkEnumeratePhysicalDevices(instance, &count, devices.data()) < VK_SUCCESS) return {};
    devices.resize(count);
    return devices;
}

std::optional<std::uint32_t> compute_family(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (std::uint32_t i = 0; i < count; ++i)
        if (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) return i;
    return std::nullopt;
}

DeviceInfo describe(VkPhysicalDevice device) {
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    VkPhysicalDeviceProperties basic;
    vkGetPhysicalDeviceProperties(device, &basic);
    if (basic.apiVersion >= kApiVersion) {
        properties.pNext = &driver;
        vkGetPhysicalDeviceProperties2(device, &properties);
    }
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(device, &memory);

    DeviceInfo info;
    info.name = basic.deviceName;
    info.driver = *driver.driverName ? fmt::format("{} {}", driver.driverName, driver.driverInfo)
                                     : version_text(basic.driverVersion);
    info.type = type_text(basic.deviceType);
    info.api_version = version_text(basic.apiVersion);
    info.max_texel_buffer_elements = basic.limits.maxTexelBufferElements;
    info.max_storage_buffer_bytes = basic.limits.maxStorageBufferRange;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
            info.memory_bytes =
                std::max<std::uint64_t>(info.memory_bytes, memory.memoryHeaps[i].size);
    if (basic.apiVersion < kApiVersion)
        info.missing = fmt::format("Vulkan 1.2 (it has {})", info.api_version);
    else if (!compute_family(device))
        info.missing = "a compute queue";
    else if (basic.limits.maxPerStageDescriptorStorageBuffers < kStorageBuffers)
        info.missing = fmt::format("{} storage buffers a stage (it has {})", kStorageBuffers,
                                   basic.limits.maxPerStageDescriptorStorageBuffers);
    return info;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool is_number(const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(),
                                        [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// The index of the device that `selector` names.
std::size_t choose(const std::vector<DeviceInfo>& devices, const std::string& selector) {
    std::string names;
    for (std::size_t i = 0; i < devices.size(); ++i)
        names +=
            fmt::format("\n  {}: {}{}", i, devices[i].name,
                        devices[i].missing.empty() ? "" : " (lacks " + devices[i].missing + ")");
    if (devices.empty())
        throw Error(ExitStatus::no_device, fmt::format("no Vulkan device: {}", kInstallHint));

    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const bool asked = is_number(selector)
                               ? std::to_string(i) == selector
                               : lower(devices[i].name).find(lower(selector)) != std::string::npos;
        const bool usable = devices[i].missing.empty();
        if (!asked || !usable) continue;
        if (!best || type_rank(devices[i].type) < type_rank(devices[*best].type)) best = i;
    }
    if (!best)
        throw Error(ExitStatus::no_device,
                    selector.empty()
                        ? fmt::format("no usable Vulkan device: {}; found:{}", kInstallHint, names)
                        : fmt::format("no usable Vulkan device \"{}\"; found:{}", selector, names));
    return *best;
}

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data,
                                          void* user) {
    std::fprintf(stderr, "validation: %s\n", data->pMessage);
    ++*static_cast<std::atomic<std::uint32_t>*>(user);
    return VK_FALSE;
}

/// Loads the Vulkan loader once a process; false if there is none.
bool load_vulkan() {
    static std::once_flag once;
    static VkResult result;
    std::call_once(once, [] { result = volkInitialize(); });
    return result == VK_SUCCESS;
}

VkInstance create_plain_instance() {
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pApplicationName = "tyndall",
                                        .apiVersion = kApiVersion};
    const VkInstanceCreateInfo create{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                      .pApplicationInfo = &application};
    VkInstance instance = VK_NULL_HANDLE;
    if (vkCreateInstance(&create, nullptr, &instance) != VK_SUCCESS) return VK_NULL_HANDLE;
    return instance;
}

} // namespace

void check(VkResult result, const std::string& attempt) {
    if (result >= VK_SUCCESS) return;
    throw Error(ExitStatus::failed, fmt::format("cannot {}: {} ({})", attempt, result_text(result),
                                                static_cast<int>(result)));
}

std::vector<DeviceInfo> list_devices() {
    if (!load_vulkan()) return {};
    const VkInstance instance = create_plain_instance();
    if (!instance) return {};
    volkLoadInstanceOnly(instance);
    std::vector<DeviceInfo> infos;
    for (VkPhysicalDevice device : physical_devices(instance))
        infos.push_back(describe(device));
    vkDestroyInstance(instance, nullptr);
    return infos;
}

Context::Context(const ContextOptions& options) {
    if (!load_vulkan())
        throw Error(ExitStatus::no_device,
                    fmt::format("no Vulkan loader (libvulkan.so.1): {}", kInstallHint));
    try {
        create_instance(options.validate);
        create_device(options);
    } catch (...) {
        destroy();
        throw;
    }
}

Context::~Context() {
    destroy();
}

void Context::destroy() {
    if (device_) {
        vkDeviceWaitIdle(device_);
        pipelines_.save();
        pipelines_ = {};
        vkDestroyDevice(device_, nullptr);
    }
    if (messenger_) vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
    if (instance_) vkDestroyInstance(instance_, nullptr);
}

void Context::create_instance(bool validate) {
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pApplicationName = "tyndall",
                                        .apiVersion = kApiVersion};
    const VkDebugUtilsMessengerCreateInfoEXT messenger{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
        .pfnUserCallback = on_message,
        .pUserData = &validation_messages_};
    const VkValidationFeatureEnableEXT enabled =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                           .pNext = &messenger,
                                           .enabledValidationFeatureCount = 1,
                                           .pEnabledValidationFeatures = &enabled};
    const std::array<const char*, 2> extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME,
                                                VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    VkInstanceCreateInfo create{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                .pApplicationInfo = &application};
    if (validate) {
        create.pNext = &features;
        create.enabledLayerCount = 1;
        create.ppEnabledLayerNames = &kValidationLayer;
        create.enabledExtensionCount = extensions.size();
        create.ppEnabledExtensionNames = extensions.data();
    }
    const VkResult result = vkCreateInstance(&create, nullptr, &instance_);
    if (validate &&
        (result == VK_ERROR_LAYER_NOT_PRESENT || result == VK_ERROR_EXTENSION_NOT_PRESENT))
        throw Error(ExitStatus::failed, "cannot validate: the Vulkan validation layer is not "
                                        "installed (package vulkan-validationlayers)");
    if (result != VK_SUCCESS)
        throw Error(ExitStatus::no_device, fmt::format("cannot create a Vulkan instance: {}; {}",
                                                       result_text(result), kInstallHint));
    volkLoadInstanceOnly(instance_);
    if (validate)
        check(vkCreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_),
              "listen to the validation layer");
}

void Context::create_device(const ContextOptions& options) {
    const std::vector<VkPhysicalDevice> devices = physical_devices(instance_);
    std::vector<DeviceInfo> infos;
    for (VkPhysicalDevice device : devices)
        infos.push_back(describe(device));
    const std::size_t index = choose(infos, options.device);
    physical_device_ = devices[index];
    info_ = infos[index];
    queue_family_ = compute_family(physical_device_).value();

    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical_device_, &properties);
    limits_ = properties.limits;
    vkGetPhysicalDeviceMemoryProperties(physical_device_, &memory_);
    std::uint32_t family_count = queue_family_ + 1;
    std::vector<VkQueueFamilyProperties> families(family_count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical_device_, &family_count, families.data());
    if (const std::uint32_t bits = families[queue_family_].timestampValidBits; bits > 0) {
        timestamp_period_ = static_cast<double>(limits_.timestampPeriod);
        timestamp_mask_ = ~std::uint64_t{0} >> (64 - bits);
    }

    const float priority = 1;
    const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                        .queueFamilyIndex = queue_family_,
                                        .queueCount = 1,
                                        .pQueuePriorities = &priority};
    const VkDeviceCreateInfo create{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                    .queueCreateInfoCount = 1,
                                    .pQueueCreateInfos = &queue};
    check(vkCreateDevice(physical_device_, &create, nullptr, &device_),
          "create a Vulkan device on " + info_.name);
    volkLoadDevice(device_);
    vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
    pipelines_ = {device_, properties, options.cache_folder};
}

std::uint32_t Context::memory_type(std::uint32_t allowed, VkMemoryPropertyFlags wanted) const {
    for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i)
        if ((allowed >> i & 1u) && (memory_.memoryTypes[i].propertyFlags & wanted) == wanted)
            return i;
    throw Error(ExitStatus::failed, "the device has no memory of the kind that is needed");
}

void Context::name(VkObjectType type, std::uint64_t handle, const std::string& name) const {
    if (!messenger_) return;
    const VkDebugUtilsObjectNameInfoEXT info{.sType =
                                                 VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                             .objectType = type,
                                             .objectHandle = handle,
                                             .pObjectName = name.c_str()};
    vkSetDebugUtilsObjectNameEXT(device_, &info);
}

} // namespace tyndall::gpu

/// Compiled pipelines of earlier runs, on disk.
#pragma once

#include "gpu/handle.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace tyndall::gpu {

/// A VkPipelineCache that begins with what the last run left for this device and driver, and
/// leaves what it has in the end. A file that is missing, damaged or of another driver counts as
/// empty and is replaced; one that cannot be written is not.
///
/// What is in it is the driver's choice: lavapipe (Mesa 22.3) puts nothing there but its header,
/// and keeps compiled code in a cache of its own; then no file is written.
class PipelineCache {
  public:
    PipelineCache() = default;
    /// @param folder  made if it is missing; empty: nothing is read or written.
    PipelineCache(VkDevice device, const VkPhysicalDeviceProperties& properties,
                  const std::filesystem::path& folder);

    VkPipelineCache get() const { return cache_.get(); }
    /// Bytes that the last run left.
    std::size_t loaded_bytes() const { return loaded_bytes_; }
    /// Writes the file, if there is more than there was.
    void save() const;

  private:
    VkDevice device_ = VK_NULL_HANDLE;
    std::filesystem::path file_;
    std::size_t loaded_bytes_ = 0;
    Handle<VkPipelineCache, &vkDestroyPipelineCache> cache_;
};

/// The two halves of that, by file. What is loaded is empty unless the file is whole and of a
/// device, driver and driver's build as the properties tell.
/// @throws Error if the file cannot be written.
std::vector<char> load_pipelines(const std::filesystem::path& file,
                                 const VkPhysicalDeviceProperties& properties);
void store_pipelines(const std::filesystem::path& file, const std::vector<char>& data);

/// Where caches of programs belong: XDG_CACHE_HOME/tyndall, else HOME/.cache/tyndall; empty without
/// either.
std::filesystem::path default_cache_folder();

} // namespace tyndall::gpu

#include "gpu/pipeline_cache.h"

#include "core/atomic_file.h"
#include "core/error.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace tyndall::gpu {
namespace {

constexpr std::uint64_t kMagic = 0x31435059544E5954u; // changes with the layout of the file

/// What a file begins with; the driver's data follow.
struct FileHeader {
    std::uint64_t magic, bytes, checksum;
};

/// FNV-1a. Drivers need not notice damage, and some crash.
std::uint64_t checksum(const std::vector<char>& bytes) {
    std::uint64_t hash = 0xCBF29CE484222325u;
    for (const char byte : bytes)
        hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3u;
    return hash;
}

/// One file for each device and driver: both are in its name.
std::filesystem::path file_of(const VkPhysicalDeviceProperties& properties,
                              const std::filesystem::path& folder) {
    std::string uuid;
    for (const std::uint8_t byte : properties.pipelineCacheUUID)
        uuid += fmt::format("{:02x}", byte);
    return folder / fmt::format("pipelines-{:08x}-{:08x}-{:08x}-{}.bin", properties.vendorID,
                                properties.deviceID, properties.driverVersion, uuid);
}

bool is_of_device(const std::vector<char>& data, const VkPhysicalDeviceProperties& properties) {
    VkPipelineCacheHeaderVersionOne header;
    if (data.size() < sizeof(header)) return false;
    std::memcpy(&header, data.data(), sizeof(header));
    return header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
           header.vendorID == properties.vendorID && header.deviceID == properties.deviceID &&
           std::memcmp(header.pipelineCacheUUID, properties.pipelineCacheUUID, VK_UUID_SIZE) == 0;
}

} // namespace

PipelineCache::PipelineCache(VkDevice device, const VkPhysicalDeviceProperties& properties,
                             const std::filesystem::path& folder)
    : device_(device) {
    std::vector<char> data;
    if (!folder.empty()) {
        file_ = file_of(properties, folder);
        data = load_pipelines(file_, properties);
    }
    loaded_bytes_ = data.size();
    const VkPipelineCacheCreateInfo create{.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                                           .initialDataSize = data.size(),
                                           .pInitialData = data.data()};
    VkPipelineCache cache = VK_NULL_HANDLE;
    check(vkCreatePipelineCache(device, &create, nullptr, &cache), "create the pipeline cache");
    cache_ = {device, cache};
}

void PipelineCache::save() const {
    if (file_.empty()) return;
    std::size_t size = 0;
    if (vkGetPipelineCacheData(device_, get(), &size, nullptr) != VK_SUCCESS) return;
    if (size <= std::max(loaded_bytes_, sizeof(VkPipelineCacheHeaderVersionOne))) return;
    std::vector<char> data(size);
    if (vkGetPipelineCacheData(device_, get(), &size, data.data()) != VK_SUCCESS) return;
    data.resize(size);
    try {
        std::filesystem::create_directories(file_.parent_path());
        store_pipelines(file_, data);
    } catch (const std::exception&) {
        // A home that cannot be written to costs the next run its time, and nothing else.
    }
}

std::vector<char> load_pipelines(const std::filesystem::path& file,
                                 const VkPhysicalDeviceProperties& properties) {
    std::ifstream in(file, std::ios::binary);
    FileHeader header{};
    if (!in.read(reinterpret_cast<char*>(&header), sizeof(header))) return {};
    const std::vector<char> data{std::istreambuf_iterator<char>(in), {}};
    const bool is_whole =
        header.magic == kMagic && header.bytes == data.size() && header.checksum == checksum(data);
    return is_whole && is_of_device(data, properties) ? data : std::vector<char>{};
}

void store_pipelines(const std::filesystem::path& file, const std::vector<char>& data) {
    AtomicFile out(file);
    const FileHeader header{kMagic, data.size(), checksum(data)};
    std::fwrite(&header, sizeof(header), 1, out.stream());
    std::fwrite(data.data(), 1, data.size(), out.stream());
    out.commit();
}

std::filesystem::path default_cache_folder() {
    const char* xdg = std::getenv("XDG_CACHE_HOME");
    if (xdg && *xdg == '/') return std::filesystem::path(xdg) / "tyndall"; // others are invalid
    const char* home = std::getenv("HOME");
    return home && *home ? std::filesystem::path(home) / ".cache" / "tyndall"
                         : std::filesystem::path();
}

} // namespace tyndall::gpu

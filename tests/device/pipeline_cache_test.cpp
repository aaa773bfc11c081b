// Compiled pipelines on disk: what is not whole, or not of this device, counts as nothing.
#include "gpu/pipeline_cache.h"

#include "device/device_test.h"
#include "device/test_scenes.h"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <unistd.h>

namespace tyndall::device_test {
namespace {

namespace fs = std::filesystem;

std::string read_bytes(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}
void write_bytes(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

class PipelineCacheTest : public DeviceTest {
  protected:
    void SetUp() override {
        DeviceTest::SetUp();
        fs::create_directories(folder_);
    }
    void TearDown() override {
        fs::remove_all(folder_);
        DeviceTest::TearDown();
    }

    /// What a driver would hand out: its header, and some code.
    static std::vector<char> some_data(const VkPhysicalDeviceProperties& properties) {
        VkPipelineCacheHeaderVersionOne header{sizeof(header),
                                               VK_PIPELINE_CACHE_HEADER_VERSION_ONE,
                                               properties.vendorID,
                                               properties.deviceID,
                                               {}};
        std::memcpy(header.pipelineCacheUUID, properties.pipelineCacheUUID, VK_UUID_SIZE);
        std::vector<char> data(sizeof(header) + 1000, 'x');
        std::memcpy(data.data(), &header, sizeof(header));
        return data;
    }

    fs::path folder_ = fs::temp_directory_path() / ("tyndall-cache-" + std::to_string(getpid()));
};

TEST_F(PipelineCacheTest, OnlyWholeFilesOfThisDeviceCount) {
    VkPhysicalDeviceProperties properties{.driverVersion = 3, .vendorID = 1, .deviceID = 2};
    properties.pipelineCacheUUID[5] = 7;
    const std::vector<char> data = some_data(properties);
    const fs::path file = folder_ / "pipelines";
    EXPECT_TRUE(gpu::load_pipelines(file, properties).empty()); // there is none
    gpu::store_pipelines(file, data);
    EXPECT_EQ(gpu::load_pipelines(file, properties), data); // the control

    VkPhysicalDeviceProperties other = properties;
    other.pipelineCacheUUID[5] = 8;
    EXPECT_TRUE(gpu::load_pipelines(file, other).empty());
    other = properties;
    other.deviceID = 9;
    EXPECT_TRUE(gpu::load_pipelines(file, other).empty());

    const std::string whole = read_bytes(file);
    for (const std::size_t size : {std::size_t{0}, std::size_t{10}, whole.size() - 1}) {
        write_bytes(file, whole.substr(0, size));
        EXPECT_TRUE(gpu::load_pipelines(file, properties).empty()) << size;
    }
    for (const std::size_t at : {std::size_t{3}, std::size_t{20}, whole.size() / 2}) {
        std::string damaged = whole;
        damaged[at] ^= 1;
        write_bytes(file, damaged);
        EXPECT_TRUE(gpu::load_pipelines(file, properties).empty()) << at;
    }
    gpu::store_pipelines(file, data); // replaces it
    EXPECT_EQ(gpu::load_pipelines(file, properties), data);
}

/// Neither a folder that cannot be made nor one full of rubbish changes a picture.
TEST_F(PipelineCacheTest, CachesNeverChangeOrStopARender) {
    const auto picture = render_sums(plain_scene(), 0, 4);
    write_bytes(folder_ / "file", "");
    for (const fs::path& cache : {folder_ / "new" / "folder", folder_ / "file" / "no folder"}) {
        for (int run = 0; run < 2; ++run) {
            gpu::Context context({.device = device_test::context().info().name,
                                  .validate = true,
                                  .cache_folder = cache});
            Renderer renderer(context, plain_scene());
            renderer.render(0, 4);
            EXPECT_EQ(renderer.read_sums(), picture);
        }
        if (!fs::exists(cache)) continue;
        for (const auto& entry : fs::directory_iterator(cache))
            write_bytes(entry.path(), "rubbish");
    }
}

TEST_F(PipelineCacheTest, LivesWhereCachesBelong) {
    const char* home = std::getenv("HOME");
    const std::string before = home ? home : "";
    setenv("HOME", "/home/someone", 1);
    unsetenv("XDG_CACHE_HOME");
    EXPECT_EQ(gpu::default_cache_folder(), "/home/someone/.cache/tyndall");
    setenv("XDG_CACHE_HOME", "/cache", 1);
    EXPECT_EQ(gpu::default_cache_folder(), "/cache/tyndall");
    setenv("XDG_CACHE_HOME", "not/absolute", 1);
    EXPECT_EQ(gpu::default_cache_folder(), "/home/someone/.cache/tyndall");
    unsetenv("XDG_CACHE_HOME");
    unsetenv("HOME");
    EXPECT_TRUE(gpu::default_cache_folder().empty());
    setenv("HOME", before.c_str(), 1);
}

} // namespace
} // namespace tyndall::device_test

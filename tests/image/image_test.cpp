// Images must come back from files as they went in, and a failed write must leave the old file.
#include "core/error.h"
#include "image/image.h"

#include <cmath>
#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>
#include <sys/resource.h>
#include <unistd.h>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

class ImageFile : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }
    fs::path path(const char* name) const { return folder_ / name; }

    static Image gradient(int width, int height, std::vector<std::string> channels) {
        Image image(width, height, std::move(channels));
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            image.pixels[i] = 1e-3f * static_cast<float>(i % 1000);
        return image;
    }

    static std::vector<std::string> six_channels() {
        return {"R", "G", "B", "variance.R", "variance.G", "variance.B"};
    }

    static std::string bytes(const fs::path& file) {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

  private:
    fs::path folder_ =
        fs::temp_directory_path() / ("tyndall_image_test_" + std::to_string(getpid()));
};

template<class Function>
std::string error_of(Function&& function, ExitStatus status) {
    try {
        function();
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), status);
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
}

TEST_F(ImageFile, ExrKeepsEveryChannelBitByBit) {
    Image image = gradient(37, 150, six_channels());
    image.at(3, 2, 1) = -1e30f;
    image.at(4, 2, 1) = 1e-40f; // Denormal.
    write_image(path("a.exr"), image);
    const Image back = read_image(path("a.exr"));
    EXPECT_EQ(back.channels, image.channels);
    EXPECT_EQ(back.pixels, image.pixels);
}

TEST_F(ImageFile, ExrKeepsAttributesAndWindows) {
    ImageAttributes attributes{100, 80, 10, 20, {}};
    Matrix44 matrix;
    for (std::size_t i = 0; i < 16; ++i)
        matrix[i] = static_cast<float>(i);
    attributes.values = {{"tyndall:seed", std::string("12345678901234")},
                         {"samplesPerPixel", 64},
                         {"renderTimeSeconds", 1.5f},
                         {"tyndall:error", 1.0 / 3},
                         {"worldToCamera", matrix},
                         {"worldToNDC", matrix}};
    write_image(path("a.exr"), gradient(8, 4, {"R", "G", "B"}), attributes);
    const ImageAttributes back = read_image_attributes(path("a.exr"));
    EXPECT_EQ(back.full_width, 100);
    EXPECT_EQ(back.full_height, 80);
    EXPECT_EQ(back.x, 10);
    EXPECT_EQ(back.y, 20);
    for (const auto& expected : attributes.values)
        EXPECT_NE(std::find(back.values.begin(), back.values.end(), expected), back.values.end())
            << expected.first;
    EXPECT_EQ(read_image(path("a.exr")).pixels, gradient(8, 4, {"R", "G", "B"}).pixels);
}

TEST_F(ImageFile, HalfRoundsAndCountsWhatItClamps) {
    Image image = gradient(5, 3, {"R", "G", "B"});
    image.at(0, 0, 0) = 1e6f;
    image.at(0, 0, 1) = -1e6f;
    image.at(0, 0, 2) = std::numeric_limits<float>::infinity();
    EXPECT_EQ(write_image(path("a.exr"), image, {}, {.half = true}), 2u);
    const Image back = read_image(path("a.exr"));
    EXPECT_EQ(back.at(0, 0, 0), 65504.0f);
    EXPECT_EQ(back.at(0, 0, 1), -65504.0f);
    EXPECT_EQ(back.at(0, 0, 2), std::numeric_limits<float>::infinity());
    for (std::size_t i = 3; i < image.pixels.size(); ++i)
        EXPECT_NEAR(back.pixels[i], image.pixels[i], image.pixels[i] / 2048);
    EXPECT_EQ(write_image(path("b.exr"), image), 0u);
}

TEST_F(ImageFile, HalfLeavesVariancesWhole) {
    Image image(1, 1, {"R", "G", "B", "variance.R"});
    image.pixels = {1e-9f, 0.5f, 1, 1e-9f};
    EXPECT_EQ(write_image(path("a.exr"), image, {}, {.half = true}), 0u);
    const Image back = read_image(path("a.exr"));
    const auto value = [&](const char* name) { return back.at(0, 0, *back.channel_index(name)); };
    EXPECT_EQ(value("variance.R"), 1e-9f);
    EXPECT_EQ(value("R"), 0) << "no teeth";
    EXPECT_EQ(value("G"), 0.5f);
}

TEST_F(ImageFile, TiffIsExactAndHdrHasEightBits) {
    const Image image = gradient(40, 70, six_channels());
    for (const auto& [name, tolerance] :
         {std::pair("a.tif", 0.0f), std::pair("a.hdr", 1.0f / 128)}) {
        write_image(path(name), image);
        const Image back = read_image(path(name));
        ASSERT_EQ(back.channels, (std::vector<std::string>{"R", "G", "B"})) << name;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (std::size_t c = 0; c < 3; ++c)
                    ASSERT_NEAR(back.at(x, y, c), image.at(x, y, c), tolerance) << name;
    }
}

TEST_F(ImageFile, PngAppliesTheSrgbCurveAndClamps) {
    Image image(5, 1, {"R", "G", "B"});
    const float values[] = {-1, 0.0020f, 0.5f, 7, std::nanf("")};
    const float expected[] = {0, 12.92f * 0.0020f, 0.735357f, 1, 0}; // IEC 61966-2-1
    for (int x = 0; x < 5; ++x)
        image.at(x, 0, 0) = values[x];
    write_image(path("a.png"), image);
    const Image back = read_image(path("a.png"));
    for (int x = 0; x < 5; ++x) {
        const float linear = back.at(x, 0, 0);
        const float code =
            linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
        EXPECT_NEAR(code, expected[x], 0.5f / 255 + 1e-5f);
    }
}

TEST_F(ImageFile, UnknownExtensionNamesTheKnownOnes) {
    const std::string message = error_of(
        [&] {
            write_image(path("a.bmp"), gradient(1, 1, {"R", "G", "B"}));
        },
        ExitStatus::bad_input);
    EXPECT_NE(message.find(".exr, .hdr, .tif or .png"), std::string::npos);
}

TEST_F(ImageFile, MissingFolderAndMissingFileAreErrors) {
    EXPECT_NE(error_of(
                  [&] {
                      write_image(path("no/a.exr"), gradient(1, 1, {"R", "G", "B"}));
                  },
                  ExitStatus::failed)
                  .find("cannot write"),
              std::string::npos);
    EXPECT_NE(
        error_of([&] { read_image(path("a.exr")); }, ExitStatus::bad_input).find("no such file"),
        std::string::npos);
    std::ofstream(path("broken.exr")) << "this is no image";
    EXPECT_NE(error_of([&] { read_image(path("broken.exr")); }, ExitStatus::bad_input)
                  .find("cannot read"),
              std::string::npos);
}

/// A disk that is full before the last byte, as RLIMIT_FSIZE plays it.
TEST_F(ImageFile, FailedWriteLeavesTheOldFileAndNoTemporary) {
    const Image small = gradient(2, 2, {"R", "G", "B"});
    Image large(100, 70, {"R", "G", "B"});
    for (std::size_t i = 0; i < large.pixels.size(); ++i) // Noise: not to be compressed away.
        large.pixels[i] = static_cast<float>((i * 2654435761u) % 1000003u) * 1e-6f;
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit;
    getrlimit(RLIMIT_FSIZE, &limit);
    for (const char* name : {"a.exr", "a.tif", "a.hdr", "a.png"}) {
        write_image(path(name), large);
        const std::uintmax_t size = fs::file_size(path(name));
        write_image(path(name), small);
        const std::string before = bytes(path(name));
        for (const std::uintmax_t room : {size - 1, size / 2, std::uintmax_t{10}}) {
            const rlimit tight{room, limit.rlim_max};
            setrlimit(RLIMIT_FSIZE, &tight);
            error_of([&] { write_image(path(name), large); }, ExitStatus::failed);
            setrlimit(RLIMIT_FSIZE, &limit);
            EXPECT_TRUE(bytes(path(name)) == before) << name << ", room for " << room;
        }
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(path("")), fs::directory_iterator()), 4);
}

} // namespace
} // namespace tyndall

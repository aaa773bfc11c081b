/// Float images and their files.
///
/// Formats by extension: .exr (every channel, float32 or half), .hdr (RGBE), .tif/.tiff (float32)
/// and .png (8 bit, sRGB transfer function, clamped to [0, 1]); all but .exr keep only R, G, B.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace tyndall {

/// Interleaved floats, row by row, top row first. Colour is linear. The channels of a picture are
/// R G B, then variance.R variance.G variance.B if known, then others.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::string> channels;
    std::vector<float> pixels; ///< width * height * channels.size()

    Image() = default;
    /// All values are zero.
    Image(int image_width, int image_height, std::vector<std::string> channel_names);

    std::size_t offset(int x, int y) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x)) *
               channels.size();
    }
    float& at(int x, int y, std::size_t channel) { return pixels[offset(x, y) + channel]; }
    float at(int x, int y, std::size_t channel) const { return pixels[offset(x, y) + channel]; }
    std::optional<std::size_t> channel_index(std::string_view name) const;
};

/// Acts on column vectors; stored column by column, as glm::mat4.
using Matrix44 = std::array<float, 16>;
using AttributeValue = std::variant<std::string, int, float, double, Matrix44>;

/// What a file says about its image. Only .exr keeps all of it; pbrt's names are samplesPerPixel
/// (int), renderTimeSeconds (float), worldToCamera and worldToNDC (Matrix44).
struct ImageAttributes {
    int full_width = 0; ///< Size of the picture that the image is a part of; 0: the image is all.
    int full_height = 0;
    int x = 0; ///< Where in it the image begins.
    int y = 0;
    std::vector<std::pair<std::string, AttributeValue>> values;
};

struct WriteOptions {
    /// .exr: 16-bit floats, but for variance.*; finite values beyond +-65504 are written as
    /// +-65504.
    bool half = false;
};

/// Writes an image so that the file either has all of it or is what it was before: into a temporary
/// file next to it, which is then renamed.
///
/// @return how many values were clamped to the range of half; 0 if options.half is not set.
/// @throws Error bad_input: unknown extension; failed: "cannot write FILE: reason", also if a
/// format
///         other than .exr is asked for and the image has no R, G, B.
std::size_t write_image(const std::filesystem::path& path, const Image& image,
                        const ImageAttributes& attributes = {}, WriteOptions options = {});

/// Reads any file that OpenImageIO knows; 8 and 16 bit sRGB files are made linear.
/// @throws Error bad_input: "cannot read FILE: reason".
Image read_image(const std::filesystem::path& path);

/// Reads what a file says about its image, in the types of AttributeValue; others are left out.
/// @throws Error bad_input: "cannot read FILE: reason".
ImageAttributes read_image_attributes(const std::filesystem::path& path);

/// @throws Error bad_input if write_image does not know the extension of path; lists those it
/// knows.
void check_image_extension(const std::filesystem::path& path);

} // namespace tyndall

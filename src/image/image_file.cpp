// The only file that includes OpenImageIO: it costs 10 s to compile.
#include "core/atomic_file.h"
#include "core/error.h"
#include "image/image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <system_error>

namespace tyndall {
namespace {

constexpr int strip_height = 64; // A multiple of the 16 lines that a ZIP block of an EXR holds.
constexpr float largest_half = 65504.0f;

enum class Format { exr, hdr, tiff, png };

/// How an image becomes a file.
struct Encoding {
    Format format;
    std::vector<std::size_t> channels; ///< Of the image, in the order of the file.
    std::vector<bool> is_half;         ///< Of each of them; empty if none is.
};

[[noreturn]] void fail_write(const std::filesystem::path& path, const std::string& reason) {
    throw Error(ExitStatus::failed, "cannot write " + path.string() + ": " + reason);
}

[[noreturn]] void fail_read(const std::filesystem::path& path, const std::string& reason) {
    throw Error(ExitStatus::bad_input, "cannot read " + path.string() + ": " + reason);
}

Format format_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (extension == ".exr") return Format::exr;
    if (extension == ".hdr") return Format::hdr;
    if (extension == ".tif" || extension == ".tiff") return Format::tiff;
    if (extension == ".png") return Format::png;
    throw Error(ExitStatus::bad_input, "cannot write " + path.string() + ": unknown extension '" +
                                           extension + "' (expected .exr, .hdr, .tif or .png)");
}

const char* oiio_name(Format format) {
    switch (format) {
    case Format::exr:
        return "openexr";
    case Format::hdr:
        return "hdr";
    case Format::tiff:
        return "tiff";
    case Format::png:
        return "png";
    }
    return "";
}

/// IEC 61966-2-1.
float srgb_from_linear(float value) {
    if (value <= 0.0031308f) return 12.92f * value;
    return 1.055f * std::pow(value, 1 / 2.4f) - 0.055f;
}

float linear_from_srgb(float value) {
    if (value <= 0.04045f) return value / 12.92f;
    return std::pow((value + 0.055f) / 1.055f, 2.4f);
}

Encoding choose_encoding(const std::filesystem::path& path, const Image& image,
                         WriteOptions options) {
    Encoding encoding{format_of(path), {}, {}};
    if (encoding.format == Format::exr) {
        for (std::size_t c = 0; c < image.channels.size(); ++c) {
            encoding.channels.push_back(c);
            // Variances are squares: half floats have no room for those of small values.
            if (options.half)
                encoding.is_half.push_back(image.channels[c].rfind("variance.", 0) != 0);
        }
        return encoding;
    }
    for (const char* name : {"R", "G", "B"}) {
        const std::optional<std::size_t> index = image.channel_index(name);
        if (!index) fail_write(path, "the image has no channel " + std::string(name));
        encoding.channels.push_back(*index);
    }
    return encoding;
}

void set_attributes(OIIO::ImageSpec& spec, const ImageAttributes& attributes) {
    for (const auto& [name, value] : attributes.values) {
        if (const auto* text = std::get_if<std::string>(&value)) spec.attribute(name, *text);
        if (const auto* number = std::get_if<int>(&value)) spec.attribute(name, *number);
        if (const auto* number = std::get_if<float>(&value)) spec.attribute(name, *number);
        if (const auto* number = std::get_if<double>(&value))
            spec.attribute(name, OIIO::TypeDesc::DOUBLE, number);
        // OpenEXR's matrices act on row vectors and are stored row by row: the same 16 numbers.
        if (const auto* matrix = std::get_if<Matrix44>(&value))
            spec.attribute(name, OIIO::TypeMatrix, matrix->data());
    }
}

OIIO::ImageSpec make_spec(const Image& image, const Encoding& encoding,
                          const ImageAttributes& attributes) {
    const bool is_png = encoding.format == Format::png;
    const OIIO::TypeDesc type = is_png ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
    const std::size_t channel_count = encoding.channels.size();
    OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(channel_count), type);
    for (std::size_t c = 0; c < channel_count; ++c)
        spec.channelnames[c] = image.channels[encoding.channels[c]];
    for (const bool is_half : encoding.is_half)
        spec.channelformats.push_back(is_half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
    spec.attribute("Software", "Tyndall");
    spec.attribute("oiio:ColorSpace", encoding.format == Format::png ? "sRGB" : "Linear");
    set_attributes(spec, attributes);
    if (encoding.format == Format::exr && attributes.full_width > 0) {
        spec.x = attributes.x;
        spec.y = attributes.y;
        spec.full_width = attributes.full_width;
        spec.full_height = attributes.full_height;
    }
    return spec;
}

std::vector<float> copy_rows(const Image& image, const Encoding& encoding, int y0, int y1) {
    std::vector<float> rows;
    rows.reserve(image.offset(0, y1 - y0));
    for (std::size_t i = image.offset(0, y0); i < image.offset(0, y1); i += image.channels.size())
        for (std::size_t c : encoding.channels)
            rows.push_back(image.pixels[i + c]);
    return rows;
}

/// Brings values into the range of the file. Returns how many exceeded that of half.
std::size_t fit_to_format(std::vector<float>& values, const Encoding& encoding) {
    std::size_t clamped = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        float& value = values[i];
        const bool is_half =
            !encoding.is_half.empty() && encoding.is_half[i % encoding.is_half.size()];
        if (encoding.format == Format::png) // A NaN becomes black: comparisons with it are false.
            value = value > 0 ? srgb_from_linear(std::min(value, 1.0f)) : 0.0f;
        if (is_half && std::isfinite(value) && std::abs(value) > largest_half) {
            value = std::copysign(largest_half, value);
            ++clamped;
        }
    }
    return clamped;
}

/// Strip by strip, so that a large image is never copied as a whole.
std::size_t write_strips(OIIO::ImageOutput& file, const Image& image, const Encoding& encoding,
                         const std::filesystem::path& path) {
    std::size_t clamped = 0;
    const int top = file.spec().y;
    for (int y0 = 0; y0 < image.height; y0 += strip_height) {
        const int y1 = std::min(y0 + strip_height, image.height);
        std::vector<float> strip = copy_rows(image, encoding, y0, y1);
        clamped += fit_to_format(strip, encoding);
        if (!file.write_scanlines(top + y0, top + y1, 0, OIIO::TypeDesc::FLOAT, strip.data()))
            fail_write(path, file.geterror());
    }
    return clamped;
}

std::unique_ptr<OIIO::ImageInput> open_for_reading(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) fail_read(path, "no such file");
    std::unique_ptr<OIIO::ImageInput> file = OIIO::ImageInput::open(path.string());
    if (!file) fail_read(path, OIIO::geterror());
    return file;
}

std::optional<AttributeValue> attribute_value(const OIIO::ParamValue& value) {
    const OIIO::TypeDesc type = value.type();
    if (type == OIIO::TypeString) return value.get_string();
    if (type == OIIO::TypeInt) return value.get_int();
    if (type == OIIO::TypeFloat) return value.get_float();
    if (type == OIIO::TypeDesc(OIIO::TypeDesc::DOUBLE))
        return *static_cast<const double*>(value.data());
    if (type == OIIO::TypeMatrix) {
        Matrix44 matrix;
        std::copy_n(static_cast<const float*>(value.data()), matrix.size(), matrix.begin());
        return matrix;
    }
    return std::nullopt;
}

} // namespace

void check_image_extension(const std::filesystem::path& path) {
    format_of(path);
}

std::size_t write_image(const std::filesystem::path& path, const Image& image,
                        const ImageAttributes& attributes, WriteOptions options) {
    const Encoding encoding = choose_encoding(path, image, options);
    // OpenImageIO does not look at what flushing and closing return, so the stream is ours.
    AtomicFile target(path);
    OIIO::Filesystem::IOFile proxy(target.stream(), OIIO::Filesystem::IOProxy::Write);
    const std::unique_ptr<OIIO::ImageOutput> file =
        OIIO::ImageOutput::create(oiio_name(encoding.format));
    if (!file) fail_write(path, OIIO::geterror());
    file->set_ioproxy(&proxy);
    if (!file->open(path.string(), make_spec(image, encoding, attributes)))
        fail_write(path, file->geterror());
    const std::size_t clamped = write_strips(*file, image, encoding, path);
    if (!file->close()) fail_write(path, file->geterror());
    target.commit();
    return clamped;
}

Image read_image(const std::filesystem::path& path) {
    const std::unique_ptr<OIIO::ImageInput> file = open_for_reading(path);
    const OIIO::ImageSpec& spec = file->spec();
    Image image(spec.width, spec.height, spec.channelnames);
    if (!file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data()))
        fail_read(path, file->geterror());
    if (spec.get_string_attribute("oiio:ColorSpace") != "sRGB") return image;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        if (static_cast<int>(i % image.channels.size()) != spec.alpha_channel)
            image.pixels[i] = linear_from_srgb(image.pixels[i]);
    return image;
}

ImageAttributes read_image_attributes(const std::filesystem::path& path) {
    const OIIO::ImageSpec spec = open_for_reading(path)->spec();
    ImageAttributes attributes{spec.full_width, spec.full_height, spec.x, spec.y, {}};
    for (const OIIO::ParamValue& value : spec.extra_attribs)
        if (std::optional<AttributeValue> known = attribute_value(value))
            attributes.values.emplace_back(value.name().string(), std::move(*known));
    return attributes;
}

} // namespace tyndall

#include "study/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace tyndall::study {
namespace {

double grey(const glm::dvec3& c) {
    return (c.r + c.g + c.b) / 3;
}

/// Blue, light grey, red: ColorBrewer's RdBu, whose ends are as far from the middle for every
/// kind of colour vision. sRGB, 0 ... 255.
constexpr std::array<std::array<double, 3>, 7> kDiverging{{{33, 102, 172},
                                                           {103, 169, 207},
                                                           {190, 216, 231},
                                                           {244, 244, 242},
                                                           {250, 206, 178},
                                                           {239, 138, 98},
                                                           {178, 24, 43}}};

double linear(double srgb) {
    const double value = srgb / 255;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// For -1 ... 1.
glm::dvec3 diverging(double value) {
    const double at = (std::clamp(value, -1.0, 1.0) + 1) / 2 * (kDiverging.size() - 1);
    const auto low = std::min(static_cast<std::size_t>(at), kDiverging.size() - 2);
    glm::dvec3 colour;
    for (int c = 0; c < 3; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        colour[c] = linear(std::lerp(kDiverging[low][channel], kDiverging[low + 1][channel],
                                     at - static_cast<double>(low)));
    }
    return colour;
}

template<typename Colour>
Image to_image(const Canvas& canvas, const Colour& colour) {
    Image image(canvas.width, canvas.height(), {"R", "G", "B"});
    for (std::size_t i = 0; i < canvas.pixels.size(); ++i) {
        const glm::dvec3 value = colour(i);
        for (int c = 0; c < 3; ++c)
            image.pixels[3 * i + static_cast<std::size_t>(c)] = static_cast<float>(value[c]);
    }
    return image;
}

std::string base64(const std::string& bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t j = 0; j < 3; ++j)
            word =
                word << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
        for (std::size_t j = 0; j < 4; ++j)
            text += i + j > bytes.size() ? '=' : digits[word >> (18 - 6 * j) & 63];
    }
    return text;
}

} // namespace

Crop find_detail(const Canvas& canvas) {
    const auto extent = [](int size) { return std::min(size, std::clamp(size / 2, 48, 96)); };
    Crop best{0, 0, extent(canvas.width), extent(canvas.height())};
    double most = -1;
    for (int y = 0; y + best.height <= canvas.height(); y += 8)
        for (int x = 0; x + best.width <= canvas.width; x += 8) {
            double sum = 0, square = 0;
            for (const glm::dvec3& pixel : cut(canvas, {x, y, best.width, best.height}).pixels) {
                sum += grey(pixel);
                square += grey(pixel) * grey(pixel);
            }
            const double variance = square - sum * sum / (double(best.width) * best.height);
            if (variance > most) most = variance, best.x = x, best.y = y;
        }
    return best;
}

Canvas cut(const Canvas& canvas, const Crop& crop) {
    Canvas part{{}, crop.width};
    for (int y = crop.y; y < crop.y + crop.height; ++y) {
        const auto row = canvas.pixels.begin() + std::ptrdiff_t{y} * canvas.width + crop.x;
        part.pixels.insert(part.pixels.end(), row, row + crop.width);
    }
    return part;
}

double exposure(const Canvas& canvas) {
    std::vector<double> values;
    for (const glm::dvec3& pixel : canvas.pixels)
        values.push_back(std::max({pixel.r, pixel.g, pixel.b}));
    const auto high = values.begin() + static_cast<std::ptrdiff_t>(0.99 * double(values.size()));
    std::nth_element(values.begin(), high, values.end());
    return *high > 0 ? 1 / *high : 1;
}

Image tone_mapped(const Canvas& canvas, double factor) {
    return to_image(canvas, [&](std::size_t i) { return factor * canvas.pixels[i]; });
}

Image signed_error(const Canvas& canvas, const Picture& reference, double scale) {
    return to_image(canvas, [&](std::size_t i) {
        return diverging(grey(canvas.pixels[i] - reference[i]) / scale);
    });
}

std::string signed_error_gradient() {
    std::string stops;
    for (const auto& colour : kDiverging)
        stops += fmt::format(", rgb({}, {}, {})", colour[0], colour[1], colour[2]);
    return "linear-gradient(to right" + stops + ")";
}

std::string embed_png(const Image& image, const std::filesystem::path& file) {
    write_image(file, image);
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    return "data:image/png;base64," + base64(bytes);
}

} // namespace tyndall::study

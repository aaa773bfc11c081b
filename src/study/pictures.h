/// Pictures for the report: tone mapped, or signed errors in colour.
#pragma once

#include "image/image.h"
#include "study/error_split.h"

#include <filesystem>
#include <string>

namespace tyndall::study {

/// A picture and how wide it is.
struct Canvas {
    Picture pixels;
    int width = 0;
    int height() const { return static_cast<int>(pixels.size()) / width; }
};

/// A part of a picture.
struct Crop {
    int x = 0, y = 0, width = 0, height = 0;
};

/// The part with the most detail, at most 96 pixels and half of the picture on each axis (but 48 at
/// least, if the picture has as many).
Crop find_detail(const Canvas& canvas);
Canvas cut(const Canvas& canvas, const Crop& crop);

/// What makes the brightest percent of the picture white.
double exposure(const Canvas& canvas);

/// Times a factor; for PNG.
Image tone_mapped(const Canvas& canvas, double factor);

/// Picture less reference, averaged over the channels: blue where it is too dark, red where too
/// bright, grey-white where right; full colour at -scale and +scale and beyond.
Image signed_error(const Canvas& canvas, const Picture& reference, double scale);
/// The colours of signed_error from -1 to 1, as a CSS gradient.
std::string signed_error_gradient();

/// Writes a PNG and returns it as a data: URI.
/// @throws Error failed
std::string embed_png(const Image& image, const std::filesystem::path& file);

} // namespace tyndall::study

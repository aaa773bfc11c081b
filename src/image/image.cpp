#include "image/image.h"

#include <algorithm>

namespace tyndall {

Image::Image(int image_width, int image_height, std::vector<std::string> channel_names)
    : width(image_width), height(image_height), channels(std::move(channel_names)),
      pixels(offset(0, image_height)) {}

std::optional<std::size_t> Image::channel_index(std::string_view name) const {
    const auto found = std::find(channels.begin(), channels.end(), name);
    if (found == channels.end()) return std::nullopt;
    return static_cast<std::size_t>(found - channels.begin());
}

} // namespace tyndall

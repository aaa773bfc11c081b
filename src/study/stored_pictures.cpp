#include "study/stored_pictures.h"

#include "core/error.h"

#include <fmt/format.h>

namespace tyndall::study {
namespace {

/// Adds a picture to an image as channels "LAYER.R" ...; the image is interleaved at the end.
struct Layers {
    std::vector<std::string> names;
    std::vector<const Picture*> pictures;

    void add(const std::string& prefix, const Picture& picture) {
        for (const char* channel : {"R", "G", "B"})
            names.push_back(prefix + channel);
        pictures.push_back(&picture);
    }
    Image interleaved(int width, int height) const {
        Image image(width, height, names);
        for (std::size_t layer = 0; layer < pictures.size(); ++layer)
            for (std::size_t i = 0; i < pictures[layer]->size(); ++i)
                for (int c = 0; c < 3; ++c)
                    image.pixels[i * names.size() + 3 * layer + static_cast<std::size_t>(c)] =
                        static_cast<float>((*pictures[layer])[i][c]);
        return image;
    }
};

/// Empty if the image has no such layer.
Picture layer_of(const Image& image, const std::string& prefix) {
    Picture picture;
    std::array<std::size_t, 3> channels{};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::optional<std::size_t> index =
            image.channel_index(prefix + std::string(1, "RGB"[c]));
        if (!index) return picture;
        channels[c] = *index;
    }
    for (std::size_t i = 0; i < image.pixels.size(); i += image.channels.size())
        picture.emplace_back(image.pixels[i + channels[0]], image.pixels[i + channels[1]],
                             image.pixels[i + channels[2]]);
    return picture;
}

std::string part_prefix(std::size_t part) {
    return fmt::format("part{}.", part);
}

} // namespace

void StoredPictures::write_reference(const Reference& reference) const {
    Layers layers;
    layers.add("", reference.mean);
    layers.add("variance.", reference.variance);
    for (std::size_t part = 0; part < reference.parts.size(); ++part)
        layers.add(part_prefix(part), reference.parts[part]);
    write_image(reference_file(), layers.interleaved(width(), height()));
}

Reference StoredPictures::read_reference(const std::filesystem::path& path) const {
    const Image image = read_image(path);
    if (image.width != width() || image.height != height())
        throw Error(ExitStatus::bad_input,
                    fmt::format("{} has {} x {} pixels (expected {} x {}, as the study)",
                                path.string(), image.width, image.height, width(), height()));
    Reference reference{layer_of(image, ""), layer_of(image, "variance."), {}};
    if (reference.mean.empty())
        throw Error(ExitStatus::bad_input,
                    fmt::format("{} has no channels R, G, B", path.string()));
    reference.variance.resize(reference.mean.size(), glm::dvec3(0));
    for (std::size_t part = 0; part < kRuns; ++part) {
        Picture picture = layer_of(image, part_prefix(part));
        if (!picture.empty()) reference.parts.push_back(std::move(picture));
    }
    if (reference.parts.size() != kRuns) reference.parts.clear();
    return reference;
}

void StoredPictures::write(const std::string& name, const Picture& mean,
                           const Picture& equal_time) const {
    Layers layers;
    layers.add("", mean);
    if (!equal_time.empty()) layers.add("equal.", equal_time);
    write_image(file(name, ".exr"), layers.interleaved(width(), height()));
}

Canvas StoredPictures::read(const std::string& name, const std::string& layer) const {
    return {layer_of(read_image(file(name, ".exr")), layer), width()};
}

} // namespace tyndall::study

/// The pictures of a study, in images/ of its folder: so that it can go on another day.
#pragma once

#include "image/image.h"
#include "scene/scene.h"
#include "study/pictures.h"

namespace tyndall::study {

class StoredPictures {
  public:
    StoredPictures(std::filesystem::path folder, const Scene& scene)
        : folder_(std::move(folder) / "images"), bounds_(scene.film.bounds) {}

    std::filesystem::path file(const std::string& name, const char* extension) const {
        return folder_ / (name + extension);
    }
    std::filesystem::path reference_file() const { return file("reference", ".exr"); }

    /// With its parts, as channels part0.R ... of the file.
    void write_reference(const Reference& reference) const;
    /// Any image of the right size; its variance and parts are 0 and none where it has none.
    /// @throws Error bad_input: another size, or no R, G, B.
    Reference read_reference(const std::filesystem::path& path) const;

    /// NAME.exr: the mean of all runs as R G B, that after equal time as equal.R ...
    void write(const std::string& name, const Picture& mean, const Picture& equal_time) const;
    /// A picture of NAME.exr: `layer` is "" or "equal.".
    Canvas read(const std::string& name, const std::string& layer) const;

    int width() const { return bounds_.width(); }
    int height() const { return bounds_.height(); }

  private:
    std::filesystem::path folder_;
    PixelBounds bounds_;
};

} // namespace tyndall::study

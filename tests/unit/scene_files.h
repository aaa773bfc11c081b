/// Scene files for tests: written to a folder of their own, read, and gone after the test.
#pragma once

#include "scene/reader.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall {

class SceneFolder {
  public:
    SceneFolder();
    ~SceneFolder();
    SceneFolder(const SceneFolder&) = delete;
    SceneFolder& operator=(const SceneFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    /// Writes a file, and the folders on its way.
    void write(const std::string& name, std::string_view bytes) const;

    /// Writes "scene.pbrt" and reads it.
    Scene read(std::string_view text) const;

    /// The errors of that scene, one string each; file names without the folder. Empty: no error.
    std::vector<std::string> errors(std::string_view text) const;

    /// The warnings of a scene without errors, in the same form.
    std::vector<std::string> warnings(std::string_view text) const;

    /// Lines without the folder in front of file names.
    std::vector<std::string> without_folder(std::vector<std::string> lines) const;

  private:
    std::filesystem::path path_;
};

/// A scene with nothing else than this before or after WorldBegin.
Scene read_options(std::string_view text);
Scene read_world(std::string_view text);
std::vector<std::string> option_errors(std::string_view text); ///< Text starts at 1:1.
std::vector<std::string> world_errors(std::string_view text);  ///< Text starts at 2:1.
std::vector<std::string> world_warnings(std::string_view text);

/// The only error of such a text, without its place; something else if there is not just one.
std::string option_error(std::string_view text);
std::string world_error(std::string_view text);

/// A text with a piece appended until it has 10 MB.
std::string filled(std::string text, std::string_view piece);

/// One gzip member.
std::string gzip(std::string_view bytes);

/// Whether all components differ by at most `tolerance`.
template<typename T>
bool is_near(const T& a, const T& b, double tolerance = 1e-12) {
    for (int i = 0; i < T::length(); ++i) {
        if constexpr (requires { a[i][0]; }) {
            if (!is_near(a[i], b[i], tolerance)) return false;
        } else {
            if (!(glm::abs(a[i] - b[i]) <= tolerance)) return false;
        }
    }
    return true;
}

} // namespace tyndall

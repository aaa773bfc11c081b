/// Reads scenes in the language of pbrt-v4.
///
/// Source: pbrt-v4 (src/pbrt/parser.cpp, scene.cpp, paramdict.cpp). Where Tyndall reads a scene in
/// another way than pbrt, the header of the part that does so tells.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <functional>

namespace tyndall {

struct ReadOptions {
    /// Most bytes that the files of a scene may have together, packed and unpacked ones counted: a
    /// bound for compressed files that unpack without end.
    std::uint64_t max_bytes = std::uint64_t{4} << 30;
    /// Called with each file and its length before its contents are made sense of, for progress;
    /// may be empty.
    std::function<void(const std::filesystem::path&, std::uint64_t bytes)> on_file;
};

/// Reads a scene file (.pbrt, .pbrt.gz) and all files that it names.
///
/// Names of files start at the folder of `file`, as in pbrt, or at the folder of the file they
/// stand in. All samplers of pbrt but "independent" and "zsobol" become Owen-scrambled Sobol'
/// points of the same count and seed. Options of pbrt that Tyndall has no use for, and what pbrt
/// itself only warns of, are told in Scene::warnings.
///
/// @throws SceneError with all errors found, but not many more than 20: syntax, unknown or unused
///         parameters, values out of range, names that are not defined, files that cannot be read,
///         and everything of pbrt that "is not supported yet".
Scene read_scene(const std::filesystem::path& file, const ReadOptions& options = {});

/// Sets Camera::screen_window from the aspect of the film (or frame_aspect_ratio), unless the scene
/// gave one: the shorter axis is [-1, 1]. Call again after the size of the film was changed.
void fit_screen_window(Scene& scene);

} // namespace tyndall

/// The scene as the device reads it: one buffer of texels (shaders/shared/records.h).
#pragma once

#include "render/effects.h"
#include "render/volume_tables.h"
#include "shared/records.h"

#include <cstddef>
#include <vector>

namespace tyndall {

struct SceneTables {
    std::vector<glm::uvec4> texels;
    VoxelData voxels;
    /// The members that say where tables start are set, and width, height, seed, ... of the film;
    /// the rest is the renderer's.
    shared::PushConstants push{};
    /// Bytes by table, for --stats.
    std::vector<std::pair<std::string, std::uint64_t>> bytes;
    double film_unit = 1;         ///< See film_unit.h.
    std::uint32_t primitives = 0; ///< PRIMITIVE_* bits of what there is,
    std::uint32_t emitters = 0;   ///< and of what emits.

    /// The features of the scene with those that follow from how it was packed.
    shared::Features features(shared::Features scene) const {
        scene.primitives = primitives;
        scene.emitters = emitters;
        scene.voxels_are_half = voxels.is_half;
        // What emits may come to nothing: grids too large to be lights, triangles without an area.
        if (push.light_count == 0) scene.lights = 0;
        return scene;
    }
};

/// Packs the scene. World space is moved so that the camera is at the origin.
/// @throws Error if something exceeds what records can address.
SceneTables make_scene_tables(const Scene& scene, const Effects& effects);

} // namespace tyndall

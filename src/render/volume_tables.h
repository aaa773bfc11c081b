/// Media as the device reads them: records, brick tables, majorants and voxels.
#pragma once

#include "render/phase_tables.h"
#include "scene/scene.h"
#include "shared/volume_records.h"

#include <map>
#include <vector>

namespace tyndall {

/// Voxels of all grids of a scene: bricks of 512, each 16 or 32 bits a voxel.
struct VoxelData {
    bool is_half = false;
    std::vector<std::byte> bytes;
};

/// Packs media. Tables are handed to `append`, which returns the texel at which they start.
class VolumePacker {
  public:
    using Append = AppendTable;
    VolumePacker(const Scene& scene, const glm::dmat4& render_from_world, Append append);

    /// Records of all media, followed by copies for instances: see medium_shift.
    std::vector<shared::MediumRecord> take_records() { return std::move(records_); }
    /// What an instance with this transform adds to media indices, so that media that vary in space
    /// move with it: 0 if there are none.
    std::uint32_t medium_shift(const glm::dmat4& world_from_definition);
    /// A medium of Scene::media on a grid, as a light.
    struct VoxelLight {
        std::uint32_t texel;   ///< Of its VoxelLightRecord.
        double total;          ///< VoxelLightRecord::total; 0 if it is none.
        std::uint32_t density; ///< Texel of its GridRecord.
        glm::vec3 middle;      ///< Of the box around the voxels that emit.
        float size2;           ///< Mean squared distance from there of what is in that box.
    };
    VoxelLight pack_voxel_light(int medium);
    VoxelData take_voxels() { return std::move(voxels_); }

  private:
    void append_media(const glm::dmat4& world_from_definition);
    shared::MediumRecord make_record(const Medium& medium, const glm::dmat4& world_from_definition);
    std::uint32_t pack_grid_density(const GridDensity& density,
                                    const glm::dmat4& render_from_medium);
    std::uint32_t pack_exponential(const ExponentialDensity& density,
                                   const glm::dmat4& medium_from_render);
    std::uint32_t pack_grid(const std::shared_ptr<const Grid>& grid);
    std::uint32_t pack_majorants(const MajorantGrid& majorants);
    std::uint32_t add_brick(const float* voxels);
    std::uint32_t append_words(const std::vector<std::uint32_t>& words, const char* name);

    const Scene& scene_;
    glm::dmat4 render_from_world_;
    Append append_;
    PhasePacker phases_;
    bool is_uniform_ = true; ///< No medium varies in space.
    VoxelData voxels_;
    std::uint32_t brick_count_ = 0;
    std::map<const Grid*, std::uint32_t> grids_; ///< Packed already: texel of the BrickTableRecord.
    std::map<const MajorantGrid*, std::uint32_t> majorants_;
    std::vector<shared::MediumRecord> records_;
};

/// The table of black body emission (BLACKBODY_ENTRIES texels).
std::vector<glm::vec4> make_blackbody_table();

} // namespace tyndall

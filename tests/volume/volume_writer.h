/// Writes files of OpenVDB and NanoVDB through their own libraries.
#pragma once

#include "volume/grid.h"

#include <string>
#include <utility>
#include <vector>

namespace tyndall {

struct WrittenGrid {
    enum class Type { float32, float16, float64, int32, vec3 };
    enum class Class { fog, level_set, unknown };
    std::string name = "density";
    Type type = Type::float32;
    Class grid_class = Class::fog;
    double background = 0;
    std::vector<std::pair<glm::ivec3, double>> voxels; ///< Active.
    std::vector<std::pair<VoxelBox, double>> boxes; ///< Active; tiles where they hold whole nodes.
    glm::dmat4 world_from_index{1};
    bool is_frustum = false;
};

/// @param is_seekable  else written as a stream, without offsets of grids.
std::string write_vdb(const std::vector<WrittenGrid>& grids, bool is_seekable = true);

enum class NanoCodec { none, zip, blosc };
enum class NanoType { float32, fp4, fp8, fp16, fp_n };
std::string write_nanovdb(const std::vector<WrittenGrid>& grids, NanoCodec codec,
                          NanoType type = NanoType::float32);

} // namespace tyndall

/// What the importance of a light at a place depends on (shaders/wavefront/light_choice.glsl).
#pragma once

#include "render/geometry_tables.h"
#include "render/volume_tables.h"

namespace tyndall {

/// Sets position, axis, complement_start, reach and size2 of a light that is a primitive.
void set_area_reach(shared::LightRecord& light, const GeometryTables& geometry);

/// Sets position, reach and size2 of a light that is a medium.
void set_voxel_reach(shared::LightRecord& light, const VolumePacker::VoxelLight& voxels);

} // namespace tyndall

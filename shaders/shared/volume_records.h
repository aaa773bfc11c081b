// Records of media whose density varies. See records.h for how records lie in texels.
#ifndef TYNDALL_VOLUME_RECORDS_H
#define TYNDALL_VOLUME_RECORDS_H

#include "records.h"

TYNDALL_SHARED_BEGIN

// MediumRecord::density_kind
TYNDALL_CONSTANT uint DENSITY_HOMOGENEOUS = 0u;
TYNDALL_CONSTANT uint DENSITY_GRID = 1u;   // GridRecord
TYNDALL_CONSTANT uint DENSITY_PLANE = 2u;  // ExponentialRecord
TYNDALL_CONSTANT uint DENSITY_SPHERE = 3u; // ExponentialRecord

/// Where the bricks of one grid are (volume/grid.h). Word b of the table is the number of brick b
/// in the voxel buffer (512 voxels each), or NONE.
struct BrickTableRecord {
    ivec3 first_brick;
    uint table; ///< Texel at which its words start, four a texel.
    ivec3 brick_count;
    uint pad0;
};
TYNDALL_CONSTANT uint BRICK_TABLE_TEXELS = 2u;

/// A medium on voxels. Grids are given as the texel of their BrickTableRecord, or NONE.
struct GridRecord {
    AffineRecord index_from_render;
    vec3 lower; ///< Box in index space outside of which the medium is not.
    uint density;
    vec3 upper;
    uint temperature; ///< Kelvin.
    ivec3 majorant_lower;
    uint majorants; ///< Texel at which the bounds start, four a texel, x fastest.
    ivec3 majorant_count;
    int majorant_size; ///< Voxels along the edge of a cell.
    uvec3 sigma_a; ///< rgbgrid: coefficients by channel, in place of density * sigma; else NONE.
    uint emission_scale;
    uvec3 sigma_s;
    float light_density; ///< Choice of this grid as a light, over VoxelLightRecord::total; 0: is
                         ///< none.
    uvec3 emission;
    uint pad1;
};
TYNDALL_CONSTANT uint GRID_TEXELS = 10u;
TYNDALL_CONSTANT uint GRID_LIGHT_DENSITY = 8u; // texel of light_density, its last word

/// A grid that emits, as a light. Its voxels are chosen in proportion to their emission.
struct VoxelLightRecord {
    AffineRecord render_from_index;
    ivec3 lower; ///< The voxel that EmittingVoxelRecord counts from.
    uint medium;
    uint voxels; ///< Texel of the first EmittingVoxelRecord.
    uint count;
    float total; ///< Mean over the channels of sigma_a Le, integrated over the volume.
    uint pad0;
};
TYNDALL_CONSTANT uint VOXEL_LIGHT_TEXELS = 5u;

/// One cell of the alias table of voxels, one texel.
struct EmittingVoxelRecord {
    uint xy; ///< x | y << 16
    uint z;
    float threshold; ///< Keep this voxel if the fraction of the draw is below, else take that of
                     ///< the cell ...
    uint alias;      ///< ... here.
};

/// Density exp(-h / scale_height), h above a plane or a sphere.
struct ExponentialRecord {
    AffineRecord medium_from_render;
    vec3 origin;  ///< A point of the plane, or the centre of the sphere.
    float radius; ///< sphere
    vec3 up;      ///< plane
    float scale_height;
};
TYNDALL_CONSTANT uint EXPONENTIAL_TEXELS = 5u;

// Emission of a black body: BLACKBODY_ENTRIES texels (logarithms of rgb, unused) at temperatures
// spaced evenly in the logarithm from BLACKBODY_MIN to BLACKBODY_MAX kelvin, linear in between (in
// blue at 500 K, where linear radiances are off by 2e-3, this is by 4e-5); nothing below.
TYNDALL_CONSTANT uint BLACKBODY_ENTRIES = 4096u;
TYNDALL_CONSTANT float BLACKBODY_MIN = 100.0f;
TYNDALL_CONSTANT float BLACKBODY_MAX = 1.0e6f;

TYNDALL_SHARED_END

#endif

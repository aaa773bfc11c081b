/// Media in files of OpenVDB and NanoVDB, from their parameters.
#pragma once

#include "scene/input_files.h"
#include "scene/parameters.h"
#include "scene/scene.h"

namespace tyndall {

/// The density of a "nanovdb" or "vdb" medium: "filename" (either kind of file for either type),
/// "gridname" (density), "temperaturename" (temperature; without this parameter the grid may be
/// missing), "Lescale" and what read_temperature reads; a "vdb" also takes "density" and
/// "temperature" for the names of the grids. Medium space is the world of the file. As in pbrt the
/// medium ends at the first active voxel and one beyond the last. After an error the medium stays
/// homogeneous.
void read_volume(Parameters& parameters, Medium& medium, bool is_vdb, InputFiles& files);

} // namespace tyndall

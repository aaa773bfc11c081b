/// Polygon files (PLY 1.0): ascii, binary little endian, binary big endian.
///
/// Source: Greg Turk, "The PLY Polygon File Format" (1994); names of properties as in pbrt-v4.
#pragma once

#include "scene/scene.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace tyndall {

struct PlyMesh {
    Mesh mesh;                     ///< Triangles, and quadrilaterals as patches.
    std::size_t ignored_faces = 0; ///< Faces with other than 3 or 4 vertices, which pbrt skips too.
};

/// Reads vertices (x y z, nx ny nz, and u v, s t, texture_u texture_v or texture_s texture_t) and
/// faces (list vertex_indices or vertex_index); everything else is skipped. Memory stays in
/// proportion to the bytes, whatever the header claims.
///
/// @param bytes      the file.
/// @param file_name  for messages.
/// @throws Error "file: where: what is wrong": no PLY file, cut off, a vertex that is not finite,
/// an
///               index out of range, no vertices or no faces.
PlyMesh read_ply(std::string_view bytes, const std::string& file_name);

} // namespace tyndall

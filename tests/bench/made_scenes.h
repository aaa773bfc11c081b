/// What the benchmarks make up: a mesh and voxels of any size.
#pragma once

#include "scene/scene.h"

#include <functional>

namespace tyndall::bench {

/// A ball with bumps, 2 n^2 triangles, within the cube from -1 to 1.
Mesh bumpy_ball(int n);

/// A cube of edge^3 voxels.
Grid make_field(int edge, const std::function<double(const glm::ivec3&)>& value);

} // namespace tyndall::bench

/// Nodes of hierarchies as the device reads them.
#pragma once

#include "render/bvh.h"

namespace tyndall {

/// The node of two children, with boxes that contain theirs. The device's distances to them, in
/// float32, are off by up to 2^-12 of a step of the boxes (intersect_node in
/// shaders/lib/intersect.glsl): so they are wider by 2^-10 at least, and no ray misses one. A step
/// along an axis is at most 1 / 168 of the edge around both, or 2^-21 of the coordinate, or 2^-100.
/// @param box0, box1  finite
/// Source: Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through
/// Compressed Wide BVHs" (boxes in bytes, in the frame of the node).
shared::NodeRecord pack_node(const Bounds& box0, std::uint32_t child0, const Bounds& box1,
                             std::uint32_t child1);

} // namespace tyndall

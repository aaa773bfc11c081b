/// Bounding volume hierarchies for the device: Embree builds, we pack.
#pragma once

#include "shared/records.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tyndall {

/// Axis-aligned box; lower <= upper.
struct Bounds {
    glm::vec3 lower{0};
    glm::vec3 upper{0};
};

/// Smallest float box that contains the double box.
Bounds round_outward(const glm::dvec3& lower, const glm::dvec3& upper);

/// A hierarchy over primitives 0 ... n-1. Child words are those of records.h, relative to `nodes`
/// and to `order`: a leaf's primitives are order[first] ... order[first + count - 1].
struct Bvh {
    std::uint32_t root = 0;
    std::vector<shared::NodeRecord> nodes;
    std::vector<std::uint32_t> order;
    Bounds bounds;
};

/// Builds a binary hierarchy by the surface area heuristic, no deeper than shared::BVH_DEPTH_MAX.
/// @param leaf_size      most primitives in a leaf, 1 ... LEAF_COUNT_MAX
/// @param one_leaf_size  so many or fewer primitives are one leaf and no tree, 0 ... LEAF_COUNT_MAX
/// Throws Error if Embree fails, or if there are more primitives than leaves can address.
Bvh build_bvh(std::span<const Bounds> primitives, std::uint32_t leaf_size,
              std::uint32_t one_leaf_size);

} // namespace tyndall

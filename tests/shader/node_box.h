/// Boxes of nodes as their definition in shaders/shared/records.h says, in double precision.
#pragma once

#include "shared/records.h"

#include <bit>

namespace tyndall::shader_test {

struct NodeBox {
    glm::dvec3 lower, upper, step;
};

inline NodeBox unpack_node(const shared::NodeRecord& node, int child) {
    const std::uint32_t origin[3]{node.origin_x, node.origin_y, node.origin_z};
    const std::uint32_t bytes[3]{node.box_x, node.box_y, node.box_z};
    NodeBox box;
    for (int axis = 0; axis < 3; ++axis) {
        const double start = std::bit_cast<float>(origin[axis]);
        const double width = std::bit_cast<float>(origin[axis] % 512 << 22);
        box.step[axis] = width / 256;
        box.lower[axis] = start + box.step[axis] * (bytes[axis] >> 16 * child & 255u);
        box.upper[axis] = start + box.step[axis] * (bytes[axis] >> (16 * child + 8) & 255u);
    }
    return box;
}

} // namespace tyndall::shader_test

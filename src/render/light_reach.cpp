#include "render/light_reach.h"

#include <glm/gtc/constants.hpp>

namespace tyndall {
namespace {

using namespace shared;

/// A patch, which need not be flat, is not taken to be dark in any direction.
constexpr float kPatchShare = 0.1f;

glm::vec3 column(const AffineRecord& m, int i) {
    return {m.row0[i], m.row1[i], m.row2[i]};
}

void set_quadric(LightRecord& light, const PrimitiveRecord& p, const QuadricRecord& q) {
    light.position = column(q.world_from_object, 3);
    light.complement_start = 1;
    if (p.kind_and_shape >> KIND_SHIFT == KIND_SPHERE) return;
    light.position += q.z_min * column(q.world_from_object, 2);
    light.axis = glm::normalize(p.offset * glm::vec3(q.object_from_world.row2));
    light.complement_start = 0;
}

} // namespace

void set_area_reach(LightRecord& light, const GeometryTables& geometry) {
    const PrimitiveRecord& p = geometry.primitives[light.primitive];
    const double sides = light.kind == LIGHT_AREA_TWO_SIDED ? 2 : 1;
    const std::uint32_t kind = p.kind_and_shape >> KIND_SHIFT;
    light.size2 = static_cast<float>(geometry.areas[light.primitive] / (4 * glm::pi<double>()));
    light.reach = static_cast<float>(1 / (sides * glm::pi<double>()));
    if (kind == KIND_TRIANGLE) {
        light.position = (p.a + p.b + p.c) / 3.0f;
        light.axis = p.normal;
    } else if (kind == KIND_PATCH) {
        const glm::vec3 along_u = p.b - p.a + p.normal - p.c, along_v = p.c - p.a + p.normal - p.b;
        light.position = (p.a + p.b + p.c + p.normal) / 4.0f;
        light.axis = glm::normalize(p.offset * glm::cross(along_u, along_v));
        light.complement_start = kPatchShare;
    } else {
        set_quadric(light, p, geometry.quadrics[p.extra]);
        // A ball is seen as a disk, a quarter of its surface.
        if (kind == KIND_SPHERE) light.reach /= 4;
    }
}

void set_voxel_reach(LightRecord& light, const VolumePacker::VoxelLight& voxels) {
    light.position = voxels.middle;
    light.size2 = voxels.size2;
    light.reach = static_cast<float>(1 / (4 * glm::pi<double>()));
}

} // namespace tyndall

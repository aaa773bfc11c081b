#include "scene/world_box.h"

namespace tyndall {
namespace {

/// The corners of a box that holds the quadric.
void add_quadric(const glm::dmat4& world_from_object, double radius, double z_min, double z_max,
                 WorldBox& box) {
    for (int corner = 0; corner < 8; ++corner)
        box.add(world_from_object * glm::dvec4(corner & 1 ? radius : -radius,
                                               corner & 2 ? radius : -radius,
                                               corner & 4 ? z_max : z_min, 1));
}

} // namespace

void WorldBox::add(const Shape& shape, const glm::dmat4& world_from_definition) {
    const glm::dmat4 m = world_from_definition * shape.world_from_object;
    if (const auto* mesh = std::get_if<Mesh>(&shape.geometry))
        for (const glm::vec3& p : mesh->positions)
            add(glm::dvec3(m * glm::dvec4(p, 1)));
    if (const auto* sphere = std::get_if<Sphere>(&shape.geometry))
        add_quadric(m, sphere->radius, sphere->z_min, sphere->z_max, *this);
    if (const auto* disk = std::get_if<Disk>(&shape.geometry))
        add_quadric(m, disk->radius, disk->height, disk->height, *this);
}

} // namespace tyndall

#include "scene/lit_ball.h"

#include <algorithm>

namespace tyndall {
namespace {

struct Box {
    glm::dvec3 lower{std::numeric_limits<double>::infinity()};
    glm::dvec3 upper{-std::numeric_limits<double>::infinity()};
    void add(const glm::dvec3& point) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
};

/// The corners of a box that holds the quadric, in the world.
void add_box(const glm::dmat4& world_from_object, double radius, double z_min, double z_max,
             Box& box) {
    for (int corner = 0; corner < 8; ++corner)
        box.add(world_from_object * glm::dvec4(corner & 1 ? radius : -radius,
                                               corner & 2 ? radius : -radius,
                                               corner & 4 ? z_max : z_min, 1));
}

void add_shape(const Shape& shape, const glm::dmat4& world_from_definition, Box& box) {
    const glm::dmat4 m = world_from_definition * shape.world_from_object;
    if (const auto* mesh = std::get_if<Mesh>(&shape.geometry))
        for (const glm::vec3& p : mesh->positions)
            box.add(m * glm::dvec4(p, 1));
    if (const auto* sphere = std::get_if<Sphere>(&shape.geometry))
        add_box(m, sphere->radius, sphere->z_min, sphere->z_max, box);
    if (const auto* disk = std::get_if<Disk>(&shape.geometry))
        add_box(m, disk->radius, disk->height, disk->height, box);
}

/// False for a light at infinity.
bool add_light(const Light& light, Box& box) {
    if (const auto* point = std::get_if<PointLight>(&light.emitter))
        box.add(point->position);
    else if (const auto* spot = std::get_if<SpotLight>(&light.emitter))
        box.add(spot->position);
    else
        return false;
    return true;
}

} // namespace

std::optional<Ball> find_lit_ball(const Scene& scene) {
    const bool emits = std::any_of(scene.media.begin(), scene.media.end(),
                                   [](const Medium& m) { return m.emission != Rgb(0); });
    const bool is_empty = scene.shapes.empty() && scene.instances.empty();
    if (scene.camera.medium < 0 || emits || is_empty) return std::nullopt;
    Box box;
    for (const Light& light : scene.lights)
        if (!add_light(light, box)) return std::nullopt;
    for (const Shape& shape : scene.shapes)
        add_shape(shape, glm::dmat4(1), box);
    for (const ObjectInstance& instance : scene.instances)
        for (const Shape& shape : scene.objects[instance.object].shapes)
            add_shape(shape, instance.world_from_definition, box);
    const double radius = 0.5 * glm::length(box.upper - box.lower);
    if (!(radius > 0) || radius == std::numeric_limits<double>::infinity()) return std::nullopt;
    return Ball{0.5 * (box.lower + box.upper), radius};
}

} // namespace tyndall

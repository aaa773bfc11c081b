#include "scene/lit_ball.h"

#include "scene/world_box.h"

#include <algorithm>

namespace tyndall {
namespace {

/// False for a light at infinity.
bool add_light(const Light& light, WorldBox& box) {
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
    WorldBox box;
    for (const Light& light : scene.lights)
        if (!add_light(light, box)) return std::nullopt;
    for (const Shape& shape : scene.shapes)
        box.add(shape, glm::dmat4(1));
    for (const ObjectInstance& instance : scene.instances)
        for (const Shape& shape : scene.objects[instance.object].shapes)
            box.add(shape, instance.world_from_definition);
    const double radius = 0.5 * glm::length(box.upper - box.lower);
    if (!(radius > 0) || radius == std::numeric_limits<double>::infinity()) return std::nullopt;
    return Ball{0.5 * (box.lower + box.upper), radius};
}

} // namespace tyndall

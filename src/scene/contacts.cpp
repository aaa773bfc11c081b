#include "scene/contacts.h"

#include "scene/world_box.h"

#include <algorithm>

namespace tyndall {
namespace {

struct Item {
    const Shape* shape;
    WorldBox box;
};

/// Boxes meet that are as close as vertices may be rounded to.
bool meet(const WorldBox& a, const WorldBox& b) {
    const glm::dvec3 size = glm::max(glm::max(glm::abs(a.lower), glm::abs(a.upper)),
                                     glm::max(glm::abs(b.lower), glm::abs(b.upper)));
    const glm::dvec3 margin = 1e-5 * size;
    return glm::all(glm::lessThanEqual(a.lower, b.upper + margin)) &&
           glm::all(glm::lessThanEqual(b.lower, a.upper + margin));
}

std::vector<Item> all_shapes(const Scene& scene) {
    std::vector<Item> items;
    const auto add = [&](const Shape& shape, const glm::dmat4& world_from_definition) {
        items.push_back({&shape, {}});
        items.back().box.add(shape, world_from_definition);
    };
    for (const Shape& shape : scene.shapes)
        add(shape, glm::dmat4(1));
    for (const ObjectInstance& instance : scene.instances)
        for (const Shape& shape : scene.objects[instance.object].shapes)
            add(shape, instance.world_from_definition);
    return items;
}

} // namespace

const Shape* find_contact(const Scene& scene) {
    const std::vector<Item> items = all_shapes(scene);
    for (const Item& item : items) {
        if (scene.materials[item.shape->material].kind != Material::Kind::interface) continue;
        if (std::any_of(items.begin(), items.end(), [&](const Item& other) {
                return &other != &item && meet(item.box, other.box);
            }))
            return item.shape;
    }
    return nullptr;
}

} // namespace tyndall

#include "render/box.h"
#include "render/effects.h"

namespace tyndall {

std::optional<Region> find_region(const Scene& scene) {
    if (scene.shapes.size() != 1 || !scene.instances.empty() || scene.camera.medium != -1 ||
        scene.integrator.kind != Integrator::Kind::volpath)
        return std::nullopt;
    const Shape& shape = scene.shapes[0];
    if (scene.materials[shape.material].kind != Material::Kind::interface ||
        !shape.media.is_transition() || shape.media.outside != -1)
        return std::nullopt;

    if (!scene.media[shape.media.inside].is_homogeneous()) return std::nullopt;

    Region region;
    region.medium = shape.media.inside;
    if (const auto* mesh = std::get_if<Mesh>(&shape.geometry)) {
        const std::optional<AxisBox> box = find_box(shape, *mesh, shape.world_from_object);
        if (!box || box->is_inward) return std::nullopt;
        region.geometry = shared::GEOMETRY_BOX;
        region.lower = box->lower;
        region.upper = box->upper;
        return region;
    }
    if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
        const bool inward = shape.reverse_orientation !=
                            (glm::determinant(glm::dmat3(shape.world_from_object)) < 0);
        if (!sphere->is_full() || inward) return std::nullopt;
        region.geometry = shared::GEOMETRY_ELLIPSOID;
        region.unit_from_world = glm::inverse(shape.world_from_object);
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row)
                region.unit_from_world[column][row] /= sphere->radius;
        return region;
    }
    return std::nullopt;
}

} // namespace tyndall

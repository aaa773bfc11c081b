// Instances are what copies would be.
#include "device/device_test.h"
#include "device/test_scenes.h"

#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::device_test {
namespace {

using namespace support;

/// Eight instances of one object: a ring, a ball, and a cube of a medium.
Scene instanced_scene() {
    Scene scene = busy_scene();
    const int paint = add_diffuse(scene, {0.7, 0.3, 0.2});
    ObjectDefinition object;
    object.shapes.push_back(make_shape(torus_mesh(12, 6, true),
                                       {.material = paint, .inside = 0, .outside = 0},
                                       scaling(glm::dvec3(0.3))));
    object.shapes.push_back(make_shape(full_sphere(0.15),
                                       {.material = paint, .inside = 0, .outside = 0},
                                       translation({0, 0, 0.2})));
    object.shapes.push_back(make_shape(box_mesh(glm::vec3(-0.2F), glm::vec3(0.2F)),
                                       {.inside = 1, .outside = 0}, translation({0.4, 0.4, 0})));
    scene.objects.push_back(object);
    for (int i = 0; i < 8; ++i) {
        const glm::dmat4 place = translation({-1.6 + 0.45 * i, 0.6 + 0.2 * (i % 3), -1 + 0.25 * i});
        const double mirror = i % 2 ? -1 : 1;
        scene.instances.push_back({0, glm::rotate(place, 0.9 * i, glm::dvec3(1, i, 2)) *
                                          scaling({mirror * (0.8 + 0.1 * i), 1, 0.9})});
    }
    return scene;
}

Scene flattened(Scene scene) {
    for (const ObjectInstance& instance : scene.instances)
        for (Shape shape : scene.objects[static_cast<std::size_t>(instance.object)].shapes) {
            shape.world_from_object = instance.world_from_definition * shape.world_from_object;
            scene.shapes.push_back(shape);
        }
    scene.instances.clear();
    scene.objects.clear();
    return scene;
}

class InstanceTest : public DeviceTest {};

TEST_F(InstanceTest, AreEqualToCopies) {
    const Scene scene = instanced_scene();
    const auto copies = device_batches(flattened(scene), 16);
    expect_agreement(device_batches(scene, 16), copies, scene.film.bounds.width());
    // Control: half of them are gone.
    Scene other = scene;
    other.instances.resize(4);
    EXPECT_FALSE(
        stats::test_agreement(device_batches(other, 16), copies, scene.film.bounds.width()).agrees);
}

TEST_F(InstanceTest, AgreeWithTheReference) {
    expect_agreement(instanced_scene(), 16);
}

TEST_F(InstanceTest, AreStoredOnce) {
    const Renderer instanced(context(), instanced_scene());
    Scene many = instanced_scene();
    for (int i = 0; i < 100; ++i)
        many.instances.push_back(many.instances[0]);
    const Renderer more(context(), many);
    const auto bytes = [](const Renderer& renderer) {
        std::uint64_t sum = 0;
        for (const auto& [name, size] : renderer.wavefront().memory())
            sum += size;
        return sum;
    };
    // A hundred more take records and nodes, 300 bytes each, but no triangle: the object has 156 of
    // them with 64 bytes and more.
    EXPECT_LT(bytes(more) - bytes(instanced), 100 * 1000);
    EXPECT_GT(bytes(more), bytes(instanced));
}

} // namespace
} // namespace tyndall::device_test

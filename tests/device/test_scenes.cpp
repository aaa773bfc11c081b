#include "device/test_scenes.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::device_test {

using namespace support;

Mesh torus_mesh(int rings, int sides, bool normals) {
    constexpr float tau = 6.28318530718F, thickness = 0.35F;
    Mesh mesh;
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < sides; ++j) {
            const float a = tau * static_cast<float>(i) / static_cast<float>(rings);
            const float b = tau * static_cast<float>(j) / static_cast<float>(sides);
            const glm::vec3 outward(std::cos(a), std::sin(a), 0);
            const glm::vec3 normal = std::cos(b) * outward + glm::vec3(0, 0, std::sin(b));
            mesh.positions.push_back(outward + thickness * normal);
            if (normals) mesh.normals.push_back(normal);
        }
    }
    const auto index = [&](int i, int j) {
        return static_cast<std::uint32_t>((i % rings) * sides + j % sides);
    };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sides; ++j) {
            mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
            mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
        }
    return mesh;
}

Scene dark_tube() {
    Scene scene = empty_scene(256);
    scene.camera.kind = Camera::Kind::perspective;
    scene.camera.fov = 140;
    scene.camera.screen_window_given = false;
    scene.camera.world_from_camera = look_at({1, 0.02, 0.01}, {1, 1, 0}, {0, 0, 1});
    add_infinite(scene);
    add_shape(scene, torus_mesh(24, 12), {.material = black});
    return scene;
}

Scene box_of_tosses(double thickness) {
    Scene scene = empty_scene(16, 0.1);
    scene.integrator.absorption = Integrator::Absorption::analog;
    add_shape(scene, box_mesh({-1, -1, 1}, {1, 1, 2}),
              {.inside = add_medium(scene, Rgb(thickness), Rgb(0))});
    add_infinite(scene);
    return scene;
}

Scene busy_scene() {
    Scene scene = empty_scene(16);
    scene.camera.kind = Camera::Kind::perspective;
    scene.camera.fov = 40;
    scene.camera.screen_window_given = false;
    scene.camera.screen_window = {-1, 1, -1, 1};
    scene.camera.world_from_camera = look_at({0.5, 1.5, -5}, {0, 0.7, 0}, {0, 1, 0});
    scene.integrator.max_depth = 30;
    const int fog = add_medium(scene, Rgb(0.02), Rgb(0.15), 0.4);
    const int cloud = add_medium(scene, {0.05, 0.2, 0.6}, {2, 1.5, 1}, 0.7);
    const int floor = add_diffuse(scene, {0.6, 0.5, 0.4});
    const int paint = add_diffuse(scene, {0.2, 0.5, 0.7});
    scene.camera.medium = -1;

    const glm::dmat4 lie_down = glm::rotate(glm::dmat4(1), -1.5707963, glm::dvec3(1, 0, 0));
    add_shape(scene, box_mesh({-3, -0.25, -3}, {3, 3, 3}), {.inside = fog});
    add_shape(scene, square_mesh(8, 0, 1), {.material = floor, .inside = fog, .outside = fog},
              lie_down);
    add_shape(scene, full_sphere(0.5), {.material = paint, .outside = fog},
              translation({-1, 0.5, 0.25}));
    add_shape(scene, torus_mesh(16, 8, true), {.material = floor, .outside = fog},
              translation({0.25, 1, 1.5}) * scaling(glm::dvec3(0.75)));
    add_shape(scene, full_sphere(0.75), {.inside = cloud, .outside = fog},
              translation({1, 0.8, -0.25}));
    add_shape(scene, square_mesh(0.5, 0, 1),
              {.material = black,
               .inside = fog,
               .outside = fog,
               .area_light = add_area_light(scene, {6, 6, 5})},
              translation({0, 2.75, 0}) * glm::inverse(lie_down));
    add_infinite(scene, {0.1, 0.12, 0.15});
    return scene;
}

Scene dark_scene() {
    Scene scene = busy_scene();
    scene.lights.clear();
    scene.shapes.pop_back(); // the area light
    scene.area_lights.clear();
    return scene;
}

Scene plain_scene() {
    Scene scene = empty_scene(16, 1.5);
    scene.camera.world_from_camera = look_at({1, 2, -4}, {0, 0, 0}, {0, 1, 0});
    scene.integrator.max_depth = 1000;
    add_infinite(scene, {1, 0.9, 0.8});
    add_shape(scene, box_mesh(glm::vec3(-1), glm::vec3(1)),
              {.inside = add_medium(scene, {0.1, 0.2, 0.3}, {2, 1.5, 1}, 0.5)});
    return scene;
}

Scene moved(Scene scene, const glm::dmat4& by) {
    const glm::dmat3 turn(by);
    scene.camera.world_from_camera = by * scene.camera.world_from_camera;
    for (Shape& shape : scene.shapes)
        shape.world_from_object = by * shape.world_from_object;
    for (ObjectInstance& instance : scene.instances)
        instance.world_from_definition = by * instance.world_from_definition;
    for (Light& light : scene.lights) {
        if (auto* distant = std::get_if<DistantLight>(&light.emitter))
            distant->direction = glm::normalize(turn * distant->direction);
        if (auto* point = std::get_if<PointLight>(&light.emitter))
            point->position = glm::dvec3(by * glm::dvec4(point->position, 1));
        if (auto* spot = std::get_if<SpotLight>(&light.emitter)) {
            spot->position = glm::dvec3(by * glm::dvec4(spot->position, 1));
            spot->axis = glm::normalize(turn * spot->axis);
        }
    }
    return scene;
}

Scene scaled(Scene scene, double factor) {
    const glm::dmat4 camera = scene.camera.world_from_camera;
    scene = moved(scene, scaling(glm::dvec3(factor)));
    scene.camera.world_from_camera = camera;
    scene.camera.world_from_camera[3] =
        glm::dvec4(factor * glm::dvec3(camera[3]), 1); // turned as before, not stretched
    scene.camera.lens_radius *= factor;
    scene.camera.focal_distance *= factor;
    if (scene.camera.kind == Camera::Kind::orthographic)
        for (double& edge : scene.camera.screen_window)
            edge *= factor;
    for (Medium& medium : scene.media) {
        medium.sigma_a /= factor;
        medium.sigma_s /= factor;
    }
    for (Light& light : scene.lights) {
        if (auto* point = std::get_if<PointLight>(&light.emitter))
            point->intensity *= factor * factor;
        if (auto* spot = std::get_if<SpotLight>(&light.emitter)) spot->intensity *= factor * factor;
    }
    return scene;
}

} // namespace tyndall::device_test

#include "scene/by_hand.h"

#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::by_hand {

Scene empty_scene(int pixels_across, double half) {
    Scene scene;
    scene.camera.kind = Camera::Kind::orthographic;
    scene.camera.screen_window = {-half, half, -half, half};
    scene.camera.screen_window_given = true;
    scene.film.width = scene.film.height = pixels_across;
    scene.film.bounds = {0, pixels_across, 0, pixels_across};
    scene.filter.kind = PixelFilter::Kind::box;
    scene.filter.x_radius = scene.filter.y_radius = 0.5;
    scene.integrator.max_depth = 100000;
    scene.materials.push_back({Material::Kind::diffuse, Rgb(0), {}});
    scene.materials.push_back({Material::Kind::interface, Rgb(0), {}});
    return scene;
}

glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
    const glm::dvec3 forward = glm::normalize(target - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::normalize(up), forward));
    return {glm::dvec4(right, 0), glm::dvec4(glm::cross(forward, right), 0), glm::dvec4(forward, 0),
            glm::dvec4(eye, 1)};
}

void trace_pixel_centers(Scene& scene) {
    scene.filter.x_radius = scene.filter.y_radius = 1e-13;
}

int add_medium(Scene& scene, const Rgb& sigma_a, const Rgb& sigma_s, double g) {
    Medium medium;
    medium.sigma_a = sigma_a;
    medium.sigma_s = sigma_s;
    medium.phases.front().g = g;
    scene.media.push_back(medium);
    return static_cast<int>(scene.media.size()) - 1;
}

int add_diffuse(Scene& scene, const Rgb& reflectance) {
    scene.materials.push_back({Material::Kind::diffuse, reflectance, {}});
    return static_cast<int>(scene.materials.size()) - 1;
}

int add_area_light(Scene& scene, const Rgb& radiance, bool two_sided) {
    scene.area_lights.push_back({radiance, Rgb(0), two_sided});
    return static_cast<int>(scene.area_lights.size()) - 1;
}

void add_light(Scene& scene,
               const std::variant<InfiniteLight, DistantLight, PointLight, SpotLight>& light) {
    scene.lights.push_back({light, {}});
}

void add_infinite(Scene& scene, const Rgb& radiance) {
    add_light(scene, InfiniteLight{radiance});
}

Shape make_shape(const std::variant<Mesh, Sphere, Disk>& geometry, const Finish& finish,
                 const glm::dmat4& world_from_object) {
    Shape shape;
    shape.geometry = geometry;
    shape.world_from_object = world_from_object;
    shape.reverse_orientation = finish.reverse;
    shape.material = finish.material;
    shape.media = {finish.inside, finish.outside};
    shape.area_light = finish.area_light;
    return shape;
}

void add_shape(Scene& scene, const std::variant<Mesh, Sphere, Disk>& geometry, const Finish& finish,
               const glm::dmat4& world_from_object) {
    scene.shapes.push_back(make_shape(geometry, finish, world_from_object));
}

Mesh box_mesh(const glm::vec3& lower, const glm::vec3& upper) {
    Mesh mesh;
    for (int corner = 0; corner < 8; ++corner)
        mesh.positions.emplace_back(corner & 1 ? upper.x : lower.x, corner & 2 ? upper.y : lower.y,
                                    corner & 4 ? upper.z : lower.z);
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

Mesh square_mesh(float half, float z, float sign) {
    Mesh mesh;
    mesh.positions = {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    if (sign < 0) mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
    return mesh;
}

Sphere full_sphere(double radius) {
    Sphere sphere;
    sphere.radius = radius;
    sphere.z_min = -radius;
    sphere.z_max = radius;
    return sphere;
}

void add_slab(Scene& scene, int medium, double z0, double z1, double half_width) {
    const float half = static_cast<float>(half_width);
    add_shape(scene, square_mesh(half, static_cast<float>(z0), -1), {.inside = medium});
    add_shape(scene, square_mesh(half, static_cast<float>(z1), 1), {.inside = medium});
}

glm::dmat4 translation(const glm::dvec3& offset) {
    return glm::translate(glm::dmat4(1), offset);
}

glm::dmat4 scaling(const glm::dvec3& factors) {
    return glm::scale(glm::dmat4(1), factors);
}

} // namespace tyndall::by_hand

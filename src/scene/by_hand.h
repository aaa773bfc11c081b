/// Scenes by hand, without a file: each function adds one thing. For the selftest, and for tests.
#pragma once

#include "scene/scene.h"

namespace tyndall::by_hand {

/// No light, no shape; orthographic camera at the origin that looks along +z at the square
/// [-half, half]^2, box filter, volpath with a high depth, diffuse black (0) and interface (1)
/// materials.
Scene empty_scene(int pixels_across, double half = 1);

/// Camera to world of a camera at eye that looks at a point, as pbrt's LookAt.
glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up);

/// Film and filter such that every ray goes through the centre of its pixel.
void trace_pixel_centers(Scene& scene);

inline constexpr int black = 0;
inline constexpr int interface = 1;

int add_medium(Scene& scene, const Rgb& sigma_a, const Rgb& sigma_s, double g = 0);
int add_diffuse(Scene& scene, const Rgb& reflectance);
int add_area_light(Scene& scene, const Rgb& radiance, bool two_sided = false);
void add_infinite(Scene& scene, const Rgb& radiance = Rgb(1));
void add_light(Scene& scene,
               const std::variant<InfiniteLight, DistantLight, PointLight, SpotLight>&);

/// What surrounds a shape, and what it is made of.
struct Finish {
    int material = interface;
    int inside = -1;
    int outside = -1;
    int area_light = -1;
    bool reverse = false;
};
Shape make_shape(const std::variant<Mesh, Sphere, Disk>& geometry, const Finish& finish,
                 const glm::dmat4& world_from_object = glm::dmat4(1));
void add_shape(Scene& scene, const std::variant<Mesh, Sphere, Disk>& geometry, const Finish& finish,
               const glm::dmat4& world_from_object = glm::dmat4(1));

/// Twelve triangles, normals outward.
Mesh box_mesh(const glm::vec3& lower, const glm::vec3& upper);
/// The rectangle [-half, half]^2 at height z; its normal is sign * z.
Mesh square_mesh(float half, float z, float sign);
Sphere full_sphere(double radius);

/// Two wide interfaces at z0 < z1 with the medium between them.
void add_slab(Scene& scene, int medium, double z0, double z1, double half_width = 1e6);

glm::dmat4 translation(const glm::dvec3& offset);
glm::dmat4 scaling(const glm::dvec3& factors);

} // namespace tyndall::by_hand

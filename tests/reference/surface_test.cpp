// Single surfaces: cuts, areas, normals, and rays that leave and come back.
#include "reference/geometry.h"
#include "support/scenes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <random>

namespace tyndall::reference {
namespace {

using support::make_shape;
using support::scaling;
using support::translation;

constexpr double infinity = std::numeric_limits<double>::infinity();

Sphere cut_sphere() {
    Sphere sphere = support::full_sphere(1.5);
    sphere.z_min = -0.7;
    sphere.z_max = 1.2;
    sphere.phi_max = 4;
    return sphere;
}

Disk cut_disk() {
    Disk disk;
    disk.height = 0.4;
    disk.radius = 1.3;
    disk.inner_radius = 0.5;
    disk.phi_max = 5;
    return disk;
}

Mesh twisted_patch() {
    Mesh mesh;
    mesh.positions = {{-1, -1, 0.5f}, {1.2f, -0.8f, -0.6f}, {-0.9f, 1, -0.4f}, {1, 1.1f, 0.9f}};
    mesh.patches = {{0, 1, 2, 3}};
    return mesh;
}

/// Rotated, moved and distorted.
glm::dmat4 skewed_placement() {
    return translation({0.3, -0.2, 0.5}) * glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(1, 2, 3)) *
           scaling({1.3, 0.8, 1});
}

/// The surface by its own sampling map, as many small triangles.
Mesh tessellate(const Surface& surface, int n) {
    Mesh mesh;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) {
            const Parameters where =
                surface.sample(0, static_cast<double>(i) / n, static_cast<double>(j) / n);
            mesh.positions.emplace_back(surface.point(0, where).position);
        }
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
        for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(n); ++j) {
            const std::uint32_t row = static_cast<std::uint32_t>(n) + 1, a = i * row + j;
            mesh.triangles.push_back({a, a + 1, a + row});
            mesh.triangles.push_back({a + 1, a + row + 1, a + row});
        }
    }
    return mesh;
}

Ray random_ray(std::mt19937_64& engine, double extent) {
    std::uniform_real_distribution<> uniform(-extent, extent);
    const dvec3 from(uniform(engine), uniform(engine), uniform(engine));
    const dvec3 to(uniform(engine), uniform(engine), uniform(engine));
    return {from, glm::normalize(to - from)};
}

double nearest_t(const Surface& surface, const Ray& ray) {
    double t = infinity;
    for (std::uint32_t p = 0; p < surface.primitive_count(); ++p)
        if (const auto hit = surface.intersect(p, ray, t)) t = hit->t;
    return t;
}

/// A shape against the fine tessellation of a shape: the share of random rays that tell them apart.
double disagreement(const Shape& shape, const Shape& tessellated, const glm::dmat4& place) {
    constexpr int rays = 20000, cells = 200;
    const Surface surface(shape, place);
    Scene scene = support::empty_scene(1);
    scene.shapes = {make_shape(tessellate(Surface(tessellated, place), cells), {})};
    const Geometry geometry(scene, dvec3(0));
    std::mt19937_64 engine(5);
    int different = 0;
    for (int i = 0; i < rays; ++i) {
        const Ray ray = random_ray(engine, 2);
        const double expected = nearest_t(surface, ray);
        const auto hit = geometry.intersect(ray, infinity);
        const double t = hit ? hit->t : infinity;
        different += !(t == expected || std::abs(t - expected) < 0.01);
    }
    return static_cast<double>(different) / rays;
}

/// Only rays at edges and at grazing angles may differ.
TEST(Surface, CurvedShapesMatchTheirTessellation) {
    for (const auto& geometry : std::vector<std::variant<Mesh, Sphere, Disk>>{
             support::full_sphere(1.2), cut_sphere(), cut_disk(), twisted_patch()}) {
        for (const glm::dmat4& place : {glm::dmat4(1), skewed_placement()}) {
            const Shape shape = make_shape(geometry, {});
            EXPECT_LT(disagreement(shape, shape, place), 0.003);
        }
    }
}

TEST(Surface, TessellationsTellCutsApart) {
    const Shape right = make_shape(cut_sphere(), {});
    Sphere wrong_phi = cut_sphere(), wrong_z = cut_sphere();
    wrong_phi.phi_max = 4.1;
    wrong_z.z_max = 1.25;
    EXPECT_GT(disagreement(make_shape(wrong_phi, {}), right, glm::dmat4(1)), 0.003);
    EXPECT_GT(disagreement(make_shape(wrong_z, {}), right, glm::dmat4(1)), 0.003);
}

TEST(Surface, PlanarPatchEqualsTwoTriangles) {
    Mesh patch, triangles;
    patch.positions =
        triangles.positions = {{-1, -1, 0.2f}, {1, -1, 0.4f}, {-1, 1, 0.2f}, {1, 1, 0.4f}};
    patch.patches = {{0, 1, 2, 3}};
    triangles.triangles = {{0, 1, 2}, {1, 3, 2}};
    const Shape shape_a = make_shape(patch, {}), shape_b = make_shape(triangles, {});
    const Surface a(shape_a, glm::dmat4(1)), b(shape_b, glm::dmat4(1));
    std::mt19937_64 engine(6);
    for (int i = 0; i < 20000; ++i) {
        const Ray ray = random_ray(engine, 2);
        const double ta = nearest_t(a, ray), tb = nearest_t(b, ray);
        EXPECT_TRUE(ta == tb || std::abs(ta - tb) < 1e-13 * (1 + ta)) << ta << ' ' << tb;
    }
    EXPECT_NEAR(a.area(0), b.area(0) + b.area(1), 1e-14);
    EXPECT_NEAR(glm::dot(a.point(0, {0.3, 0.4, 0}).normal, b.point(0, {0.3, 0.4, 0}).normal), 1,
                1e-14);
}

TEST(Surface, AreasMatchClosedForms) {
    const auto area = [](const std::variant<Mesh, Sphere, Disk>& geometry,
                         const glm::dmat4& place) {
        const Shape shape = make_shape(geometry, {});
        return Surface(shape, place).area(0);
    };
    const glm::dmat4 doubled = scaling({2, 2, 2});
    EXPECT_NEAR(area(support::full_sphere(1.5), doubled), 4 * pi * 9, 1e-11);
    EXPECT_NEAR(area(cut_sphere(), glm::dmat4(1)), 4 * 1.9 * 1.5, 1e-12);
    EXPECT_NEAR(area(cut_disk(), doubled), 4 * 2.5 * (1.69 - 0.25), 1e-12);
    // Prolate spheroid, semi-axes 1, 1, 2: 2 pi (1 + 2 asin(e) / e), e = sqrt(3) / 2.
    const double e = std::sqrt(3.0) / 2;
    EXPECT_NEAR(area(support::full_sphere(1), scaling({1, 1, 2})),
                2 * pi * (1 + 2 * std::asin(e) / e), 1e-3);
}

TEST(Surface, NormalsFollowTheRules) {
    Mesh triangle;
    triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle.triangles = {{0, 1, 2}};
    Mesh smooth = triangle;
    smooth.normals = {{0, 0, -2}, {0, 0, -2}, {1, 0, -2}};
    const auto normal_z = [](const std::variant<Mesh, Sphere, Disk>& geometry, bool reverse,
                             const glm::dmat4& place, const Parameters& where) {
        const Shape shape = make_shape(geometry, {.reverse = reverse});
        return Surface(shape, place).point(0, where).normal.z;
    };
    const glm::dmat4 same(1), mirrored = scaling({-1, 1, 1});
    const dvec3 middle(0.3, 0.3, 0), pole(0, 0, 1);
    EXPECT_EQ(normal_z(triangle, false, same, middle), 1);
    EXPECT_EQ(normal_z(triangle, true, same, middle), -1);
    EXPECT_EQ(normal_z(triangle, false, mirrored, middle), 1); // Carried, not recomputed.
    EXPECT_EQ(normal_z(smooth, false, same, middle), -1);
    EXPECT_EQ(normal_z(smooth, true, same, middle), 1);
    EXPECT_EQ(normal_z(support::full_sphere(1), false, same, pole), 1);
    EXPECT_EQ(normal_z(support::full_sphere(1), true, same, pole), -1);
    EXPECT_EQ(normal_z(support::full_sphere(1), false, mirrored, pole),
              -1); // pbrt's rule for quadrics.
    EXPECT_EQ(normal_z(Disk{}, false, same, {0.5, 0, 0}), 1);
    EXPECT_EQ(normal_z(Disk{}, true, same, {0.5, 0, 0}), -1);
    const Shape shape = make_shape(smooth, {});
    const dvec3 shading = Surface(shape, same).point(0, {0, 0.5, 0}).shading_normal;
    EXPECT_NEAR(shading.x, 0.5 / std::sqrt(4.25), 1e-15);
}

} // namespace
} // namespace tyndall::reference

// Whole scenes of surfaces: nothing is missed, nothing is hit twice, instances equal their copies.
#include "reference/geometry.h"
#include "support/scenes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <random>

namespace tyndall::reference {
namespace {

using support::scaling;
using support::translation;

constexpr double infinity = std::numeric_limits<double>::infinity();

dvec3 random_point(std::mt19937_64& engine, double extent) {
    std::uniform_real_distribution<> uniform(-extent, extent);
    return {uniform(engine), uniform(engine), uniform(engine)};
}

dvec3 random_direction(std::mt19937_64& engine) {
    std::normal_distribution<> normal;
    return glm::normalize(dvec3(normal(engine), normal(engine), normal(engine)));
}

/// Small shapes of all kinds in a wide space, as shapes and in instances.
Scene crowd(double scale, const dvec3& offset) {
    std::mt19937_64 engine(3);
    Scene scene = support::empty_scene(1);
    const glm::dmat4 place = translation(offset) * scaling(dvec3(scale));
    scene.objects.resize(1);
    for (int i = 0; i < 200; ++i) {
        const glm::dmat4 at = translation(random_point(engine, 10)) *
                              glm::rotate(glm::dmat4(1), 1.0 * i, random_direction(engine)) *
                              scaling({0.2, 0.3, 0.1});
        std::variant<Mesh, Sphere, Disk> geometry = support::box_mesh({-1, -1, -1}, {1, 1, 1});
        if (i % 3 == 1) geometry = support::full_sphere(1);
        if (i % 3 == 2) geometry = Disk{};
        if (i % 2)
            support::add_shape(scene, geometry, {}, place * at);
        else
            scene.objects[0].shapes.push_back(support::make_shape(geometry, {}, at));
    }
    scene.instances.push_back({0, place * translation({0, 0, 12})});
    scene.instances.push_back({0, place * scaling({-1, 2, 1})});
    return scene;
}

/// The same with every instance as shapes of its own.
Scene flattened(const Scene& scene) {
    Scene flat = scene;
    flat.instances.clear();
    for (const ObjectInstance& instance : scene.instances)
        for (Shape shape : scene.objects[static_cast<std::size_t>(instance.object)].shapes) {
            shape.world_from_object = instance.world_from_definition * shape.world_from_object;
            flat.shapes.push_back(shape);
        }
    return flat;
}

double nearest_by_force(const std::vector<Surface>& surfaces, const Ray& ray) {
    double t = infinity;
    for (const Surface& surface : surfaces)
        for (std::uint32_t p = 0; p < surface.primitive_count(); ++p)
            if (const auto hit = surface.intersect(p, ray, t)) t = hit->t;
    return t;
}

TEST(Geometry, FindsWhatTryingAllSurfacesFinds) {
    for (const double scale : {1e-4, 1.0, 1e6}) {
        const dvec3 offset = scale * dvec3(50, -1000, 3000);
        const Scene scene = crowd(scale, offset);
        const Scene flat_scene = flattened(scene);
        const Geometry geometry(scene, dvec3(0)), flat(flat_scene, dvec3(0));
        std::mt19937_64 engine(4);
        int hits = 0;
        for (int i = 0; i < 3000; ++i) {
            const dvec3 origin = offset + scale * random_point(engine, 30);
            const dvec3 target = offset + scale * random_point(engine, 10);
            const Ray ray{origin, glm::normalize(target - origin)};
            const double expected = nearest_by_force(flat.surfaces(), ray);
            const auto hit = geometry.intersect(ray, infinity);
            ASSERT_EQ(hit.has_value(), expected < infinity);
            if (!hit) continue;
            ++hits;
            EXPECT_NEAR(hit->t, expected, 1e-9 * glm::length(offset));
            const auto flat_hit = flat.intersect(ray, infinity);
            EXPECT_NEAR(std::abs(glm::dot(hit->point.normal, flat_hit->point.normal)), 1, 1e-5);
            EXPECT_FALSE(geometry.intersect(ray, hit->t * (1 - 1e-9)).has_value());
        }
        EXPECT_GT(hits, 200);
    }
}

/// From inside a closed mesh, aimed exactly at its vertices and edges.
TEST(Geometry, ClosedMeshesDoNotLeak) {
    Scene scene = support::empty_scene(1);
    const Mesh box = support::box_mesh({-1.1f, -0.3f, -2.7f}, {0.7f, 1.9f, 3.1f});
    support::add_shape(scene, box, {}, glm::rotate(glm::dmat4(1), 0.4, dvec3(1, 1, 0)));
    const Geometry geometry(scene, dvec3(0));
    const Surface& surface = geometry.surfaces()[0];
    std::mt19937_64 engine(8);
    std::uniform_real_distribution<> uniform(0, 1);
    for (int i = 0; i < 100000; ++i) {
        const auto primitive = static_cast<std::uint32_t>(i % 12);
        const double along = i % 7 == 0 ? 1 : uniform(engine);
        const dvec3 edge = surface.point(primitive, {along, 1 - along, 0}).position;
        const dvec3 origin = random_point(engine, 0.2);
        EXPECT_TRUE(
            geometry.intersect({origin, glm::normalize(edge - origin)}, infinity).has_value());
    }
}

/// A ray that bounces inside of closed shapes for a long time never gets out, nor stuck.
void bounce_inside(const Scene& scene, const dvec3& start, int bounces) {
    const Geometry geometry(scene, dvec3(0));
    const Bounds& bounds = geometry.bounds();
    const double slack = 1e-12 * (glm::length(bounds.lower) + glm::length(bounds.upper));
    std::mt19937_64 engine(9);
    Ray ray{start, random_direction(engine)};
    for (int i = 0; i < bounces; ++i) {
        const auto hit = geometry.intersect(ray, infinity);
        ASSERT_TRUE(hit.has_value()) << "left after " << i;
        const dvec3& p = hit->point.position;
        ASSERT_TRUE(glm::all(glm::greaterThanEqual(p, bounds.lower - slack)) &&
                    glm::all(glm::lessThanEqual(p, bounds.upper + slack)));
        // Half of the directions graze the surface.
        dvec3 d = random_direction(engine);
        if (i % 2) d -= (1 - 1e-6) * glm::dot(d, hit->point.normal) * hit->point.normal;
        if (glm::dot(d, hit->point.normal) > 0)
            d -= 2 * glm::dot(d, hit->point.normal) * hit->point.normal;
        d = glm::normalize(d);
        ray = {leave(hit->point, d), d};
    }
}

TEST(Geometry, RaysNeitherLeaveNorStick) {
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1), 0.4, dvec3(1, 2, 0));
    for (const glm::dmat4& place :
         {glm::dmat4(1), turned,
          translation({1e3, 2e3, 3e3}) * turned * scaling({1e-4, 1e-4, 2e-4})}) {
        Scene box = support::empty_scene(1), ball = box, thin = box, instance = box;
        support::add_shape(box, support::box_mesh({-1, -1, -1}, {1, 1, 1}), {}, place);
        support::add_shape(ball, support::full_sphere(1), {}, place);
        support::add_shape(thin, support::box_mesh({-1e4f, -1e4f, -0.5f}, {1e4f, 1e4f, 0.5f}), {},
                           place);
        instance.objects.push_back(
            {"", {support::make_shape(support::full_sphere(1), {}, turned)}});
        instance.instances.push_back({0, place});
        for (const Scene& scene : {box, ball, thin, instance})
            bounce_inside(scene, dvec3(place[3]), 30000);
    }
}

TEST(Geometry, EmptyScenesHaveNoHits) {
    const Scene scene = support::empty_scene(1);
    const Geometry geometry(scene, dvec3(0));
    EXPECT_FALSE(geometry.intersect({dvec3(0), dvec3(0, 0, 1)}, infinity).has_value());
    EXPECT_TRUE(geometry.bounds().empty());
}

} // namespace
} // namespace tyndall::reference

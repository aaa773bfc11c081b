// What must not change the picture: repetition, splitting, cropping, scale, place, instancing.
#include "support/estimates.h"
#include "support/scenes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace tyndall::reference {
namespace {

using support::add_medium;
using support::add_shape;
using support::empty_scene;
using support::Finish;
using support::scaling;
using support::translation;

/// A bit of everything: lights of all kinds, nested chromatic media, diffuse shapes; moved and
/// scaled as a whole.
Scene full_scene(double scale, const glm::dvec3& offset) {
    Scene scene = empty_scene(12);
    const glm::dmat4 place = translation(offset) * scaling(glm::dvec3(scale));
    scene.camera.kind = Camera::Kind::perspective;
    scene.camera.fov = 40;
    scene.camera.lens_radius = 0.05 * scale;
    scene.camera.focal_distance = 5 * scale;
    scene.camera.world_from_camera =
        translation(offset) *
        support::look_at(glm::dvec3(0, 1, -1) * scale, glm::dvec3(0, 0, 5) * scale, {0, 1, 0});
    const int fog =
        add_medium(scene, Rgb(0.02, 0.05, 0.1) / scale, Rgb(0.2, 0.4, 0.8) / scale, 0.6);
    const int core = add_medium(scene, Rgb(0.5) / scale, Rgb(2, 1, 3) / scale, -0.3);
    scene.media[0].emission = Rgb(0.1);
    scene.camera.medium = fog;
    const int grey = support::add_diffuse(scene, Rgb(0.6, 0.5, 0.4));
    const Finish floor{.material = grey, .inside = fog, .outside = fog};
    add_shape(scene, support::full_sphere(30), {.inside = fog}, place);
    add_shape(scene, support::square_mesh(8, 0, 1), floor,
              place * translation({0, -1, 5}) *
                  glm::rotate(glm::dmat4(1), -1.5707963, glm::dvec3(1, 0, 0)));
    add_shape(scene, support::full_sphere(0.8), {.inside = core, .outside = fog},
              place * translation({-0.5, 0, 5}));
    add_shape(scene, support::box_mesh({-1, -1, -1}, {1, 1, 1}), floor,
              place * translation({1, 0, 6}) * scaling({0.5, 0.7, 0.5}));
    add_shape(scene, support::full_sphere(0.3),
              {.material = grey,
               .inside = fog,
               .outside = fog,
               .area_light = support::add_area_light(scene, Rgb(5))},
              place * translation({0.5, 1.5, 4}));
    support::add_light(scene,
                       PointLight{Rgb(3) * scale * scale, offset + scale * glm::dvec3(-2, 2, 4)});
    support::add_light(scene, DistantLight{Rgb(0.5), glm::normalize(glm::dvec3(1, -2, 1))});
    support::add_infinite(scene, Rgb(0.3, 0.4, 0.5));
    scene.integrator.max_depth = 20;
    return scene;
}

void expect_near(const std::vector<Rgb>& a, const std::vector<Rgb>& b, double tolerance) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(a[i][c], b[i][c], tolerance * a[i][c]) << i;
}

TEST(Invariance, RepetitionIsBitEqual) {
    const Scene scene = full_scene(1, glm::dvec3(0));
    ReferenceRenderer renderer(scene);
    const PixelSums first = renderer.render(3, 8);
    EXPECT_EQ(first, renderer.render(3, 8));
    EXPECT_EQ(first, ReferenceRenderer(scene).render(3, 8));
    EXPECT_NE(first, renderer.render(4, 8));
    Scene other = scene;
    other.seed = std::uint64_t{1} << 40;
    EXPECT_NE(first, ReferenceRenderer(other).render(3, 8));
    EXPECT_TRUE(renderer.health().is_good());
}

TEST(Invariance, RangesOfSamplesAddUp) {
    const Scene scene = full_scene(1, glm::dvec3(0));
    ReferenceRenderer renderer(scene);
    const PixelSums all = renderer.render(0, 8), head = renderer.render(0, 3),
                    tail = renderer.render(3, 5);
    for (std::size_t i = 0; i < all.size(); ++i)
        for (int c = 0; c < 4; ++c)
            EXPECT_NEAR(all[i][c], head[i][c] + tail[i][c], 1e-13 * all[i][c]);
}

TEST(Invariance, ACropIsAPartOfTheWhole) {
    Scene scene = full_scene(1, glm::dvec3(0));
    const PixelSums whole = ReferenceRenderer(scene).render(0, 4);
    scene.film.bounds = {3, 10, 5, 7};
    const PixelSums crop = ReferenceRenderer(scene).render(0, 4);
    ASSERT_EQ(crop.size(), 14u);
    for (std::size_t y = 0; y < 2; ++y)
        for (std::size_t x = 0; x < 7; ++x)
            EXPECT_EQ(crop[y * 7 + x], whole[(y + 5) * 12 + x + 3]);
}

TEST(Invariance, ScaleAndPlaceDoNotMatter) {
    const auto expected = support::render(full_scene(1, glm::dvec3(0)), 16);
    expect_near(expected, support::render(full_scene(1e-4, glm::dvec3(0)), 16), 1e-7);
    expect_near(expected, support::render(full_scene(1e6, glm::dvec3(0)), 16), 1e-7);
    expect_near(expected, support::render(full_scene(1, {1e4, -2e4, 1e4}), 16), 1e-5);
}

TEST(Invariance, InstancesEqualCopies) {
    Scene copies = full_scene(1, glm::dvec3(0)), instances = copies;
    const Mesh box = support::box_mesh({-1, -1, -1}, {1, 1, 1});
    const Finish finish{.material = 2, .inside = 0, .outside = 0}, cloud{.inside = 1, .outside = 0};
    const glm::dmat4 inner = translation({1, 0, 0}) * scaling({0.3, 0.4, 0.5});
    instances.objects.push_back({"pair",
                                 {support::make_shape(box, finish, inner),
                                  support::make_shape(support::full_sphere(0.5), cloud)}});
    for (const glm::dmat4& place :
         {translation({-1, 0, 4}), translation({1, 1, 7}) *
                                       glm::rotate(glm::dmat4(1), 0.5, glm::dvec3(1, 2, 3)) *
                                       scaling({1, -1.2, 0.7})}) {
        instances.instances.push_back({0, place});
        add_shape(copies, box, finish, place * inner);
        // pbrt flips quadrics under a mirror in their own transform, but not in that of an
        // instance.
        Finish turned = cloud;
        turned.reverse = glm::determinant(glm::dmat3(place)) < 0;
        add_shape(copies, support::full_sphere(0.5), turned, place);
    }
    const auto expected = support::render(copies, 16);
    expect_near(expected, support::render(instances, 16), 1e-6);
    EXPECT_NE(expected, support::render(full_scene(1, glm::dvec3(0)), 16));
}

TEST(Film, ImagingRatioComesBeforeTheClamp) {
    Scene scene = empty_scene(2);
    support::add_infinite(scene, {1, 2, 4});
    scene.film.iso = 50;
    scene.camera.shutter_seconds = 3;
    for (const Rgb& color : support::render(scene, 2))
        EXPECT_EQ(color, Rgb(1.5, 3, 6));
    scene.film.max_component_value = 3;
    for (const Rgb& color : support::render(scene, 2))
        EXPECT_EQ(color, Rgb(0.75, 1.5, 3));
}

TEST(Progress, IsReportedAndCanStop) {
    const Scene scene = full_scene(1, glm::dvec3(0));
    ReferenceRenderer renderer(scene);
    double last = 0;
    const PixelSums all = renderer.render(0, 1, [&](double share) {
        EXPECT_GE(share, last);
        EXPECT_LE(share, 1);
        last = share;
        return true;
    });
    EXPECT_EQ(all.size(), 144u);
    EXPECT_GT(last, 0);
    EXPECT_TRUE(renderer.render(0, 1, [](double) { return false; }).empty());
}

} // namespace
} // namespace tyndall::reference

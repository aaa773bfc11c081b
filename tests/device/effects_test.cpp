// A scene pays only for what it calls for: stages that are recorded, and effects as they are told.
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "scene/reader.h"
#include "support/materials.h"

#include <array>
#include <set>

namespace tyndall::device_test {
namespace {

using namespace support;

std::set<std::string> stages_of(const Scene& scene) {
    const Renderer renderer(context(), scene);
    std::set<std::string> names;
    for (const StageKind* stage : renderer.wavefront().stages())
        names.insert(stage->name);
    return names;
}

bool has_stage(const Scene& scene, const std::string& name) {
    return stages_of(scene).count(name) > 0;
}

std::string effect(const Scene& scene, const std::string& name) {
    for (const Effect& e : compute_effects(scene).list)
        if (e.name == name) return e.value;
    return "is not told";
}

/// The busy scene without any medium.
Scene without_media(Scene scene) {
    scene.media.clear();
    scene.camera.medium = -1;
    for (Shape& shape : scene.shapes)
        shape.media = {};
    return scene;
}

class EffectsTest : public DeviceTest {};

TEST_F(EffectsTest, WithoutMediaThereIsNoStageForThem) {
    EXPECT_TRUE(has_stage(busy_scene(), "shade_volume")); // the control
    EXPECT_FALSE(has_stage(without_media(busy_scene()), "shade_volume"));
    EXPECT_EQ(compute_effects(without_media(busy_scene())).features.has_media, 0);
    EXPECT_EQ(compute_effects(without_media(busy_scene())).features.has_scattering, 0);
}

TEST_F(EffectsTest, PathIgnoresMedia) {
    Scene scene = busy_scene();
    scene.integrator.kind = Integrator::Kind::path;
    EXPECT_FALSE(has_stage(scene, "shade_volume"));
    Scene bare = without_media(busy_scene());
    const auto sums = render_sums(scene, 0, 8);
    EXPECT_EQ(sums, render_sums(bare, 0, 8));
    EXPECT_NE(sums, render_sums(busy_scene(), 0, 8)); // the control
}

TEST_F(EffectsTest, PathSeesThroughOneBoxOfAMedium) {
    Scene scene = plain_scene();
    scene.integrator.kind = Integrator::Kind::path;
    EXPECT_EQ(colors_of(render(scene, 2))[8 * 16 + 8], Rgb(1, 0.9F, 0.8F));
    EXPECT_NE(colors_of(render(plain_scene(), 2))[8 * 16 + 8], Rgb(1, 0.9F, 0.8F));
}

TEST_F(EffectsTest, AUniformSkyNeedsNoShadowRays) {
    Scene scene = busy_scene();
    EXPECT_TRUE(has_stage(scene, "trace_shadow")); // for its area light
    scene.shapes.erase(std::remove_if(scene.shapes.begin(), scene.shapes.end(),
                                      [](const Shape& s) { return s.area_light >= 0; }),
                       scene.shapes.end());
    EXPECT_FALSE(has_stage(scene, "trace_shadow"));
    EXPECT_FALSE(has_stage(scene, "shade_emitter"));
    expect_agreement(scene, 16);
}

TEST_F(EffectsTest, AbsorptionAloneNeedsNoShadowRaysAndNoScattering) {
    Scene scene = empty_scene(8);
    add_shape(scene, full_sphere(0.4), {.inside = add_medium(scene, Rgb(1), Rgb(0))},
              translation({0, 0, 3}));
    add_shape(scene, full_sphere(0.4), {.inside = 0}, translation({1, 0, 3}));
    add_light(scene, PointLight{});
    for (const char* name : {"shade_volume", "shade_surface", "trace_shadow"})
        EXPECT_FALSE(has_stage(scene, name)) << name;
    EXPECT_TRUE(has_stage(scene, "cross_interface"));
}

TEST_F(EffectsTest, OneBoundaryNeedsNoHierarchy) {
    EXPECT_TRUE(has_stage(plain_scene(), "walk_region"));
    EXPECT_FALSE(has_stage(plain_scene(), "trace_segment"));
    EXPECT_FALSE(has_stage(busy_scene(), "walk_region"));
    // What looks like one box but is not: turned inside out, open, or with a medium around.
    for (int change = 0; change < 3; ++change) {
        Scene scene = plain_scene();
        Shape& box = scene.shapes[0];
        if (change == 0) box.reverse_orientation = true;
        if (change == 1) std::get<Mesh>(box.geometry).triangles.pop_back();
        if (change == 2)
            box.media.outside = scene.camera.medium = add_medium(scene, Rgb(0.1), Rgb(0));
        EXPECT_FALSE(has_stage(scene, "walk_region")) << change;
    }
}

TEST_F(EffectsTest, ALongerWayGivesTheSamePicture) {
    // The box alone, and the same box where something far away asks for a hierarchy.
    const Scene scene = plain_scene();
    Scene with_more = scene;
    add_shape(with_more, Disk{.radius = 0.1}, {.material = black}, translation({100, 0, 0}));
    EXPECT_TRUE(has_stage(with_more, "trace_segment"));
    expect_agreement(device_batches(with_more, 32), device_batches(scene, 16), 16);
}

/// One stage per kind of boundary that occurs; those of other scenes are as they were.
TEST_F(EffectsTest, OnlyBoundariesThatOccurHaveStages) {
    const std::array<std::string, 4> names{"shade_dielectric", "shade_rough_dielectric",
                                           "shade_conductor", "shade_rough_conductor"};
    EXPECT_EQ(stages_of(plain_scene()),
              (std::set<std::string>{"walk_region", "schedule", "update_film"}));
    EXPECT_EQ(stages_of(busy_scene()),
              (std::set<std::string>{"trace_segment", "shade_emitter", "shade_volume",
                                     "shade_surface", "cross_interface", "trace_shadow",
                                     "next_sample", "schedule", "update_film"}));
    for (std::size_t kind = 0; kind < names.size(); ++kind) {
        Scene scene = plain_scene();
        const double alpha = kind % 2 ? 0.2 : 0;
        // A box that is no mere interface.
        scene.shapes.front().material = kind < 2 ? add_dielectric(scene, Rgb(1.5), alpha)
                                                 : add_conductor(scene, Rgb(0.2), Rgb(3), alpha);
        EXPECT_EQ(stages_of(scene),
                  (std::set<std::string>{"trace_segment", "shade_volume", names[kind],
                                         "next_sample", "schedule", "update_film"}));
    }
    Scene prism = plain_scene();
    prism.shapes.front().material = add_dielectric(prism, {1.5, 1.51, 1.52});
    EXPECT_EQ(effect(prism, "dispersion"), "yes");
    EXPECT_EQ(effect(prism, "spectral MIS"), "yes");
    EXPECT_EQ(effect(plain_scene(), "dispersion"), "no");
}

TEST_F(EffectsTest, TheListTellsWhatTheSceneHas) {
    const Scene busy = busy_scene();
    for (const char* name :
         {"interfaces", "diffuse surfaces", "emitting surfaces", "shading normals", "media",
          "scattering", "spectral MIS", "environment", "area lights"})
        EXPECT_EQ(effect(busy, name), "yes") << name;
    for (const char* name : {"instances", "emission of media", "distant lights", "point lights",
                             "spot lights", "depth of field", "radiance limit"})
        EXPECT_EQ(effect(busy, name), "no") << name;
    EXPECT_EQ(effect(busy, "phase functions"), "Henyey-Greenstein");
    EXPECT_EQ(effect(busy, "geometry"), "hierarchy");
    EXPECT_EQ(effect(busy, "channels"), "3");
    EXPECT_EQ(effect(plain_scene(), "geometry"), "one box");
    EXPECT_EQ(effect(without_media(busy), "media"), "no");

    const Scene furnace = read_scene(source_folder() + "/scenes/furnace.pbrt");
    EXPECT_EQ(effect(furnace, "geometry"), "one ellipsoid");
    EXPECT_EQ(effect(furnace, "channels"), "1");
    EXPECT_EQ(effect(furnace, "diffuse surfaces"), "no");
    EXPECT_EQ(effect(read_scene(source_folder() + "/scenes/instances.pbrt"), "instances"), "yes");
}

} // namespace
} // namespace tyndall::device_test

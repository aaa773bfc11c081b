// Which techniques a scene gets, and that each changes what it says.
#include "study/techniques.h"

#include "core/error.h"
#include "support/scenes.h"
#include "support/volumes.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace tyndall::study {
namespace {

using support::empty_scene;

std::set<std::string> names_of(const Scene& scene) {
    std::set<std::string> names;
    for (const Technique& technique : list_techniques(scene))
        names.insert(technique.name);
    return names;
}

/// A fog in a box with a diffuse floor, under a sky and an emitting square.
Scene foggy_scene() {
    Scene scene = empty_scene(8);
    const int fog = support::add_medium(scene, Rgb(0.1), Rgb(0.9), 0.6);
    support::add_infinite(scene);
    support::add_shape(scene, support::box_mesh(glm::vec3(-1), glm::vec3(1)), {.inside = fog});
    support::add_shape(scene, support::square_mesh(2, 3, -1),
                       {.material = support::add_diffuse(scene, Rgb(0.5)),
                        .area_light = support::add_area_light(scene, Rgb(3))});
    return scene;
}

TEST(Techniques, AreThoseThatMakeSense) {
    Scene empty = empty_scene(8);
    support::add_infinite(empty);
    EXPECT_EQ(names_of(empty), (std::set<std::string>{kBaseline}));

    const std::set<std::string> foggy = names_of(foggy_scene());
    for (const char* name :
         {"volpath", "volpath-sobol", "volpath-analog", "volpath-no-light-sampling",
          "march-uniform-1024", "march-jittered-4", "march-equiangular-16", "orders-1", "orders-64",
          "phase-schlick", "without-media", "without-scattering", "without-environment",
          "without-surfaces"})
        EXPECT_TRUE(foggy.count(name)) << name;
    for (const char* name : {"cells-4", "without-lens", "without-colour", "without-emission",
                             "phase-henyey-greenstein"})
        EXPECT_FALSE(foggy.count(name)) << name;
}

TEST(Techniques, StartWithTheBaseline) {
    EXPECT_EQ(list_techniques(foggy_scene()).front().name, kBaseline);
}

TEST(Techniques, ChangeTheSceneAndNothingElse) {
    const Scene scene = foggy_scene();
    const std::vector<Technique> all = list_techniques(scene);
    const auto changed = [&](const std::string& name) {
        const auto found = std::find_if(all.begin(), all.end(),
                                        [&](const Technique& t) { return t.name == name; });
        return changed_scene(scene, *found);
    };
    EXPECT_EQ(changed("orders-4").integrator.max_depth, 4);
    EXPECT_EQ(changed("orders-4").media[0].sigma_s, scene.media[0].sigma_s);
    EXPECT_EQ(changed("march-uniform-16").integrator.kind, Integrator::Kind::singlescatter);
    EXPECT_EQ(changed("march-uniform-16").integrator.steps, 16);
    EXPECT_EQ(changed("march-uniform-16").integrator.max_depth, scene.integrator.max_depth);
    EXPECT_FALSE(changed("volpath-no-light-sampling").integrator.samples_lights);
    EXPECT_EQ(changed("volpath-sobol").sampler, Sampler::sobol);
    EXPECT_EQ(changed("without-scattering").media[0].sigma_s, Rgb(0));
    EXPECT_EQ(changed("without-scattering").media[0].sigma_a, Rgb(1));
    EXPECT_EQ(changed("without-environment").lights.size(), 0u);
    EXPECT_EQ(changed("phase-schlick").media[0].phases[0].kind, PhaseFunction::Kind::schlick);
    EXPECT_NEAR(changed("phase-schlick").media[0].phases[0].k, 1.55 * 0.6 - 0.55 * 0.216, 1e-12);
}

TEST(Techniques, OfGridsHaveCellsOfOtherSizes) {
    Scene scene = foggy_scene();
    scene.media[0].density =
        support::Lattice{}.density([](const glm::ivec3& voxel) { return voxel.x; }, 4);
    const std::vector<Technique> all = list_techniques(scene);
    std::set<int> sizes;
    for (const Technique& technique : all) {
        if (technique.family != Family::cells) continue;
        const Scene changed = changed_scene(scene, technique);
        const auto& density = std::get<GridDensity>(changed.media[0].density);
        EXPECT_EQ(density.majorants.size, static_cast<int>(technique.parameter));
        EXPECT_EQ(density.density, std::get<GridDensity>(scene.media[0].density).density);
        EXPECT_TRUE(technique.is_unbiased);
        sizes.insert(density.majorants.size);
    }
    EXPECT_EQ(sizes, (std::set<int>{1, 16})); // not 4, which it has; 16 is all of it
}

TEST(Techniques, AreSelectedByPattern) {
    const std::vector<std::string> patterns{"orders-*", "volpath"};
    const std::vector<Technique> some = select_techniques(list_techniques(foggy_scene()), patterns);
    EXPECT_EQ(some.front().name, kBaseline);
    EXPECT_EQ(some.size(), 8u); // 1, 2, 4 ... 64
    const std::vector<std::string> wrong{"orders-3"};
    try {
        select_techniques(list_techniques(foggy_scene()), wrong);
        FAIL() << "accepted";
    } catch (const Error& e) {
        EXPECT_EQ(e.status(), ExitStatus::bad_input);
        EXPECT_NE(std::string(e.what()).find("orders-4"), std::string::npos);
    }
}

} // namespace
} // namespace tyndall::study

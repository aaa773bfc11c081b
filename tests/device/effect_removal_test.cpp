// Nothing is left of an effect that a scene does not call for: each is taken away from a scene that
// has them all. Its functions are gone from the SPIR-V with the constants frozen, its instructions,
// stages and tables too, and the picture is that of the reference.
#include "device/device_test.h"
#include "device/full_scene.h"
#include "device/test_scenes.h"
#include "gpu/specialize.h"
#include "render/effect_costs.h"
#include "render/stages.h"
#include "support/forced_effects.h"

#include <cstring>
#include <map>
#include <numeric>
#include <set>

namespace tyndall::device_test {
namespace {

using namespace support;

/// What a scene is built of.
struct Build {
    explicit Build(const Scene& s)
        : effects(compute_effects(s)), tables(make_scene_tables(s, effects)),
          features(tables.features(effects.features)) {}

    std::string value(const std::string& effect) const {
        for (const Effect& e : effects.list)
            if (e.name == effect) return e.value;
        return "is not told";
    }
    std::uint64_t bytes() const {
        std::uint64_t sum = tables.voxels.bytes.size();
        for (const auto& table : tables.bytes)
            sum += table.second;
        return sum;
    }

    Effects effects;
    SceneTables tables;
    shared::Features features;
};

/// Names of the functions of a module, as far as the arguments.
std::set<std::string> functions_of(std::span<const std::uint32_t> spirv) {
    constexpr std::uint32_t op_name = 5, op_function = 54;
    std::map<std::uint32_t, std::string> names;
    std::set<std::string> functions;
    for (std::size_t at = 5; at < spirv.size(); at += std::max(1u, spirv[at] >> 16)) {
        const std::uint32_t opcode = spirv[at] & 0xFFFFu;
        if (opcode == op_name) names[spirv[at + 1]] = reinterpret_cast<const char*>(&spirv[at + 2]);
        if (opcode == op_function) {
            const std::string& name = names[spirv[at + 2]];
            functions.insert(name.substr(0, name.find('(')));
        }
    }
    return functions;
}

std::vector<std::uint32_t> specialized(const StageKind& kind, const shared::Features& features) {
    return gpu::specialize(kind.spirv, kind.features(features), kind.name);
}

std::set<std::string> functions_of(const shared::Features& features) {
    std::set<std::string> all;
    for (const StageKind& kind : stage_kinds())
        if (kind.is_called_for(features)) all.merge(functions_of(specialized(kind, features)));
    return all;
}

struct Count {
    std::set<std::string> stages;
    std::size_t instructions = 0;
};
Count count_of(const shared::Features& features) {
    Count count;
    for (const auto& [name, instructions] : count_stage_instructions(features)) {
        count.stages.insert(name);
        count.instructions += instructions;
    }
    return count;
}

/// An effect, and functions that only it calls for.
struct Removal {
    std::string effect;
    std::vector<std::string> functions;
};
void PrintTo(const Removal& removal, std::ostream* out) {
    *out << removal.effect;
}

const std::vector<Removal> kRemovals{
    {"interfaces", {}},
    {"diffuse surfaces", {}},
    {"smooth dielectrics", {}},
    {"rough dielectrics", {"sample_rough_dielectric"}},
    {"smooth metal", {}},
    {"rough metal", {}},
    {"dispersion", {}},
    {"emitting surfaces", {"emitted", "emitter_pdf"}},
    {"shading normals", {}},
    {"instances", {"walk_instances"}},
    {"media", {}},
    {"scattering", {"scatter_in_medium", "sample_phase"}},
    {"emission of media", {"emission_weight", "blackbody"}},
    {"mixtures of phases", {}},
    {"chromatic phases", {}},
    {"delta phases", {}},
    {"spectral MIS", {}},
    {"media in closed form", {"pass_segment", "flight_distance"}},
    {"grids", {}},
    {"black body emission", {"blackbody"}},
    {"exponential atmospheres", {"exponential_column"}},
    {"environment", {}},
    {"area lights", {"sample_area_light"}},
    {"grids as lights", {"sample_voxel_light"}},
    {"distant lights", {}},
    {"point lights", {}},
    {"spot lights", {"spot_falloff"}},
    {"equiangular sampling", {"collision_weight", "light_in_passing"}},
    {"depth of field", {}},
    {"radiance limit", {}},
};

class EffectRemovalTest : public DeviceTest, public testing::WithParamInterface<Removal> {};

/// The scene without the effect; grids do not shine as lights if they do not emit.
Scene scene_without(const std::string& effect) {
    return full_scene(effect == "grids as lights" ? "emission of media" : effect);
}

/// The scene with all effects, which takes a second to take stock of.
struct Stock {
    Build build{full_scene()};
    Count count = count_of(build.features);
    std::set<std::string> functions = functions_of(build.features);
    std::map<std::string, EffectCost> costs;

    Stock() {
        const auto priced = price_effects(build.effects, build.tables);
        for (std::size_t i = 0; i < priced.size(); ++i)
            if (priced[i]) costs[build.effects.list[i].name] = *priced[i];
    }
};
const Stock& stock() {
    static const Stock stock;
    return stock;
}

TEST_P(EffectRemovalTest, LeavesNothing) {
    const auto& [effect, functions] = GetParam();
    const Build rest(scene_without(effect));
    EXPECT_EQ(stock().build.value(effect), "yes");
    EXPECT_EQ(rest.value(effect), "no");

    const Count count = count_of(rest.features);
    // A point light needs nothing that a spot light does not have.
    const bool has_code = effect != "point lights";
    EXPECT_EQ(count.instructions < stock().count.instructions, has_code);
    const std::set<std::string> left = functions_of(rest.features);
    for (const std::string& function : functions) {
        EXPECT_TRUE(stock().functions.count(function)) << "no teeth: " << function;
        EXPECT_FALSE(left.count(function)) << function;
    }
    const EffectCost& cost = stock().costs.at(effect);
    EXPECT_EQ(cost.instructions > 0, has_code);
    for (const std::string& stage : cost.stages)
        EXPECT_FALSE(count.stages.count(stage)) << stage;
    EXPECT_TRUE(cost.bytes == 0 || rest.bytes() < stock().build.bytes());
}

TEST_P(EffectRemovalTest, LeavesTheRightPicture) {
    expect_agreement(scene_without(GetParam().effect), 16, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Each, EffectRemovalTest, testing::ValuesIn(kRemovals));

class EffectListTest : public DeviceTest {};

/// What is not in the table above would not be tested.
TEST_F(EffectListTest, EachEffectIsTakenAwaySomewhere) {
    std::set<std::string> tested{"roulette by reach of light", "boundaries in touch",
                                 "choice among lights"}; // below
    for (const Removal& removal : kRemovals)
        tested.insert(removal.effect);
    const Build& all = stock().build;
    for (const Effect& effect : all.effects.list) {
        if (effect.value != "yes" && effect.value != "no") continue;
        EXPECT_TRUE(tested.count(effect.name)) << effect.name;
        EXPECT_TRUE(features_without(effect.name, all.features)) << effect.name;
    }
}

/// All light has to come from within a ball: no scene with a sky has this.
TEST_F(EffectListTest, RouletteByReachIsTakenAwayByASky) {
    Scene scene = empty_scene(8);
    scene.camera.medium = add_medium(scene, Rgb(0.1), Rgb(0.2));
    add_light(scene, PointLight{Rgb(1), {0, 0, 2}});
    add_shape(scene, full_sphere(0.5), {.material = add_diffuse(scene, Rgb(0.5))},
              translation({0, 0, 4}));
    const Build with(scene);
    add_infinite(scene);
    const Build without(scene);
    EXPECT_EQ(with.value("roulette by reach of light"), "yes");
    EXPECT_EQ(without.value("roulette by reach of light"), "no");
    shared::Features taken = *features_without("roulette by reach of light", with.features);
    EXPECT_LT(count_of(taken).instructions, count_of(with.features).instructions);
}

TEST_F(EffectListTest, OneLightIsNotChosenAmongOthers) {
    Scene scene = full_scene("emission of media");
    scene.shapes.erase(std::remove_if(scene.shapes.begin(), scene.shapes.end(),
                                      [](const Shape& s) { return s.area_light >= 0; }),
                       scene.shapes.end());
    scene.lights.clear();
    add_light(scene, PointLight{Rgb(1), {1, 3, -2}});
    const Build one(scene);
    add_light(scene, PointLight{Rgb(1), {-1, 3, -2}});
    const Build two(scene);
    EXPECT_EQ(two.value("choice among lights"), "yes");
    EXPECT_EQ(one.value("choice among lights"), "no");
    EXPECT_TRUE(functions_of(two.features).count("light_importance")) << "no teeth";
    EXPECT_FALSE(functions_of(one.features).count("light_importance"));
    EXPECT_LT(count_of(one.features).instructions, count_of(two.features).instructions);
}

TEST_F(EffectListTest, BoundariesAreTakenApart) {
    const auto make = [](double gap) {
        Scene scene = empty_scene(8);
        const int fog = add_medium(scene, Rgb(0.1), Rgb(0.2));
        add_shape(scene, box_mesh(glm::vec3(-1, -1, 2), glm::vec3(1, 1, 3)), {.inside = fog});
        add_shape(scene, square_mesh(2, 0, -1), {.material = add_diffuse(scene, Rgb(0.5))},
                  translation({0, 0, 3 + gap}));
        add_light(scene, PointLight{Rgb(1), {0, 0, 1}});
        return scene;
    };
    const Build touching(make(0)), apart(make(0.1));
    EXPECT_EQ(touching.value("boundaries in touch"), "yes");
    EXPECT_EQ(apart.value("boundaries in touch"), "no");
    EXPECT_TRUE(functions_of(touching.features).count("is_crossed_first")) << "no teeth";
    EXPECT_FALSE(functions_of(apart.features).count("is_crossed_first"));
    EXPECT_LT(count_of(apart.features).instructions, count_of(touching.features).instructions);
}

/// OpUMulExtended: only random numbers multiply so.
std::size_t random_blocks(std::span<const std::uint32_t> spirv) {
    std::size_t count = 0;
    for (std::size_t at = 5; at < spirv.size(); at += std::max(1u, spirv[at] >> 16))
        count += (spirv[at] & 0xFFFFu) == 151;
    return count;
}

/// Light that is only absorbed and emitted is no matter of chance: no random number but for the
/// ray's place in its pixel, no roulette, no flights; and where all rays of a pixel are one, no
/// variance.
TEST_F(EffectListTest, AbsorptionAndEmissionAreDeterministic) {
    const auto make = [](double sigma_s) {
        Scene scene = empty_scene(8);
        trace_pixel_centers(scene);
        for (int i = 0; i < 2; ++i) {
            const int medium = add_medium(scene, {0.5, 1, 2}, Rgb(sigma_s));
            scene.media.back().emission = {1, 0.5, 0.2};
            add_shape(scene, full_sphere(0.6), {.inside = medium},
                      translation({0.5 * i, 0.3 * i, 3.0 + 2 * i}));
        }
        add_infinite(scene, {0.3, 0.4, 0.5});
        return scene;
    };
    const auto blocks = [](const Scene& scene, bool at_the_camera) {
        const Build build(scene);
        std::size_t count = 0;
        for (const StageKind& kind : stage_kinds())
            if (kind.is_called_for(build.features) &&
                (std::strcmp(kind.name, "next_sample") == 0) == at_the_camera)
                count += random_blocks(specialized(kind, build.features));
        return count;
    };
    EXPECT_GT(blocks(make(1), false), 0) << "no teeth";
    EXPECT_EQ(blocks(make(0), false), 0);
    EXPECT_EQ(functions_of(Build(make(0)).features).count("roulette"), 0);
    EXPECT_EQ(functions_of(Build(make(1)).features).count("roulette"), 1) << "no teeth";
    const auto variance = [](const Scene& scene) {
        const Image film = render(scene, 64);
        float most = 0;
        for (std::size_t i = 0; i < film.pixels.size(); i += 6)
            most = std::max({most, film.pixels[i + 3], film.pixels[i + 4], film.pixels[i + 5]});
        return most;
    };
    EXPECT_LT(variance(make(0)), 1e-12F); // sums of 64 equal floats, rounded
    EXPECT_GT(variance(make(1)), 1e-6F) << "no teeth";
}

/// Of the two images, the worst difference of any sum.
double worst_difference(const std::vector<glm::dvec4>& a, const std::vector<glm::dvec4>& b) {
    double worst = a.size() == b.size() ? 0 : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        for (int c = 0; c < 4; ++c)
            worst = std::max(worst, std::abs(a[i][c] - b[i][c]));
    return worst;
}

/// An effect that nothing calls for changes no bit when it is built in all the same. A GPU's driver
/// may round a product and a sum at once, in one kernel and not in the other.
TEST_F(EffectListTest, ForcedEffectsLeaveTheImageAsItIs) {
    // Grey, without any of these.
    Scene scene = empty_scene(12);
    scene.integrator.max_depth = 20;
    add_shape(scene, full_sphere(0.8), {.inside = add_medium(scene, Rgb(0.2), Rgb(2), 0.3)},
              translation({0, 0, 3}));
    add_shape(scene, square_mesh(2, 4, -1), {.material = add_diffuse(scene, Rgb(0.5))});
    add_light(scene, PointLight{Rgb(5), {1, 2, 1}});
    const Effects own = compute_effects(scene);
    const auto sums = [](const Scene& of, const Effects& effects) {
        Renderer renderer(context(), of, effects, {});
        renderer.render(0, 4);
        return renderer.read_sums();
    };
    const auto expected = sums(scene, own);
    const double rounding = context().info().type == "cpu" ? 0 : 1e-5;
    for (const auto& [name, force] : kForcedEffects) {
        Effects more = own;
        force(more.features);
        EXPECT_NE(std::memcmp(&more.features, &own.features, sizeof(own.features)), 0)
            << "no teeth: " << name;
        EXPECT_LE(worst_difference(sums(scene, more), expected), rounding) << name;
    }
    Scene denser = scene;
    denser.media[0].sigma_s *= 1.01;
    EXPECT_GT(worst_difference(sums(denser, own), expected), 1e-3) << "no teeth";
}

/// Likewise for what the scene above calls for.
TEST_F(EffectListTest, ClosedFormsBesideVoxelsLeaveTheImageAsItIs) {
    const Scene scene = full_scene("media in closed form");
    const auto sums = [&](const Effects& effects) {
        Renderer renderer(context(), scene, effects, {});
        renderer.render(0, 4);
        return renderer.read_sums();
    };
    const Effects own = compute_effects(scene);
    Effects more = own;
    ASSERT_EQ(more.features.has_closed_media, 0) << "no teeth";
    more.features.has_closed_media = 1;
    EXPECT_EQ(sums(more), sums(own));
}

} // namespace
} // namespace tyndall::device_test

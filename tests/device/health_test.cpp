// Each kind of mishap, made to happen: both renderers count it, and tell where it was. Scenes that
// no reader would let through break what the counters watch.
#include "device/test_scenes.h"

#include "phase/phase_table.h"
#include "reference/reference.h"
#include "render/bvh.h"
#include "support/materials.h"
#include "support/phases.h"
#include "support/volumes.h"

#include <array>
#include <cmath>
#include <limits>

namespace tyndall::device_test {
namespace {

using namespace shared;
using namespace support;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t kSamples = 4;
constexpr int kPixels = 8;
constexpr std::uint64_t kPaths = kPixels * kPixels * kSamples;

class HealthTest : public DeviceTest {};

Health device_health(const Scene& scene, std::uint32_t first = 0, std::uint32_t end = kSamples) {
    Renderer renderer(context(), scene);
    renderer.render(first, end);
    return renderer.health();
}

Health reference_health(const Scene& scene, std::uint32_t first = 0, std::uint32_t end = kSamples) {
    reference::ReferenceRenderer renderer(scene);
    renderer.render(first, end - first);
    return renderer.health();
}

using Render = Health (*)(const Scene&, std::uint32_t, std::uint32_t);
constexpr std::array<Render, 2> kRenderers{device_health, reference_health};

/// That kind was seen, and happens again to the path that is named.
void expect_located(Render render, const Scene& scene, int kind) {
    const Mishap mishap = render(scene, 0, kSamples).kinds[static_cast<std::size_t>(kind)];
    ASSERT_GT(mishap.count, 0) << kHealthNames[static_cast<std::size_t>(kind)];
    Scene pixel = scene;
    const int x = static_cast<int>(mishap.x), y = static_cast<int>(mishap.y);
    pixel.film.bounds = {x, x + 1, y, y + 1};
    const Health again = render(pixel, mishap.sample, mishap.sample + 1);
    EXPECT_GE(again[static_cast<std::size_t>(kind)], 1);
}

/// Both renderers count the kind so often, and no other.
void expect_counted(const Scene& scene, int kind, std::uint64_t count) {
    for (const Render render : kRenderers) {
        const Health health = render(scene, 0, kSamples);
        for (int other = 0; other < HEALTH_COUNT; ++other) {
            const auto i = static_cast<std::size_t>(other);
            EXPECT_EQ(health[i], other == kind ? count : 0) << kHealthNames[i];
        }
        expect_located(render, scene, kind);
    }
}

/// The left half of the picture sees a lamp.
Scene lamp(const Rgb& radiance) {
    Scene scene = empty_scene(kPixels);
    add_shape(scene, box_mesh({-1, -1, 3}, {0, 1, 4}),
              {.material = black, .area_light = add_area_light(scene, radiance)});
    return scene;
}

/// A cube of a medium that scatters, under a sky.
Scene cube(const Rgb& sky = Rgb(1)) {
    Scene scene = empty_scene(kPixels, 0.9);
    add_infinite(scene, sky);
    const int medium = add_medium(scene, Rgb(0), Rgb(2));
    add_shape(scene, box_mesh({-1, -1, 2}, {1, 1, 4}), {.inside = medium});
    return scene;
}

/// The same by way of a hierarchy.
Scene with_hierarchy(Scene scene) {
    add_shape(scene, full_sphere(0.1), {}, translation({0, 0, 3}));
    return scene;
}

/// The medium on voxels, with majorants that are `factor` of what they should be.
Scene grid(double factor) {
    Scene scene = cube();
    const Lattice lattice{{-1, -1, 2}, {1, 1, 4}, {9, 9, 9}};
    GridDensity density = lattice.density([](const glm::ivec3&) { return 1.0; });
    for (float& bound : density.majorants.bounds)
        bound *= static_cast<float>(factor);
    scene.media[0].density = density;
    scene.media[0].sigma_a = Rgb(0.1);
    return scene;
}

TEST_F(HealthTest, NothingHappensInHealthyScenes) {
    for (const Scene& scene : {busy_scene(), plain_scene(), grid(1), with_hierarchy(cube())})
        for (const Render render : kRenderers)
            EXPECT_TRUE(render(scene, 0, kSamples).is_good());
}

TEST_F(HealthTest, RadianceThatIsNotFinite) {
    expect_counted(lamp(Rgb(nan)), HEALTH_NONFINITE, kPaths / 2);
    expect_counted(lamp(Rgb(INFINITY)), HEALTH_NONFINITE, kPaths / 2);
    expect_counted(cube(Rgb(1, nan, 1)), HEALTH_NONFINITE, kPaths);
    expect_counted(with_hierarchy(cube(Rgb(nan))), HEALTH_NONFINITE, kPaths);
}

TEST_F(HealthTest, RadianceBelowZero) {
    expect_counted(lamp(Rgb(1, -1e-3, 1)), HEALTH_NEGATIVE, kPaths / 2);
    expect_counted(cube(Rgb(-1)), HEALTH_NEGATIVE, kPaths);
}

TEST_F(HealthTest, MajorantsThatAreTooSmall) {
    const Health device = device_health(grid(0.5)), reference = reference_health(grid(0.5));
    EXPECT_GT(device[HEALTH_MAJORANT], kPaths / 4);
    // The same paths, up to what rounding decides.
    EXPECT_NEAR(double(device[HEALTH_MAJORANT]), double(reference[HEALTH_MAJORANT]), 3);
    EXPECT_NEAR(device.worst_majorant_ratio, 2, 1e-5);
    EXPECT_NEAR(reference.worst_majorant_ratio, 2, 1e-5);
    for (const Render render : kRenderers)
        expect_located(render, grid(0.5), HEALTH_MAJORANT);
}

/// Shadow rays that pass such a medium, on their way from a floor behind it.
TEST_F(HealthTest, MajorantsThatAreTooSmallForShadowRays) {
    Scene scene = grid(0.5);
    scene.media[0].sigma_a = Rgb(3);
    scene.media[0].sigma_s = Rgb(0);
    scene.camera.world_from_camera = look_at({0, 0, 5}, {0, 0, 9}, {0, 1, 0});
    scene.lights.clear();
    add_light(scene, PointLight{Rgb(1), {0, 0, 0}});
    add_shape(scene, square_mesh(2, 6, -1), {.material = add_diffuse(scene, Rgb(0.5))});
    scene.integrator.max_depth = 1;
    for (const Render render : kRenderers) {
        const Health health = render(scene, 0, kSamples);
        EXPECT_GT(health[HEALTH_MAJORANT], kPaths / 4);
        EXPECT_NEAR(health.worst_majorant_ratio, 2, 1e-5);
        expect_located(render, scene, HEALTH_MAJORANT);
    }
}

/// A table that ends at 1 - cos = 2.4, with values that leave room for it.
TEST_F(HealthTest, CosinesBeyondOne) {
    const std::vector<double> ones(5, 1.0);
    PhaseTable table = make_phase_table({ones, ones, ones});
    table.complement.back() = 2.4;
    for (std::vector<double>& values : table.value)
        for (double& value : values)
            value *= 0.8;
    Scene scene = cube();
    scene.media[0].phases[0].kind = PhaseFunction::Kind::mie;
    scene.media[0].phases[0].table = std::make_shared<PhaseTable>(table);
    for (const Scene& s : {scene, with_hierarchy(scene)})
        for (const Render render : kRenderers)
            expect_located(render, s, HEALTH_COSINE);
}

TEST_F(HealthTest, DirectionsThatAreNone) {
    Scene scattered = cube();
    scattered.media[0].phases[0] = schlick(nan);
    for (const Scene& scene : {scattered, with_hierarchy(scattered)})
        for (const Render render : kRenderers)
            expect_located(render, scene, HEALTH_DIRECTION);
    Scene camera = cube();
    camera.camera.world_from_camera =
        scaling({0, 0, 0}) * camera.camera.world_from_camera; // directions of no length
    for (const Scene& scene : {camera, with_hierarchy(camera)})
        expect_counted(scene, HEALTH_DIRECTION, kPaths);
}

/// A medium without bounds that does not absorb holds its paths for ever.
TEST_F(HealthTest, PathsWithoutAnEnd) {
    Scene scene = empty_scene(kPixels);
    scene.camera.medium = add_medium(scene, Rgb(0), Rgb(1));
    add_infinite(scene);
    scene.integrator.max_depth = std::numeric_limits<int>::max();
    scene.integrator.event_limit = 100;
    Scene voxels = grid(1);
    voxels.media[0].sigma_a = Rgb(0);
    voxels.media[0].sigma_s = Rgb(1e6);
    voxels.integrator = scene.integrator;
    Scene hierarchy = with_hierarchy(cube());
    hierarchy.media[0].sigma_s = Rgb(1e6);
    hierarchy.integrator = scene.integrator;
    for (const Scene& endless : {scene, voxels, hierarchy}) {
        // Next to the surface, many find their way out.
        for (const Render render : kRenderers) {
            const Health health = render(endless, 0, kSamples);
            EXPECT_GT(health[HEALTH_EVENT_LIMIT], kPaths / 8);
            EXPECT_DOUBLE_EQ(health.lost_throughput, double(health[HEALTH_EVENT_LIMIT]));
            expect_located(render, endless, HEALTH_EVENT_LIMIT);
        }
    }
    expect_counted(scene, HEALTH_EVENT_LIMIT, kPaths);
}

/// Shadow rays through more interfaces than one dispatch should cross.
TEST_F(HealthTest, ShadowRaysWithoutAnEnd) {
    constexpr int across = 2;
    Scene scene = empty_scene(across, 0.1);
    scene.camera.world_from_camera = look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0});
    add_shape(scene, square_mesh(2, -1, 1), {.material = add_diffuse(scene, Rgb(0.5))});
    add_light(scene, PointLight{Rgb(1), {0, 0, 4}});
    for (std::uint32_t i = 0; i <= SHADOW_CROSSINGS_MAX; ++i)
        add_shape(scene, square_mesh(9, 1 + 1e-4F * static_cast<float>(i), 1), {});
    EXPECT_EQ(reference_health(scene, 0, 1)[HEALTH_EVENT_LIMIT], across * across);
    // The device's paths would take a round for each interface.
    scene.integrator.event_limit = 3;
    const std::uint64_t with_paths = device_health(scene, 0, 1)[HEALTH_EVENT_LIMIT];
    scene.shapes.resize(2); // a few interfaces are no trouble
    const std::uint64_t paths = device_health(scene, 0, 1)[HEALTH_EVENT_LIMIT];
    EXPECT_EQ(with_paths - paths, across * across);
    scene.integrator.event_limit = 100;
    EXPECT_TRUE(reference_health(scene, 0, 1).is_good());
}

/// Inner nodes on the longest way down, each of which may leave a word on the stack of a traversal.
std::uint32_t depth_of(const Bvh& bvh, std::uint32_t node) {
    if (node & LEAF) return 0;
    const NodeRecord& n = bvh.nodes[node];
    return 1 + std::max(depth_of(bvh, n.child0), depth_of(bvh, n.child1));
}

/// No hierarchy needs more than the stack has, not of boxes whose sizes halve, which ask for a
/// level each.
TEST_F(HealthTest, HierarchiesFitTheStackOfTraversal) {
    std::vector<Bounds> boxes;
    for (int i = 0; i < 60; ++i)
        boxes.push_back({glm::vec3(std::ldexp(1.0F, -i)), glm::vec3(std::ldexp(1.5F, -i))});
    boxes.insert(boxes.end(), 5000, boxes.back());
    const Bvh bvh = build_bvh(boxes, 1, 1);
    const std::uint32_t depth = depth_of(bvh, bvh.root);
    EXPECT_LE(depth, BVH_DEPTH_MAX);
    EXPECT_GT(depth, 20); // a balanced one would have 13
}

TEST_F(HealthTest, WeightsThatNoExactSamplingHas) {
    Scene scene = empty_scene(kPixels);
    add_infinite(scene);
    add_shape(scene, square_mesh(2, 3, -1), {.material = add_diffuse(scene, Rgb(2000))});
    expect_counted(scene, HEALTH_WEIGHT, kPaths);
    scene.materials.back().reflectance = Rgb(1);
    EXPECT_TRUE(device_health(scene).is_good());
}

} // namespace
} // namespace tyndall::device_test

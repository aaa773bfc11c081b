// Device and reference trace the same paths from the same random numbers: pixels agree to rounding,
// but for the few where rounding decides between two ways.
#include "device/device_test.h"
#include "support/materials.h"
#include "support/volumes.h"

namespace tyndall::device_test {
namespace {

using namespace support;

class SamePathsTest : public DeviceTest {};

bool are_equal(const Rgb& a, const Rgb& b) {
    return glm::all(glm::lessThanEqual(glm::abs(a - b), 1e-3 * b + 1e-6));
}

/// Pixels that other random numbers change must be the same for the same ones. Rounding decides in
/// a few of 1e5 events; pixels here have up to some hundreds.
void expect_same_paths(Scene scene) {
    constexpr std::uint32_t samples = 2;
    const auto device = colors_of(render(scene, samples));
    const auto same = support::render(scene, samples);
    ++scene.seed;
    const auto other = support::render(scene, samples);
    int changed = 0, equal = 0;
    for (std::size_t i = 0; i < device.size(); ++i) {
        if (are_equal(same[i], other[i])) continue;
        ++changed;
        equal += are_equal(device[i], same[i]);
    }
    EXPECT_GT(changed, 200);
    EXPECT_GT(equal, 0.97 * changed) << "of " << changed;
}

/// A lamp, the sun and the sky over a floor.
Scene stage() {
    Scene scene = empty_scene(32, 2);
    scene.integrator.max_depth = 40;
    scene.camera.world_from_camera = look_at({0, 1, -6}, {0, 0, 0}, {0, 1, 0});
    add_infinite(scene, Rgb(0.3, 0.4, 0.5));
    add_light(scene, DistantLight{Rgb(2), glm::normalize(glm::dvec3(-2, -5, 3))});
    add_shape(scene, full_sphere(0.6),
              {.material = black, .area_light = add_area_light(scene, {6, 5, 4})},
              translation({2, 3, -1}));
    add_shape(scene, box_mesh({-9, -1.4f, -9}, {9, -1.2f, 9}),
              {.material = add_diffuse(scene, Rgb(0.4))});
    return scene;
}

/// Smoke that glows, in itself and in an instance.
Scene smoke_stage(const Rgb& sigma_s) {
    Scene scene = stage();
    const int smoke = add_medium(scene, {0.3, 0.1, 0.2}, sigma_s, 0.4);
    const Lattice lattice{{-1, -1, -1}, {1, 1, 1}, {17, 12, 20}};
    GridDensity density = lattice.density(
        [](const glm::ivec3& v) { return v.x < 5 ? 0 : (v.x * v.y + 3 * v.z) % 7 / 6.0; }, 4);
    density.temperature = lattice.grid([](const glm::ivec3& v) { return 250.0 * v.y; });
    scene.media[0].density = density;
    scene.media[0].emission = Rgb(0.02);
    add_shape(scene, full_sphere(0.9), {.inside = smoke}, translation({-0.2, 0, 0}));
    scene.objects.push_back({"smoke", {make_shape(full_sphere(0.9), {.inside = smoke})}});
    scene.instances.push_back({0, translation({1.2, 0.3, 1}) * scaling({0.7, 1, 0.8})});
    return scene;
}

/// Air over a plane or a ball.
Scene air_stage(bool is_spherical) {
    Scene scene = stage();
    const int air = add_medium(scene, {0.05, 0.1, 0.2}, {0.5, 1, 2}, 0);
    scene.media[0].density = ExponentialDensity{.is_spherical = is_spherical,
                                                .origin = {0, is_spherical ? -21.2 : -1.2, 0},
                                                .radius = 20,
                                                .scale_height = 0.5};
    add_shape(scene, box_mesh({-3, -1.3f, -3}, {3, 4, 3}), {.inside = air});
    return scene;
}

TEST_F(SamePathsTest, AtBoundaries) {
    const Rgb gold_eta(0.14, 0.37, 1.44), gold_k(3.98, 2.38, 1.6);
    for (const double alpha : {0.0, 0.25}) {
        for (const Rgb& eta : {Rgb(1.5), Rgb(1.45, 1.5, 1.6)}) {
            Scene scene = stage();
            const int milk = add_medium(scene, {0.02, 0.05, 0.1}, {1, 2, 4}, 0.5);
            add_shape(scene, full_sphere(0.8),
                      {.material = add_dielectric(scene, eta, alpha), .inside = milk},
                      translation({-0.9, 0, 0}));
            add_shape(scene, full_sphere(0.8),
                      {.material = add_conductor(scene, gold_eta, gold_k, alpha)},
                      translation({0.9, 0, 0}));
            add_shape(scene, full_sphere(0.5),
                      {.material = add_dielectric(scene, 1.0 / eta, alpha)},
                      translation({0.3, 0.9, -1}));
            add_shape(scene, box_mesh({-1, -1, -2}, {1, 0, -1.9f}),
                      {.material = add_thin_dielectric(scene, eta)});
            expect_same_paths(scene);
        }
    }
}

TEST_F(SamePathsTest, ThroughGrids) {
    for (const Rgb& sigma_s : {Rgb(3), Rgb(0.5, 3, 20)})
        expect_same_paths(smoke_stage(sigma_s));
}

TEST_F(SamePathsTest, ThroughAtmospheres) {
    for (const bool is_spherical : {false, true})
        expect_same_paths(air_stage(is_spherical));
}

TEST_F(SamePathsTest, WithAnalogAbsorptionAndMarchedShadows) {
    for (Scene scene : {smoke_stage(Rgb(0.5, 3, 20)), air_stage(false), air_stage(true)}) {
        scene.integrator.absorption = Integrator::Absorption::analog;
        scene.integrator.transmittance = Integrator::Transmittance::marched;
        scene.integrator.step_size = 0.1;
        expect_same_paths(scene);
    }
}

TEST_F(SamePathsTest, WhereTheyMarch) {
    using Placement = Integrator::Placement;
    for (const Placement placement :
         {Placement::uniform, Placement::jittered, Placement::equiangular})
        for (Scene scene :
             {smoke_stage(Rgb(0.5, 3, 20)), air_stage(placement != Placement::uniform)}) {
            scene.integrator.kind = Integrator::Kind::singlescatter;
            scene.integrator.placement = placement;
            scene.integrator.steps = 5;
            expect_same_paths(scene);
        }
}

TEST_F(SamePathsTest, OnSobolPoints) {
    for (const Sampler sampler : {Sampler::sobol, Sampler::zsobol}) {
        Scene scene = sampler == Sampler::sobol ? smoke_stage(Rgb(0.5, 3, 20)) : air_stage(true);
        scene.sampler = sampler;
        scene.camera.lens_radius = 0.1;
        scene.camera.focal_distance = 6;
        expect_same_paths(scene);
    }
}

TEST_F(SamePathsTest, AmongLightsOfAllKinds) {
    Scene scene = smoke_stage(Rgb(0.5, 3, 20));
    const int lamp = add_area_light(scene, {3, 2, 1}), pane = add_area_light(scene, Rgb(2), true);
    Sphere cut = full_sphere(0.3);
    cut.z_max = 0.1;
    Mesh mesh = square_mesh(0.4, 0, -1);
    mesh.patches = {{0, 1, 3, 2}};
    for (int i = 0; i < 3; ++i) {
        const glm::dmat4 place = translation({2.0 * i - 2, 2.5, 0.4 * i});
        add_light(scene, PointLight{Rgb(2), {2.0 * i - 2, 1.5, -1}});
        add_light(scene, SpotLight{Rgb(9), {2.0 * i - 2, 3, 0}, {0, -0.8, 0.6}, 0.9, 0.7});
        add_shape(scene, Disk{0, 0.3}, {.material = black, .area_light = i == 1 ? pane : lamp},
                  place);
        add_shape(scene, cut, {.material = black, .area_light = lamp}, place);
        add_shape(scene, mesh, {.material = black, .area_light = i == 1 ? lamp : pane}, place);
    }
    expect_same_paths(scene);
}

TEST_F(SamePathsTest, WithoutLightSampling) {
    Scene scene = smoke_stage(Rgb(0.5, 3, 20));
    scene.integrator.samples_lights = false;
    scene.lights.erase(scene.lights.begin() + 1); // the sun, which nothing runs into
    expect_same_paths(scene);
}

} // namespace
} // namespace tyndall::device_test

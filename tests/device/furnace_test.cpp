// White furnaces: where nothing is lost and light of radiance 1 comes from everywhere, radiance is
// 1 everywhere.
#include "device/device_test.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::device_test {
namespace {

using namespace support;

constexpr double kG[] = {-0.9, 0, 0.9};

enum class Boundary { sphere, box, mesh };

/// A boundary of diameter 2 around a medium of that optical diameter, under a uniform sky.
Scene cloud(Boundary boundary, double optical_depth, double g, double albedo) {
    Scene scene = empty_scene(8, 1.2);
    scene.camera.world_from_camera = look_at({1, 2, -4}, {0, 0, 0}, {0, 1, 0});
    scene.integrator.max_depth = 10000000;
    add_infinite(scene);
    const double sigma_t = optical_depth / 2;
    const Finish inside{
        .inside = add_medium(scene, Rgb(sigma_t * (1 - albedo)), Rgb(sigma_t * albedo), g)};
    const Mesh box = box_mesh(glm::vec3(-1), glm::vec3(1));
    switch (boundary) {
    case Boundary::sphere:
        add_shape(scene, full_sphere(1), inside);
        break;
    case Boundary::box:
        add_shape(scene, box, inside);
        break;
    case Boundary::mesh: // turned, so that it needs a hierarchy
        add_shape(scene, box, inside, glm::rotate(glm::dmat4(1), 0.5, glm::dvec3(1, 1, 0)));
        break;
    }
    return scene;
}

double worst_miss(const Image& film) {
    double worst = 0;
    for (const Rgb& color : colors_of(film))
        worst =
            std::max({worst, std::abs(color.r - 1), std::abs(color.g - 1), std::abs(color.b - 1)});
    return worst;
}

/// A path that loses nothing keeps the weight 1, through any number of events; what is left is the
/// rounding of a few sums.
constexpr double kRounding = 1e-6;

class FurnaceTest : public DeviceTest {
  protected:
    static void expect_all_one(Boundary boundary, std::initializer_list<double> depths) {
        for (double depth : depths)
            for (double g : kG)
                EXPECT_LT(worst_miss(render(cloud(boundary, depth, g, 1), 4)), kRounding)
                    << "optical depth " << depth << ", g = " << g;
    }
};

TEST_F(FurnaceTest, Sphere) {
    expect_all_one(Boundary::sphere, {0.01, 0.1, 1, 10, 100});
}
TEST_F(FurnaceTest, Box) {
    expect_all_one(Boundary::box, {0.01, 0.1, 1, 10, 100});
}
TEST_F(FurnaceTest, Mesh) {
    expect_all_one(Boundary::mesh, {0.01, 1, 20});
}

TEST_F(FurnaceTest, DenseMesh) {
    EXPECT_LT(worst_miss(render(cloud(Boundary::mesh, 100, 0.9, 1), 1)), kRounding);
}

TEST_F(FurnaceTest, AbsorptionOfATenThousandthIsSeen) { // the control
    for (Boundary boundary : {Boundary::sphere, Boundary::box, Boundary::mesh})
        EXPECT_GT(worst_miss(render(cloud(boundary, 1, 0, 0.9999), 16)), 10 * kRounding);
}

TEST_F(FurnaceTest, IsothermalEmission) {
    // Emission makes up for absorption where the medium is as hot as its surroundings.
    for (Boundary boundary : {Boundary::sphere, Boundary::box, Boundary::mesh}) {
        Scene scene = cloud(boundary, 2, 0.5, 0.9); // no weight falls to where roulette begins
        scene.media[0].emission = Rgb(1);
        EXPECT_LT(worst_miss(render(scene, 8)), 10 * kRounding);
        scene.media[0].emission = Rgb(1.001); // the control
        EXPECT_GT(worst_miss(render(scene, 8)), 100 * kRounding);
    }
}

TEST_F(FurnaceTest, WhiteSurfaces) {
    Scene scene = cloud(Boundary::mesh, 2, 0.5, 1);
    const int white = add_diffuse(scene, Rgb(1));
    add_shape(scene, full_sphere(0.4), {.material = white, .inside = 0, .outside = 0});
    add_shape(scene, box_mesh(glm::vec3(-1), glm::vec3(1)), {.material = white},
              translation({-1.5, 0, 2.5}));
    EXPECT_LT(worst_miss(render(scene, 8)), kRounding);
    scene.materials[white].reflectance = Rgb(0.999);
    EXPECT_GT(worst_miss(render(scene, 8)), 10 * kRounding);
}

/// Inside a glowing sphere: light sampling and scattering share the work by their weights.
TEST_F(FurnaceTest, GlowingEnclosure) {
    for (double g : kG) {
        for (double depth : {1.0, 8.0}) {
            const auto enclosed = [&](double albedo) {
                Scene scene = cloud(Boundary::sphere, depth, g, albedo);
                scene.lights.clear();
                add_shape(scene, full_sphere(6),
                          {.material = black,
                           .area_light = add_area_light(scene, Rgb(1)),
                           .reverse = true});
                return scene;
            };
            expect_mean(mean_of(enclosed(1), 64), 1, 1.05, 1);
            // Control: 10 % of absorption per scattering.
            EXPECT_GT(mean_of(enclosed(0.9), 64).z(1), reject)
                << "g = " << g << ", depth " << depth;
        }
    }
}

} // namespace
} // namespace tyndall::device_test

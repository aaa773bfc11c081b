// The deeper tier (label "long"): tables to 0.2 %, and grids against homogeneous media over 1e8
// paths.
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "support/materials.h"
#include "support/volumes.h"

#include <cmath>

namespace tyndall::device_test {
namespace {

using namespace support;

constexpr int kPixels = 64; ///< Along an edge.

/// Normal incidence upon a slab 0 <= z <= 1 of refractive index n; light of radiance 1 comes from
/// the camera's side, or from behind. With n = 1 its boundary is an interface.
struct TableCase {
    double albedo, depth, g, n;
    bool is_reflected;
    double truth;
};

double one(const glm::ivec3&) {
    return 1;
}

Scene table_scene(const TableCase& c, bool on_grid) {
    Scene scene = empty_scene(kPixels);
    scene.integrator.max_depth = 1'000'000;
    scene.camera.world_from_camera = translation({0, 0, -2});
    const int medium =
        add_medium(scene, Rgb(c.depth * (1 - c.albedo)), Rgb(c.depth * c.albedo), c.g);
    if (on_grid)
        scene.media[0].density = Lattice{{-2e4, -2e4, 0}, {2e4, 2e4, 1}, {4, 5, 12}}.density(one);
    const int boundary = c.n == 1 ? interface : add_dielectric(scene, Rgb(c.n));
    add_shape(scene, square_mesh(1e4F, 0, -1), {.material = boundary, .inside = medium});
    add_shape(scene, square_mesh(1e4F, 1, 1), {.material = boundary, .inside = medium});
    const int light = add_area_light(scene, Rgb(1), true);
    add_shape(scene, square_mesh(1e6F, c.is_reflected ? -100.0F : 100.0F, 1),
              {.material = black, .area_light = light});
    return scene;
}

/// 1.1 and 1.3 of the converged tables: van de Hulst (1980), Giovanelli (1955; a semi-infinite
/// medium, of which a depth of 60 at albedo 0.9 is all that counts), adding and doubling.
constexpr TableCase kTable[] = {
    {0.9, 2, 0.75, 1, true, 0.0973946},     {0.9, 2, 0.75, 1, false, 0.6609577},
    {0.9, 60, 0, 1.5, true, 0.2599186},     {1, 10, 0, 1.5, true, 0.7756944},
    {1, 10, 0, 1.5, false, 0.2243056},      {0.9, 2, 0.75, 1.4, true, 0.1162129},
    {0.9, 2, 0.75, 1.4, false, 0.5270250},  {0.99, 10, 0.9, 1.33, true, 0.2550080},
    {0.99, 10, 0.9, 1.33, false, 0.4876606}};

class LongTest : public DeviceTest {};

TEST_F(LongTest, SlabsAgreeWithTheTables) {
    for (const TableCase& c : kTable) {
        // Three standard errors of a path that brings 0 or 1 are 0.2 %; ours has less noise.
        const double paths = 9 / (0.002 * 0.002) * (1 - c.truth) / c.truth;
        const auto samples =
            static_cast<std::uint32_t>(std::max(512.0, paths / (kPixels * kPixels)));
        const Estimate seen = mean_of(table_scene(c, false), samples);
        EXPECT_NEAR(seen.mean.g / c.truth, 1, 0.002) << c.truth;
        EXPECT_LT(3 * seen.standard_error.g, 0.002 * c.truth) << "no teeth";
        EXPECT_LT(seen.z(c.truth, 1), 3) << c.truth;
    }
}

/// Light from a constant screen tests flights; a distant light shadow rays.
TEST_F(LongTest, ConstantGridsAreHomogeneous) {
    constexpr std::uint32_t samples = 100'000'000 / (kPixels * kPixels) + 1;
    for (const bool distant : {false, true}) {
        const auto render_one = [&](bool on_grid) {
            Scene scene = table_scene({0.9, 2, 0.75, 1, true, 0}, on_grid);
            if (distant) {
                scene.shapes.pop_back();
                add_light(scene, DistantLight{Rgb(1), glm::normalize(glm::dvec3(1, 0, 1))});
            }
            return mean_of(scene, samples);
        };
        const Estimate grid = render_one(true), homogeneous = render_one(false);
        const double error = std::hypot(grid.standard_error.g, homogeneous.standard_error.g);
        EXPECT_LT(std::abs(grid.mean.g - homogeneous.mean.g) / error, support::pass)
            << grid.mean.g << ' ' << homogeneous.mean.g;
        EXPECT_GT(std::abs(1.005 * grid.mean.g - homogeneous.mean.g) / error, support::reject)
            << "no teeth";
    }
}

} // namespace
} // namespace tyndall::device_test

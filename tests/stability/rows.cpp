#include "stability/rows.h"

#include "support/scenes.h"
#include "support/volumes.h"
#include "volume/majorants.h"

#include <cctype>
#include <cmath>
#include <numbers>

namespace tyndall::stability {
namespace {

using namespace support;
using selftest::Case;
using selftest::in_units;
using selftest::Lit;
using selftest::Slab;
using selftest::slab_scene;

constexpr double kDepth2 = 0.1353352832366127; ///< exp(-2)
/// Mean number of collisions at right angles into a conservative, isotropic slab of depth 100: by
/// reciprocity what leaves one that emits 1 all through, sqrt(3)/2 * 100 * H(1).
constexpr double kCollisions100 = 252;

double one(const glm::ivec3&) {
    return 1;
}
double zero(const glm::ivec3&) {
    return 0;
}

/// A box 1 deep, of a medium with these coefficients, before a sky of radiance 1.
Scene box(const Rgb& sigma_a, const Rgb& sigma_s, double g = 0) {
    Scene scene = slab_scene({0, 0, g}, Lit::both_sides);
    scene.media[0].sigma_a = sigma_a;
    scene.media[0].sigma_s = sigma_s;
    return scene;
}

Scene glowing(double depth) {
    Scene scene = box(Rgb(depth), Rgb(0));
    scene.lights.clear();
    scene.media[0].emission = Rgb(1);
    return scene;
}

/// Turns the camera, so that it looks at the slab at the cosine mu; the azimuth is 0.
Scene seen_at(Scene scene, double mu) {
    const glm::dvec3 along(std::sqrt(1 - mu * mu), 0, mu);
    scene.camera.world_from_camera = look_at(-4.0 * along, {0, 0, 0}, {0, 1, 0});
    return scene;
}

/// A narrow view along an absorbing slab, a thousand times as long as it is thick.
Scene grazing(double depth) {
    Scene scene = seen_at(box(Rgb(depth), Rgb(0)), 1e-3);
    for (double& edge : scene.camera.screen_window)
        edge *= 1e-4; // else rays start within
    return scene;
}

/// Radiance that a slab sends back towards the cosine mu, under parallel light of irradiance pi
/// (perpendicular to it) from the cosine mu0 on the same side.
Scene sunlit(const Slab& slab, double mu0, double mu) {
    Scene scene = seen_at(slab_scene(slab, Lit::both_sides), mu);
    scene.lights.clear();
    const double sine = std::sqrt(1 - mu0 * mu0);
    add_light(scene, DistantLight{Rgb(std::numbers::pi), {0, sine, mu0}});
    return scene;
}

/// The slab on voxels whose planes and cells the rays of pixel centres run in.
Scene in_voxel_planes(const VoxelFunction& density, double sigma_t, const glm::ivec3& count) {
    Scene scene = empty_scene(8, 4);
    trace_pixel_centers(scene); // at odd halves
    scene.camera.world_from_camera = translation({0, 0, -9});
    add_infinite(scene);
    const int medium = add_medium(scene, Rgb(sigma_t), Rgb(0));
    const glm::dvec3 half = 0.5 * glm::dvec3(count - 1);
    const glm::dvec3 middle(0.5, 0.5, 0.5);
    scene.media[0].density = Lattice{middle - half, middle + half, count}.density(density, 1);
    add_shape(scene, full_sphere(100), {.inside = medium});
    scene.camera.medium = medium;
    return scene;
}

/// One voxel of a million among ones, all as hot as the sky: a furnace.
Scene hot_voxel() {
    Scene scene = empty_scene(4);
    scene.camera.world_from_camera = translation({0, 0, -0.4});
    for (double& edge : scene.camera.screen_window)
        edge *= 0.1;
    add_infinite(scene);
    const int cloud = add_medium(scene, Rgb(1), Rgb(0));
    scene.media[0].emission = Rgb(1);
    scene.media[0].density = Lattice{glm::dvec3(-0.1), glm::dvec3(0.1), {9, 9, 9}}.density(
        [](const glm::ivec3& v) { return v == glm::ivec3(4, 4, 4) ? 1e6 : 1.0; });
    add_shape(scene, full_sphere(0.3), {.inside = cloud});
    return scene;
}

/// A single voxel: a density that falls from 2 in the middle to 0 a voxel away on each axis. A thin
/// beam through the middle meets a depth of 2.
Scene one_voxel() {
    Scene scene = empty_scene(8, 1e-6);
    scene.camera.world_from_camera = translation({0, 0, -4});
    add_infinite(scene);
    const int medium = add_medium(scene, Rgb(1), Rgb(0));
    GridDensity density;
    density.lower = glm::dvec3(-1);
    density.density =
        std::make_shared<const Grid>(make_dense_grid(std::vector<float>{2}, {1, 1, 1}));
    density.majorants = build_majorants(*density.density, 1);
    scene.media[0].density = density;
    add_shape(scene, full_sphere(3), {.inside = medium});
    return scene;
}

/// A density that rises along the rays, which run against the order of cells: to no bound but its
/// own cell's is it held.
Scene ramp() {
    Scene scene = empty_scene(8, 0.5);
    scene.camera.world_from_camera = look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0});
    add_infinite(scene);
    const int medium = add_medium(scene, Rgb(4), Rgb(0));
    scene.media[0].density = Lattice{{-1, -1, 0}, {1, 1, 1}, {2, 2, 33}}.density(
        [](const glm::ivec3& v) { return 1 - v.z / 32.0; }, 1);
    add_shape(scene, full_sphere(3), {.inside = medium});
    return scene;
}

/// 1e5 voxels in a row, each of them a cell with a majorant of its own.
Scene long_row_of_cells() {
    constexpr int count = 100'000;
    Scene scene = empty_scene(8, 1e-6);
    scene.camera.world_from_camera = translation({0, 0, -4});
    add_infinite(scene);
    const int medium = add_medium(scene, Rgb(2), Rgb(0));
    scene.media[0].density = Lattice{{-1, -1, 0}, {1, 1, 1}, {2, 2, count}}.density(one, 1);
    add_shape(scene, full_sphere(3), {.inside = medium});
    return scene;
}

/// An opaque planet as seen from far beyond 2^24 of its scale heights, where those are less than
/// the rounding of a distance.
Scene planet_from_afar() {
    constexpr double radius = 1e8;
    Scene scene = empty_scene(64, 1.25 * radius);
    scene.camera.world_from_camera = translation({0, 0, -4 * radius});
    add_infinite(scene);
    scene.camera.medium = add_medium(scene, Rgb(1), Rgb(0));
    ExponentialDensity density;
    density.is_spherical = true;
    density.radius = radius;
    scene.media[0].density = density;
    return scene;
}

/// Layers without an end, seen along them.
Scene along_the_horizon() {
    Scene scene = empty_scene(8, 1e-3);
    add_infinite(scene);
    scene.camera.medium = add_medium(scene, Rgb(1e-3), Rgb(0));
    scene.media[0].density = ExponentialDensity{};
    return scene;
}

/// The camera stands in the boundary of an absorbing box, in its medium.
Scene camera_on_a_boundary() {
    Scene scene = box(Rgb(2), Rgb(0));
    scene.camera.world_from_camera = glm::dmat4(1);
    scene.camera.medium = 0;
    return scene;
}

/// `count` boundaries between equal halves of an absorber of depth 2.
Scene many_boundaries(int count) {
    Scene scene = empty_scene(4, 1);
    scene.camera.world_from_camera = translation({0, 0, -4});
    add_infinite(scene);
    const int even = add_medium(scene, Rgb(2), Rgb(0)), odd = add_medium(scene, Rgb(2), Rgb(0));
    for (int i = 0; i <= count; ++i) {
        const int before = i == 0 ? -1 : i % 2 ? even : odd;
        const int behind = i == count ? -1 : i % 2 ? odd : even;
        add_shape(scene, square_mesh(4, static_cast<float>(i) / static_cast<float>(count), 1),
                  {.inside = before, .outside = behind});
    }
    return scene;
}

/// A box with triangles of no area, and slivers, in its faces.
Scene degenerate_box() {
    Scene scene = box(Rgb(2), Rgb(0));
    auto& mesh = std::get<Mesh>(scene.shapes[0].geometry);
    mesh.triangles.push_back({0, 0, 1});
    mesh.triangles.push_back({2, 2, 2});
    mesh.positions.emplace_back(0, 0, 0); // on the near face, seen edge on
    mesh.positions.emplace_back(0, 0, 1e-30F);
    mesh.positions.emplace_back(1e-20F, 0, 0);
    mesh.triangles.push_back({8, 9, 10});
    return scene;
}

/// A box that is there twice.
Scene coincident_boxes() {
    Scene scene = box(Rgb(2), Rgb(0));
    scene.shapes.push_back(scene.shapes[0]);
    return scene;
}

/// A ball that touches all faces of the box around it, in depths 1 and 1: of any ray, part of the
/// way in each.
Scene touching_ball() {
    Scene scene = empty_scene(16, 0.25);
    scene.camera.world_from_camera = translation({0, 0, -4});
    add_infinite(scene);
    const int around = add_medium(scene, Rgb(1), Rgb(0)),
              within = add_medium(scene, Rgb(1), Rgb(0));
    add_shape(scene, box_mesh(glm::vec3(-1), glm::vec3(1)), {.inside = around});
    add_shape(scene, full_sphere(1), {.inside = within, .outside = around});
    return scene;
}

/// A grey wall under a lamp. Between them are boundaries, behind each of which a ray sets out from
/// a little further on; and next to the lamp, closer than all of that together, a black wall.
Scene lamp_close_to_a_wall() {
    constexpr double far = 16384; // roundings there are 2^-10
    Scene scene = empty_scene(4, 1e-3);
    add_shape(scene, square_mesh(8, far + 4, -1), {.material = add_diffuse(scene, Rgb(0.5))});
    for (int i = 0; i < 4; ++i)
        add_shape(scene, square_mesh(8, 0, -1), {}, translation({0, 0, far + 1.5 + 0.5 * i}));
    add_shape(scene, square_mesh(1, 0, -1), {.material = black},
              translation({3, 0, far + 1 - 0.0625}));
    add_light(scene, PointLight{Rgb(1), {3, 0, far + 1}});
    return scene;
}

/// A lamp in the middle of a dense ball. All of its light leaves, the same to all sides: seen from
/// one, its intensity is the radiance times the area of the picture, but for what comes straight.
Scene lamp_in_a_dense_ball() {
    Scene scene = empty_scene(16, 1);
    scene.integrator.max_depth = 1'000'000;
    scene.camera.world_from_camera = translation({0, 0, -4});
    add_light(scene, PointLight{Rgb(4), {0, 0, 0}});
    add_shape(scene, full_sphere(1), {.inside = add_medium(scene, Rgb(0), Rgb(4))});
    return scene;
}

/// Within a ball that glows and reflects, so that no radiance but 1 is in balance.
Scene enclosure(double reflectance) {
    Scene scene = empty_scene(16, 0.5);
    add_shape(scene, full_sphere(1),
              {.material = add_diffuse(scene, Rgb(reflectance)),
               .area_light = add_area_light(scene, Rgb(1 - reflectance)),
               .reverse = true});
    return scene;
}

/// Channels that glow 60 orders of magnitude apart.
Scene glow_of_all_magnitudes() {
    Scene scene = glowing(2);
    scene.media[0].emission = {1e30, 1, 1e-30};
    return scene;
}

Scene chromatic(const Rgb& depths, double albedo) {
    return box((1 - albedo) * depths, albedo * depths);
}

std::vector<Case> absorption() {
    const double lit_at_45 = 0.5 / std::numbers::pi * std::sqrt(0.5) / 18;
    return {
        {"sigma 0", box(Rgb(0), Rgb(0)), 16, Rgb(1)},
        {"sigma denormal", box(Rgb(1e-45), Rgb(1e-40)), 16, Rgb(1)},
        {"sigma 1e-30", box(Rgb(1e-30), Rgb(1e-30)), 16, Rgb(1)},
        {"absorption 1e30", box(Rgb(1e30), Rgb(0)), 16, Rgb(0)},
        {"absorption depth 80", box(Rgb(80), Rgb(0)), 16, Rgb(1.8048513878454153e-35), 4e-5},
        {"glow of depth 1e-8", glowing(1e-8), 16, Rgb(1e-8)},
        {"glow of depth 1e6", glowing(1e6), 16, Rgb(1)},
        {"units of 1e-9", in_units(box(Rgb(2), Rgb(0)), 1e9), 16, Rgb(kDepth2)},
        {"units of 1e6", in_units(box(Rgb(2), Rgb(0)), 1e-6), 16, Rgb(kDepth2)},
        {"grazing", grazing(2e-3), 16, Rgb(kDepth2), 1e-4},
        {"camera on a boundary", camera_on_a_boundary(), 16, Rgb(kDepth2)},
        // Beyond a boundary an origin stands by 16 roundings of its distance from the camera, below
        // 8: so much of the way is not seen, per boundary, of a medium with sigma_t = 2.
        {"100 boundaries", many_boundaries(100), 16, Rgb(kDepth2), 100 * 2 * 16 * 0x1p-21},
        {"degenerate triangles", degenerate_box(), 16, Rgb(kDepth2), 2 * 2 * 16 * 0x1p-21},
        {"coincident boxes", coincident_boxes(), 16, Rgb(kDepth2), 2 * 2 * 16 * 0x1p-21},
        {"touching ball", touching_ball(), 16, Rgb(kDepth2), 2 * 2 * 16 * 0x1p-21},
        {"glow of 1e30, 1 and 1e-30", glow_of_all_magnitudes(), 16,
         (1 - kDepth2) * Rgb(1e30, 1, 1e-30)},
        {"enclosure of reflectance 0.3", enclosure(0.3), 4096, Rgb(1)},
        {"enclosure of reflectance 0.9", enclosure(0.9), 256, Rgb(1)},
        {"lamp in a dense ball", lamp_in_a_dense_ball(), 65536, Rgb(1 - std::exp(-4.0))},
        {"lamp close to a wall", lamp_close_to_a_wall(), 16, Rgb(lit_at_45), 2e-3},
    };
}

std::vector<Case> grids() {
    const glm::ivec3 cube{11, 11, 9}; // its faces are beyond the picture
    return {
        // 7e4 null collisions of weight 1 - 1e-6 a path; rounded to a float, that weight alone
        // would
        // leave 1e-4 too little.
        {"hot voxel", hot_voxel(), 1, Rgb(1), 5e-5},
        {"grid of zeros", in_voxel_planes(zero, 1e6, cube), 1, Rgb(1)},
        {"one voxel", one_voxel(), 4096, Rgb(kDepth2)},
        {"ramp", ramp(), 4096, Rgb(kDepth2)},
        // The depth of a cell is 2e-5, of which each subtraction loses 2^-24 of a flight's at most.
        {"100000 cells", long_row_of_cells(), 64, Rgb(kDepth2), 100'000 * 2 * 0x1p-24},
        {"along the horizon", along_the_horizon(), 1, Rgb(0)},
        {"planet from afar", planet_from_afar(), 16, Rgb(1 - std::numbers::pi / 6.25)},
        // 8 deep; tracked by null collisions, which leave all light or none.
        {"rays in planes of voxels", in_voxel_planes(one, 0.1, cube), 4096, Rgb(std::exp(-0.8))},
    };
}

/// Tables: adding and doubling to all digits (Slab), DISORT's problems converged (sunlit),
/// Chandrasekhar's H (half space under a uniform sky).
std::vector<Case> tables() {
    return {
        {"albedo 0.2", slab_scene({0.2, 10, 0}, Lit::both_sides), 2048, Rgb(0.0352305 + 0.0000115)},
        {"conservative, depth 64", slab_scene({1, 64, 0}, Lit::near_side), 16, Rgb(0.9743381)},
        {"conservative, depth 1000", slab_scene({1, 1000, 0}, Lit::both_sides), 2, Rgb(1)},
        {"albedo 1 - 2^-24", slab_scene({1 - 0x1p-24, 100, 0}, Lit::both_sides), 8,
         Rgb(1 - kCollisions100 * 0x1p-24), 2e-5},
        {"g 0.99, depth 10", slab_scene({0.99, 10, 0.99}, Lit::both_sides), 512,
         Rgb(0.0187319 + 0.8768297)},
        {"g -0.5, depth 2", slab_scene({0.9, 2, -0.5}, Lit::both_sides), 512,
         Rgb(0.4627721 + 0.2760717)},
        {"extinction 100 to 1",
         chromatic({0.1, 1, 10}, 0.9),
         2048,
         {0.0421014 + 0.9467464, 0.8590354, 0.4205471}},
        {"half space at mu 0.5", seen_at(slab_scene({0.8, 60, 0}, Lit::both_sides), 0.5), 1024,
         Rgb(1 - 1.413262569 * std::sqrt(0.2))},
        {"X2 at mu 0.5", sunlit({1, 1, 0}, 1, 0.5), 1024, Rgb(0.3805144)},
        {"X2 reversed", sunlit({1, 1, 0}, 0.5, 1), 1024, Rgb(0.5 * 0.3805144)},
        {"X4 at mu 0.5", sunlit({0.9, 2, 0.75}, 1, 0.5), 2048, Rgb(0.1195622)},
        {"X4 reversed", sunlit({0.9, 2, 0.75}, 0.5, 1), 2048, Rgb(0.5 * 0.1195622)},
    };
}

/// Of a test: letters, digits and underscores.
std::string plain(std::string name) {
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}

} // namespace

const std::vector<Case>& rows() {
    static const std::vector<Case> all = [] {
        std::vector<Case> list = selftest::cases();
        for (const auto& more : {absorption(), grids(), tables()})
            list.insert(list.end(), more.begin(), more.end());
        for (Case& c : list)
            c.name = plain(c.name);
        return list;
    }();
    return all;
}

} // namespace tyndall::stability

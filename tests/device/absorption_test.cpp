// Pure absorption has a closed form in every pixel, and no noise: exp(-sigma_a d).
#include "device/device_test.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace tyndall::device_test {
namespace {

using namespace support;

constexpr int kPixels = 33;
constexpr double kHalf = 2;         ///< Of the window, in scene units.
constexpr double kTolerance = 1e-5; // asked for, in every pixel
const Rgb kSigmaA(0.25, 0.5, 1);

struct Ray {
    glm::dvec3 origin, direction;
};

/// Parallel rays through the centres of the pixels.
Scene oblique_view(const glm::dvec3& eye) {
    Scene scene = empty_scene(kPixels, kHalf);
    trace_pixel_centers(scene);
    scene.camera.world_from_camera = look_at(eye, {0, 0, 0}, {0, 1, 0});
    add_infinite(scene);
    return scene;
}

Ray ray_of(const Scene& scene, int x, int y) {
    const double step = 2 * kHalf / kPixels;
    const glm::dvec4 film(-kHalf + (x + 0.5) * step, kHalf - (y + 0.5) * step, 0, 1);
    const glm::dmat4& m = scene.camera.world_from_camera;
    return {glm::dvec3(m * film), glm::dvec3(m[2])};
}

Ray in_object(const Ray& ray, const glm::dmat4& world_from_object) {
    const glm::dmat4 m = glm::inverse(world_from_object);
    return {glm::dvec3(m * glm::dvec4(ray.origin, 1)),
            glm::dvec3(m * glm::dvec4(ray.direction, 0))};
}

/// Where a ray is in a medium.
struct Chord {
    double length = 0;
    double cosine = 1; ///< The least with which the ray meets the boundary.
};

/// In the cube [-1, 1]^3, as `in_world` sees it.
Chord box_chord(const Ray& in_world, const glm::dmat4& world_from_object = glm::dmat4(1)) {
    const Ray ray = in_object(in_world, world_from_object);
    double near = 0, far = 1e30;
    int near_axis = 0, far_axis = 0;
    for (int i = 0; i < 3; ++i) {
        if (ray.direction[i] == 0) {
            if (std::abs(ray.origin[i]) > 1) return {};
            continue;
        }
        const double a = (-1 - ray.origin[i]) / ray.direction[i];
        const double b = (1 - ray.origin[i]) / ray.direction[i];
        if (std::min(a, b) > near) near = std::min(a, b), near_axis = i;
        if (std::max(a, b) < far) far = std::max(a, b), far_axis = i;
    }
    if (near >= far) return {};
    const glm::dvec3 d = glm::abs(glm::normalize(ray.direction));
    return {far - near, std::min(d[near_axis], d[far_axis])};
}

/// In the unit sphere, likewise.
Chord sphere_chord(const Ray& in_world, const glm::dmat4& world_from_object = glm::dmat4(1)) {
    const Ray ray = in_object(in_world, world_from_object);
    const double a = glm::dot(ray.direction, ray.direction);
    const double b = glm::dot(ray.origin, ray.direction);
    const double c = glm::dot(ray.origin, ray.origin) - 1;
    const double root = std::sqrt(std::max(0.0, b * b - a * c));
    const double near = std::max(0.0, (-b - root) / a), far = std::max(0.0, (-b + root) / a);
    return root > 0 ? Chord{far - near, root / std::sqrt(a)} : Chord{};
}

using Depth = std::function<Chord(const Ray&)>;

/// Where the ray that crosses a boundary begins anew, off it by the error of the hit point, its
/// length changes by about that error over the cosine. Beside a hierarchy (where there is nothing
/// to cross) it does not.
enum class Crossing { exact, rounded };

/// The largest difference from exp(-sigma_a depth), over pixels and channels, in units of what is
/// allowed.
double worst_difference(const Scene& scene, const Image& film, const Depth& depth,
                        Crossing crossing, const Rgb& sigma_a) {
    double worst = 0;
    const std::vector<Rgb> colors = colors_of(film);
    for (int y = 0; y < kPixels; ++y) {
        for (int x = 0; x < kPixels; ++x) {
            const Chord chord = depth(ray_of(scene, x, y));
            const auto pixel = static_cast<std::size_t>(y * kPixels + x);
            const Rgb off = glm::abs(colors[pixel] - glm::exp(-sigma_a * chord.length));
            const double allowed =
                crossing == Crossing::exact ? kTolerance : kTolerance / chord.cosine;
            worst = std::max(worst, std::max({off.r, off.g, off.b}) / allowed);
        }
    }
    return worst;
}

void expect_beer(const Scene& scene, const Depth& depth, Crossing crossing) {
    const Image film = render(scene, 16);
    EXPECT_LT(worst_difference(scene, film, depth, crossing, kSigmaA), 1);
    // No noise, but for the rounding of the film's sums.
    for (int c = 0; c < 3; ++c)
        EXPECT_LT(mean_of(film).standard_error[c], std::numeric_limits<float>::epsilon());
    // Control: a tenth of a percent more absorption.
    EXPECT_GT(worst_difference(scene, film, depth, crossing, 1.001 * kSigmaA), 1);
}

class AbsorptionTest : public DeviceTest {
  protected:
    /// Turned, and of different size in each direction.
    const glm::dmat4 placed_ =
        glm::rotate(translation({0.1, -0.2, 0.3}), 0.7, glm::dvec3(1, 2, 3)) *
        scaling({1, 0.7, 1.2});
    Scene scene_ = oblique_view({1, 2, -4});
    int dye_ = add_medium(scene_, kSigmaA, Rgb(0));
    /// Something to hit, far beside the picture, so that the scene needs a hierarchy.
    void force_hierarchy() {
        add_shape(scene_, Disk{.radius = 0.1}, {.material = black}, translation({50, 0, 0}));
    }
    void expect_geometry(std::uint32_t geometry) const {
        EXPECT_EQ(compute_effects(scene_).features.geometry, geometry);
    }
};

TEST_F(AbsorptionTest, BoxAlone) {
    add_shape(scene_, box_mesh(glm::vec3(-1), glm::vec3(1)), {.inside = dye_});
    expect_geometry(shared::GEOMETRY_BOX);
    expect_beer(
        scene_, [](const Ray& ray) { return box_chord(ray); }, Crossing::exact);
}

TEST_F(AbsorptionTest, BoxInAHierarchy) {
    add_shape(scene_, box_mesh(glm::vec3(-1), glm::vec3(1)), {.inside = dye_});
    force_hierarchy();
    expect_geometry(shared::GEOMETRY_BVH);
    expect_beer(
        scene_, [](const Ray& ray) { return box_chord(ray); }, Crossing::exact);
}

TEST_F(AbsorptionTest, TurnedBox) {
    add_shape(scene_, box_mesh(glm::vec3(-1), glm::vec3(1)), {.inside = dye_}, placed_);
    expect_geometry(shared::GEOMETRY_BVH);
    expect_beer(
        scene_, [&](const Ray& ray) { return box_chord(ray, placed_); }, Crossing::rounded);
}

TEST_F(AbsorptionTest, EllipsoidAlone) {
    add_shape(scene_, full_sphere(1), {.inside = dye_}, placed_);
    expect_geometry(shared::GEOMETRY_ELLIPSOID);
    expect_beer(
        scene_, [&](const Ray& ray) { return sphere_chord(ray, placed_); }, Crossing::exact);
}

TEST_F(AbsorptionTest, EllipsoidInAHierarchy) {
    add_shape(scene_, full_sphere(1), {.inside = dye_}, placed_);
    force_hierarchy();
    expect_geometry(shared::GEOMETRY_BVH);
    expect_beer(
        scene_, [&](const Ray& ray) { return sphere_chord(ray, placed_); }, Crossing::rounded);
}

TEST_F(AbsorptionTest, CameraInTheMedium) {
    const glm::dvec3 eye(0.1, 0.05, -0.2);
    const double shrink = 0.1; // of the window
    scene_.camera.world_from_camera = look_at(eye, {0.4, 0.3, 1}, {0, 1, 0});
    for (double& edge : scene_.camera.screen_window)
        edge *= shrink;
    scene_.camera.medium = dye_;
    add_shape(scene_, full_sphere(1), {.inside = dye_});
    const auto depth = [&](const Ray& ray) { // ray_of is for the whole window
        return sphere_chord({eye + shrink * (ray.origin - eye), ray.direction});
    };
    expect_beer(scene_, depth, Crossing::exact);
}

TEST_F(AbsorptionTest, NestedMedia) {
    const int core = add_medium(scene_, 2.0 * kSigmaA, Rgb(0));
    const glm::dmat4 inner = translation({0.3, 0.1, 0}) * scaling(glm::dvec3(0.4));
    add_shape(scene_, full_sphere(1), {.inside = dye_});
    add_shape(scene_, box_mesh(glm::vec3(-1), glm::vec3(1)), {.inside = core, .outside = dye_},
              inner);
    const auto depth = [&](const Ray& ray) {
        const Chord outer = sphere_chord(ray), core_chord = box_chord(ray, inner);
        // The core is twice as dense: it counts twice. Four boundaries share the tolerance.
        return Chord{outer.length + core_chord.length,
                     std::min(outer.cosine, core_chord.cosine) / 2};
    };
    expect_beer(scene_, depth, Crossing::rounded);
}

TEST_F(AbsorptionTest, ManyBoundaries) {
    const int layers = 20;
    const double thickness = 1.0 / layers; // half of the cube, in slices
    const Mesh slice = box_mesh({-1, -1, -thickness / 2}, {1, 1, thickness / 2});
    std::vector<glm::dmat4> places;
    for (int i = 0; i < layers; ++i) {
        places.push_back(translation({0, 0, -1 + (2 * i + 0.5) * thickness}));
        add_shape(scene_, slice, {.inside = dye_}, places.back());
    }
    const auto depth = [&](const Ray& ray) {
        Chord sum;
        double share = 0; // of the tolerance, that each slice takes
        for (const glm::dmat4& place : places) {
            const Chord chord = box_chord(ray, place * scaling({1, 1, thickness / 2}));
            const glm::dvec3 d = glm::abs(ray.direction);
            if (chord.length > 0) share += 1 / std::min({d.x, d.y, d.z});
            sum.length += chord.length;
        }
        if (share > 0) sum.cosine = 1 / share;
        return sum;
    };
    expect_beer(scene_, depth, Crossing::rounded);
}

TEST_F(AbsorptionTest, OpticalDepthsOfNoiseAndOfNight) {
    for (double sigma : {1e-6, 30.0}) {
        Scene scene = oblique_view({0, 0, -4});
        add_shape(scene, box_mesh(glm::vec3(-1), glm::vec3(1)),
                  {.inside = add_medium(scene, Rgb(sigma), Rgb(0))});
        const double middle = render(scene, 1).at(kPixels / 2, kPixels / 2, 0);
        // Six digits of the transmittance itself, however small; half a float step near 1.
        EXPECT_NEAR(middle, std::exp(-2 * sigma), 1e-6 * std::exp(-2 * sigma) * (1 + 2 * sigma));
    }
}

} // namespace
} // namespace tyndall::device_test

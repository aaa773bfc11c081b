// Rays of the cameras by hand, and the pixel filter.
#include "reference/camera.h"
#include "support/estimates.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace tyndall::reference {
namespace {

Scene perspective_scene(int width, int height, double fov) {
    Scene scene = support::empty_scene(1);
    scene.camera.kind = Camera::Kind::perspective;
    scene.camera.screen_window_given = false;
    scene.camera.fov = fov;
    scene.film.width = width;
    scene.film.height = height;
    scene.film.bounds = {0, width, 0, height};
    support::trace_pixel_centers(scene);
    return scene;
}

void expect_direction(const Scene& scene, int x, int y, const dvec3& expected) {
    const Ray ray = PathCamera(scene).sample(x, y, {{1, 0}, 0, 0}).ray;
    const dvec3 direction = glm::normalize(expected);
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(ray.direction[i], direction[i], 1e-12);
}

TEST(PerspectiveCamera, FovIsThatOfTheShorterAxis) {
    const Scene wide = perspective_scene(400, 200, 90); // One unit of the screen is 100 pixels.
    expect_direction(wide, 0, 0, {-1.995, 0.995, 1});
    expect_direction(wide, 399, 199, {1.995, -0.995, 1});
    const Scene tall = perspective_scene(200, 400, 60);
    expect_direction(tall, 0, 0, {-0.995 / std::sqrt(3.0), 1.995 / std::sqrt(3.0), 1});
}

TEST(PerspectiveCamera, ScreenWindowAndFrameAspectRatioAreKept) {
    Scene scene = perspective_scene(100, 100, 90);
    scene.camera.frame_aspect_ratio = 2;
    expect_direction(scene, 0, 0, {-1.98, 0.99, 1});
    scene.camera.screen_window = {0, 1, 0, 0.5};
    scene.camera.screen_window_given = true;
    expect_direction(scene, 99, 0, {0.995, 0.4975, 1});
}

TEST(PerspectiveCamera, LooksWhereItIsTurned) {
    Scene scene = perspective_scene(101, 101, 40);
    scene.camera.world_from_camera = support::look_at({1, 2, 3}, {4, -2, 8}, {0, 1, 0});
    expect_direction(scene, 50, 50, {3, -4, 5});
    EXPECT_EQ(PathCamera(scene).position(), dvec3(1, 2, 3));
    EXPECT_EQ(PathCamera(scene).sample(50, 50, {}).ray.origin, dvec3(0));
}

TEST(OrthographicCamera, RaysAreParallel) {
    Scene scene = support::empty_scene(10, 5);
    support::trace_pixel_centers(scene);
    const Ray ray = PathCamera(scene).sample(9, 0, {}).ray;
    EXPECT_NEAR(glm::length(ray.origin - dvec3(4.5, 4.5, 0)), 0, 1e-12);
    EXPECT_EQ(ray.direction, dvec3(0, 0, 1));
}

/// Rays of one film point meet in focus, and start all over the lens.
TEST(ThinLens, FocusesAtItsDistance) {
    for (const Camera::Kind kind : {Camera::Kind::perspective, Camera::Kind::orthographic}) {
        Scene scene = perspective_scene(100, 100, 50);
        scene.camera.kind = kind;
        scene.camera.lens_radius = 0.3;
        scene.camera.focal_distance = 7;
        const PathCamera camera(scene);
        dvec3 focus(0), mean(0);
        double spread = 0;
        constexpr int n = 2000;
        for (std::uint32_t i = 0; i < n; ++i) {
            const Ray ray = camera.sample(80, 30, {{1, 0}, 5, i}).ray;
            const dvec3 at = ray.origin + ray.direction * (7 / ray.direction.z);
            if (i == 0) focus = at;
            EXPECT_LT(glm::length(at - focus), 1e-11);
            const dvec3 on_lens =
                kind == Camera::Kind::perspective ? ray.origin : ray.origin - dvec3(0.61, 0.39, 0);
            EXPECT_LE(glm::length(on_lens), 0.3 + 1e-12);
            mean += on_lens / static_cast<double>(n);
            spread += glm::dot(on_lens, on_lens) / n;
        }
        EXPECT_LT(glm::length(mean), support::pass * 0.3 / std::sqrt(n));
        EXPECT_NEAR(spread, 0.09 / 2, support::pass * 0.09 / std::sqrt(12.0 * n)); // Uniform disc.
    }
}

TEST(ConcentricDisk, CoversTheDiscEvenlyAndKeepsItsCenter) {
    EXPECT_EQ(concentric_disk(0.5, 0.5), dvec2(0));
    EXPECT_NEAR(glm::length(concentric_disk(0, 0.3)), 1, 1e-15);
    EXPECT_NEAR(concentric_disk(1, 0.5).x, 1, 1e-15);
    EXPECT_NEAR(concentric_disk(0.5, 1).y, 1, 1e-15);
}

/// Weights of -1 are made up for by the sum of weights: a constant picture is what it is.
TEST(PixelFilter, NegativeLobesKeepConstants) {
    Scene scene = support::empty_scene(4);
    scene.filter.kind = PixelFilter::Kind::mitchell;
    scene.filter.x_radius = scene.filter.y_radius = 2;
    support::add_infinite(scene, Rgb(0.25, 1, 3));
    bool negative = false;
    for (std::uint32_t i = 0; i < 200; ++i)
        negative |= PathCamera(scene).sample(1, 1, {{0, 0}, 1, i}).weight < 0;
    EXPECT_TRUE(negative);
    for (const Rgb& color : support::render(scene, 64)) {
        EXPECT_NEAR(color.x, 0.25, 1e-13);
        EXPECT_NEAR(color.z, 3, 1e-12);
    }
}

/// The mean of the offsets' squares is the second moment of the filter.
TEST(PixelFilter, OffsetsHaveTheMomentsOfTheFilter) {
    Scene scene = support::empty_scene(1, 0.5); // One pixel is one unit wide.
    scene.filter = {};
    scene.filter.kind = PixelFilter::Kind::triangle;
    scene.filter.x_radius = 2;
    scene.filter.y_radius = 1;
    const PathCamera camera(scene);
    constexpr int n = 200000;
    dvec2 squares(0);
    for (std::uint32_t i = 0; i < n; ++i) {
        const dvec3 p = camera.sample(0, 0, {{0, 0}, 0, i}).ray.origin;
        squares += dvec2(p.x * p.x, p.y * p.y) / static_cast<double>(n);
    }
    // Triangle of radius r: r^2 / 6; its square has mean r^4 / 15.
    const double error = std::sqrt((1 / 15.0 - 1 / 36.0) / n);
    EXPECT_NEAR(squares.x, 4 / 6.0, support::pass * 4 * error);
    EXPECT_NEAR(squares.y, 1 / 6.0, support::pass * error);
    EXPECT_GT(std::abs(squares.y - 1.02 / 6), support::reject * error);
}

} // namespace
} // namespace tyndall::reference

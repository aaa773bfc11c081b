// From samples to pixels: filters, the limit of radiance, exposure.
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "scene/filter.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::device_test {
namespace {

using namespace support;

PixelFilter filter(PixelFilter::Kind kind, double x_radius, double y_radius) {
    return {.kind = kind, .x_radius = x_radius, .y_radius = y_radius};
}
const PixelFilter kFilters[] = {
    filter(PixelFilter::Kind::box, 0.5, 0.8),
    filter(PixelFilter::Kind::triangle, 2, 1.3),
    filter(PixelFilter::Kind::gaussian, 1.5, 2),
    filter(PixelFilter::Kind::mitchell, 2, 1.5),
};

class FilmTest : public DeviceTest {};

TEST_F(FilmTest, ConstantPicturesStayConstant) {
    for (const PixelFilter& f : kFilters) {
        Scene scene = empty_scene(16);
        scene.filter = f;
        add_infinite(scene, {1, 0.25, 3});
        for (const Rgb& color : colors_of(render(scene, 37)))
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(color[c] / Rgb(1, 0.25, 3)[c], 1, 1e-6); // rounding of sum and quotient
    }
}

constexpr int kPixels = 16; ///< Of size 1: a window of [-8, 8]^2
constexpr double kEdge = 0.3;

/// Dark below the edge, 1 above; along x, or along y.
Scene step_edge(const PixelFilter& f, bool along_y) {
    Scene scene = empty_scene(kPixels, kPixels / 2.0);
    scene.filter = f;
    add_infinite(scene);
    const glm::dmat4 turn =
        glm::rotate(glm::dmat4(1), along_y ? std::acos(0.0) : 0.0, glm::dvec3(0, 0, 1));
    add_shape(scene, square_mesh(100, 5, -1), {.material = black},
              turn * translation({kEdge - 100, 0, 0}));
    return scene;
}

/// What a pixel with its centre at x sees of the bright side.
double profile(const PixelFilter& f, double radius, double x) {
    constexpr int steps = 20000;
    double all = 0, bright = 0;
    for (int i = 0; i < steps; ++i) {
        const double offset = radius * (2 * (i + 0.5) / steps - 1);
        const double weight = evaluate_filter(f, radius, offset);
        all += weight;
        if (x + offset > kEdge) bright += weight;
    }
    return bright / all;
}

/// Mean over the line of pixels at a position along the axis, which grows to the right or up.
Estimate line_mean(const Image& film, int position, bool along_y) {
    Estimate line{};
    for (int i = 0; i < kPixels; ++i) {
        const std::size_t at =
            along_y ? film.offset(i, kPixels - 1 - position) : film.offset(position, i);
        line.mean += film.pixels[at] / double{kPixels};
        line.standard_error += film.pixels[at + 3] / double{kPixels * kPixels};
    }
    line.standard_error = glm::sqrt(line.standard_error);
    return line;
}

double worst_z(const Image& film, const PixelFilter& f, bool along_y) {
    double worst = 0;
    for (int i = 0; i < kPixels; ++i) {
        const double truth = profile(f, along_y ? f.y_radius : f.x_radius, i + 0.5 - kPixels / 2.0);
        // Sums of weights that should be 0 or 1 are so up to rounding.
        if (std::abs(line_mean(film, i, along_y).mean.g - truth) > 1e-6)
            worst = std::max(worst, line_mean(film, i, along_y).z(truth));
    }
    return worst;
}

TEST_F(FilmTest, AnEdgeShowsTheProfileOfTheFilter) {
    for (const PixelFilter& f : kFilters) {
        for (bool along_y : {false, true}) {
            const Image film = render(step_edge(f, along_y), 1024);
            EXPECT_LT(worst_z(film, f, along_y), pass) << static_cast<int>(f.kind);
            PixelFilter wrong = f;
            (f.kind == PixelFilter::Kind::gaussian ? wrong.sigma
             : along_y                             ? wrong.y_radius
                                                   : wrong.x_radius) *= 1.2;
            EXPECT_GT(worst_z(film, wrong, along_y), reject) << static_cast<int>(f.kind);
        }
    }
}

TEST_F(FilmTest, RadianceIsLimitedByItsLargestComponent) {
    Scene scene = empty_scene(8);
    add_infinite(scene, {10, 5, 1});
    EXPECT_EQ(colors_of(render(scene, 8))[3], Rgb(10, 5, 1)); // the control
    scene.film.max_component_value = 2;
    for (const Rgb& color : colors_of(render(scene, 8)))
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(color[c], Rgb(2, 1, 0.2)[c], 1e-6);
}

TEST_F(FilmTest, ExposureScalesThePicture) {
    Scene scene = plain_scene();
    const std::vector<Rgb> once = colors_of(render(scene, 4));
    scene.film.iso = 400;
    std::vector<Rgb> four_times = colors_of(render(scene, 4));
    EXPECT_NE(four_times, once);
    for (Rgb& color : four_times)
        color /= 4.0;
    EXPECT_EQ(four_times, once); // powers of two are exact
    scene.film.iso = 100;
    scene.camera.shutter_seconds = 0.5;
    std::vector<Rgb> half = colors_of(render(scene, 4));
    for (Rgb& color : half)
        color *= 2.0;
    EXPECT_EQ(half, once);
}

TEST_F(FilmTest, VarianceIsThatOfTheMean) {
    // Of 64 pictures with seeds of their own, the means scatter as each says that it may.
    Scene scene = plain_scene();
    const int pictures = 64;
    double sum = 0, square = 0, stated = 0;
    for (int i = 0; i < pictures; ++i) {
        scene.seed = static_cast<std::uint64_t>(i);
        const Estimate mean = mean_of(scene, 16);
        sum += mean.mean.g;
        square += mean.mean.g * mean.mean.g;
        stated += mean.standard_error.g * mean.standard_error.g / pictures;
    }
    const double n = pictures;
    const double found = (square / n - sum / n * sum / n) * n / (n - 1);
    // A variance from n values has a relative standard error of sqrt(2 / (n - 1)).
    const double error = std::sqrt(2 / (n - 1));
    EXPECT_LT(std::abs(found / stated - 1) / error, pass);
    EXPECT_GT(std::abs(found / (stated / 4) - 1) / error, reject); // errors half as large
}

/// By powers of two, pictures of 1e-30 and of 1e30 are those of 1, and their errors are known as
/// well, though squares of such numbers are none.
TEST_F(FilmTest, ErrorsAreToldOfAnyRadiance) {
    Scene scene = plain_scene();
    scene.lights.clear();
    const auto image = [&](const Rgb& sky, double& error) {
        scene.lights.clear();
        add_infinite(scene, sky);
        Renderer renderer(context(), scene);
        renderer.render(0, 64);
        const Image film = renderer.read_film();
        error = renderer.error() ? renderer.error()->relative_rmse : 0;
        for (const float value : film.pixels)
            EXPECT_TRUE(std::isfinite(value));
        return colors_of(film);
    };
    double plain_error, error;
    const std::vector<Rgb> plain = image(Rgb(1), plain_error);
    ASSERT_GT(plain_error, 0);
    for (const double sky : {0x1p-100, 0x1p100}) {
        std::vector<Rgb> pixels = image(Rgb(sky), error);
        for (Rgb& pixel : pixels)
            pixel /= sky;
        EXPECT_EQ(pixels, plain);
        EXPECT_EQ(error, plain_error);
    }
    // Side by side, the error is that of what is bright.
    const std::vector<Rgb> pixels = image({0x1p100, 1, 0x1p-100}, error);
    const auto pixel = plain.size() / 2;
    EXPECT_EQ(pixels[pixel] * Rgb(0x1p-100, 1, 0x1p100), plain[pixel]);
    image({1, 0, 0}, plain_error);
    EXPECT_NEAR(error, plain_error, 1e-6 * plain_error);
    image({0, 0, 1}, plain_error); // the control: another channel has another error
    EXPECT_GT(std::abs(error - plain_error), 1e-3 * plain_error);
}

} // namespace
} // namespace tyndall::device_test

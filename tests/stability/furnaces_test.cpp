// White furnaces for everything there is: each phase function, kind of medium and smooth material
// stands in a square of its own of one picture, lit by radiance 1 from everywhere, and is not to be
// seen. (What rough boundaries lose, as they must, is in device.rough_boundary.)
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "support/materials.h"
#include "support/phases.h"
#include "support/volumes.h"

#include <cmath>
#include <functional>

namespace tyndall::stability {
namespace {

using namespace support;

constexpr int kAcross = 5, kPixels = 8; ///< Exhibits along an edge, pixels along that of one.

/// What becomes of the light.
struct Climate {
    double loss = 0;     ///< Absorption over scattering of media; what white surfaces absorb.
    double emission = 0; ///< Of media.
};

struct Exhibit {
    const char* name;
    /// Adds it around the origin of `place`, within a radius of 1.
    std::function<void(Scene&, const Climate&, const glm::dmat4& place)> add;
};

int add_fog(Scene& scene, const Climate& climate, const Rgb& sigma_s, double g = 0) {
    const int medium = add_medium(scene, climate.loss * sigma_s, sigma_s, g);
    scene.media.back().emission = Rgb(climate.emission);
    return medium;
}

/// A ball of a medium, which `change` makes what it is.
Exhibit fog_ball(const char* name, double sigma, const std::function<void(Medium&)>& change) {
    return {name, [=](Scene& scene, const Climate& climate, const glm::dmat4& place) {
                const int medium = add_fog(scene, climate, Rgb(sigma));
                scene.media.back().world_from_medium = place;
                change(scene.media.back());
                add_shape(scene, full_sphere(0.9), {.inside = medium}, place);
            }};
}

Exhibit of_phase(const char* name, double sigma, const std::vector<PhaseFunction>& phases) {
    return fog_ball(name, sigma, [=](Medium& medium) { medium.phases = phases; });
}

Exhibit of_density(const char* name,
                   const std::variant<std::monostate, GridDensity, ExponentialDensity>& density) {
    return fog_ball(name, 3, [=](Medium& medium) { medium.density = density; });
}

/// A body of a material that would absorb nothing, or of what does.
Exhibit of_material(const char* name, const std::variant<Mesh, Sphere, Disk>& body,
                    const std::function<int(Scene&)>& add_material) {
    return {name, [=](Scene& scene, const Climate& climate, const glm::dmat4& place) {
                const int material = climate.loss > 0 ? add_diffuse(scene, Rgb(1 - climate.loss))
                                                      : add_material(scene);
                add_shape(scene, body, {.material = material}, place * scaling(glm::dvec3(0.7)));
            }};
}

double uneven(const glm::ivec3& v) {
    return (v.x * v.y + 3 * v.z) % 5 / 2.0;
}
const Lattice kLattice{{-0.6, -0.8, -0.7}, {0.6, 0.8, 0.7}, {5, 6, 7}};

GridDensity one_voxel() {
    return Lattice{{-0.9, -0.9, -0.9}, {0.9, 0.9, 0.9}, {3, 3, 3}}.density(
        [](const glm::ivec3& v) { return v == glm::ivec3(1) ? 20 : 0; });
}

ExponentialDensity falling(bool is_spherical) {
    ExponentialDensity density;
    density.is_spherical = is_spherical;
    density.radius = 0.3;
    density.scale_height = 0.2;
    return density;
}

void add_nested(Scene& scene, const Climate& climate, const glm::dmat4& place) {
    int outside = -1;
    for (const double radius : {0.9, 0.6, 0.3}) {
        const int inside = add_fog(scene, climate, Rgb(1 / radius), radius - 0.3);
        add_shape(scene, full_sphere(radius), {.inside = inside, .outside = outside}, place);
        outside = inside;
    }
}

void add_milk_in_glass(Scene& scene, const Climate& climate, const glm::dmat4& place) {
    const int milk = add_fog(scene, climate, {2, 4, 8}, 0.7);
    add_shape(scene, full_sphere(0.9),
              {.material = add_dielectric(scene, Rgb(1.4)), .inside = milk}, place);
}

void add_white_in_fog(Scene& scene, const Climate& climate, const glm::dmat4& place) {
    const int fog = add_fog(scene, climate, Rgb(2), 0.5);
    add_shape(scene, full_sphere(0.9), {.inside = fog}, place);
    add_shape(scene, full_sphere(0.5), {.material = add_diffuse(scene, Rgb(1)), .outside = fog},
              place);
}

int white(Scene& scene) {
    return add_diffuse(scene, Rgb(1));
}
int glass(Scene& scene) {
    return add_dielectric(scene, Rgb(1.5));
}
int prism(Scene& scene) {
    return add_dielectric(scene, {1.4, 1.5, 1.6});
}
int pane(Scene& scene) {
    return add_thin_dielectric(scene, Rgb(1.7));
}
/// All of it comes back from what has no real index.
int mirror(Scene& scene) {
    return add_conductor(scene, Rgb(0), Rgb(2));
}

std::vector<Exhibit> exhibits() {
    const Mesh ring = device_test::torus_mesh(16, 8), box = box_mesh(glm::vec3(-1), glm::vec3(1));
    return {
        of_phase("isotropic, dense", 40, {henyey_greenstein(0)}),
        of_phase("g 0.9", 5, {henyey_greenstein(0.9)}),
        of_phase("g 0.999", 20, {henyey_greenstein(0.999)}),
        of_phase("g -0.9", 5, {henyey_greenstein(-0.9)}),
        of_phase("g 1e-6", 5, {henyey_greenstein(1e-6)}),
        of_phase("Schlick", 5, {schlick(0.7)}),
        of_phase("Rayleigh", 5, {rayleigh()}),
        of_phase("Mie", 5, {mie(8, 1.333)}),
        of_phase("Mie by channel", 3, {mie({4, 6, 9}, 1.4)}),
        of_phase("mixture", 5, {weighted(0.4, rayleigh()), weighted(0.6, schlick(-0.5))}),
        of_density("grid", kLattice.density(uneven, 2)),
        of_density("one voxel", one_voxel()),
        of_density("layers", falling(false)),
        of_density("atmosphere", falling(true)),
        fog_ball("grid by channel", 1,
                 [](Medium& medium) {
                     const double loss = medium.sigma_a.g;
                     const auto scatter = [](const glm::ivec3& v) {
                         return 3 * uneven(v) * Rgb(1, 0.5, 0.2);
                     };
                     set_channel_grids(
                         medium, kLattice, [=](const glm::ivec3& v) { return loss * scatter(v); },
                         scatter);
                 }),
        {"nested media", add_nested},
        {"milk in glass", add_milk_in_glass},
        {"white ball in fog", add_white_in_fog},
        of_material("white ring", ring, white),
        of_material("white disk", Disk{}, white),
        of_material("glass ball", full_sphere(1), glass),
        of_material("glass box", box, glass),
        of_material("prism", box, prism),
        of_material("pane", full_sphere(1), pane),
        of_material("mirror ring", ring, mirror),
    };
}

enum class Light { sky, enclosure };

Scene exhibition(const Climate& climate, Light light) {
    Scene scene = empty_scene(kAcross * kPixels, kAcross);
    scene.integrator.max_depth = 1'000'000;
    scene.camera.world_from_camera = translation({0, 0, -10});
    int number = 0;
    for (const Exhibit& exhibit : exhibits()) {
        const glm::dvec3 place(2 * (number % kAcross) + 1 - kAcross,
                               kAcross - 1 - 2 * (number / kAcross), 0);
        exhibit.add(scene, climate, translation(place));
        ++number;
    }
    if (light == Light::sky)
        add_infinite(scene);
    else
        add_shape(
            scene, full_sphere(30),
            {.material = black, .area_light = add_area_light(scene, Rgb(1)), .reverse = true});
    return scene;
}

/// Means of pixels, and their variances.
struct Picture {
    std::vector<Rgb> mean, variance;
};

Picture render(const Scene& scene, std::uint32_t samples) {
    const Image film = device_test::render(scene, samples);
    Picture picture;
    for (std::size_t i = 0; i < film.pixels.size(); i += 6) {
        const float* p = &film.pixels[i];
        picture.mean.emplace_back(p[0], p[1], p[2]);
        picture.variance.emplace_back(p[3], p[4], p[5]);
    }
    return picture;
}

Picture render_by_reference(const Scene& scene, std::uint32_t samples) {
    const std::vector<stats::PixelSums> batches = device_test::reference_batches(scene, samples);
    const double n = static_cast<double>(batches.size());
    Picture picture;
    for (std::size_t i = 0; i < batches[0].size(); ++i) {
        Rgb sum(0), squares(0);
        for (const stats::PixelSums& batch : batches) {
            const Rgb value = Rgb(batch[i]) / batch[i].w;
            sum += value;
            squares += value * value;
        }
        picture.mean.push_back(sum / n);
        picture.variance.push_back(glm::max(squares / n - sum * sum / (n * n), 0.0) / (n - 1));
    }
    return picture;
}

/// Mean of the square of an exhibit.
Estimate square_mean(const Picture& picture, int number) {
    Estimate result;
    Rgb variance(0);
    for (int i = 0; i < kPixels * kPixels; ++i) {
        const int x = number % kAcross * kPixels + i % kPixels;
        const int y = number / kAcross * kPixels + i / kPixels;
        const auto pixel = static_cast<std::size_t>(y * kAcross * kPixels + x);
        result.mean += picture.mean[pixel];
        variance += picture.variance[pixel];
    }
    result.mean /= kPixels * kPixels;
    result.standard_error = glm::sqrt(variance) / double(kPixels * kPixels);
    return result;
}

/// A few roundings of each of some hundred events of a path.
constexpr double kRounding = 2e-5;

void expect_white(const Picture& picture) {
    const std::vector<Exhibit> all = exhibits();
    for (int i = 0; i < kAcross * kAcross; ++i) {
        const Estimate e = square_mean(picture, i);
        for (int c = 0; c < 3; ++c)
            EXPECT_LE(std::abs(e.mean[c] - 1), pass * e.standard_error[c] + kRounding)
                << all[static_cast<std::size_t>(i)].name << ", channel " << c << ": " << e.mean[c]
                << " +- " << e.standard_error[c];
    }
}

/// The control: each square is darker by far.
void expect_grey(const Picture& picture) {
    const std::vector<Exhibit> all = exhibits();
    for (int i = 0; i < kAcross * kAcross; ++i) {
        const Estimate e = square_mean(picture, i);
        EXPECT_LT(e.mean.g, 1 - reject * e.standard_error.g - kRounding)
            << "no teeth: " << all[static_cast<std::size_t>(i)].name;
    }
}

class Furnaces : public device_test::DeviceTest {};

TEST_F(Furnaces, HideAllThatScatters) {
    ASSERT_EQ(exhibits().size(), kAcross * kAcross);
    expect_white(render(exhibition({}, Light::sky), 32));
    expect_grey(render(exhibition({.loss = 0.1}, Light::sky), 32));
}

TEST_F(Furnaces, HideAllThatScattersFromTheReference) {
    expect_white(render_by_reference(exhibition({}, Light::sky), 16));
    expect_grey(render_by_reference(exhibition({.loss = 0.1}, Light::sky), 16));
}

/// Light sampling and paths share the work.
TEST_F(Furnaces, HideAllWithinAGlowingEnclosure) {
    expect_white(render(exhibition({}, Light::enclosure), 64));
}

} // namespace
} // namespace tyndall::stability

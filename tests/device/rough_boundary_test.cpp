// Rough boundaries under light of radiance 1 from everywhere: what they return is the integral of
// their BSDF, by quadrature in double precision; and light sampling finds the same light as paths
// do.
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "support/materials.h"

#include <cmath>
#include <complex>

namespace tyndall::device_test {
namespace {

using namespace support;
using glm::dvec3;

constexpr double kPi = 3.14159265358979323846;

double fresnel(std::complex<double> index, double c) {
    const std::complex<double> t = std::sqrt(1.0 - (1 - c * c) / (index * index));
    if (index.imag() == 0 && 1 - c * c >= std::norm(index)) return 1;
    return (std::norm((c - index * t) / (c + index * t)) +
            std::norm((index * c - t) / (index * c + t))) /
           2;
}

double lambda(const dvec3& w, double alpha) {
    const double tan2 = (1 - w.z * w.z) / (w.z * w.z);
    return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}

struct Rough {
    std::complex<double> index; ///< Beyond over here; a metal's is complex.
    double alpha;
};

/// Radiance that comes from a rough boundary under light of radiance 1 on both sides: an integral
/// over facets (Walter et al. 2007), each as it is seen, of what is reflected and refracted.
double albedo(const Rough& rough, double cosine) {
    constexpr int polar = 600, azimuths = 600;
    const dvec3 wo(std::sqrt(1 - cosine * cosine), 0, cosine);
    const double a2 = rough.alpha * rough.alpha, lambda_o = lambda(wo, rough.alpha);
    const double eta = rough.index.real();
    double sum = 0;
    const auto keep = [&](const dvec3& wi) { return 1 / (1 + lambda_o + lambda(wi, rough.alpha)); };
    for (int i = 0; i < polar; ++i)
        for (int k = 0; k < azimuths; ++k) {
            // s^2 is the part of D(m) m.z further out than m; 2 s / m.z has no pole.
            const double s = (i + 0.5) / polar, phi = 2 * kPi * (k + 0.5) / azimuths;
            const double z = 1 / std::sqrt(1 + a2 * (1 - s * s) / (s * s)),
                         r = std::sqrt(1 - z * z);
            const dvec3 m(r * std::cos(phi), r * std::sin(phi), z);
            const double c = glm::dot(wo, m);
            if (c <= 0) continue;
            const double seen = 2 * s * c / (wo.z * z) / (polar * azimuths);
            const double f = fresnel(rough.index, c);
            const dvec3 mirrored = 2 * c * m - wo;
            if (mirrored.z > 0) sum += seen * f * keep(mirrored);
            if (rough.index.imag() != 0 || f == 1) continue;
            const double t = std::sqrt(1 - (1 - c * c) / (eta * eta));
            const dvec3 bent = (c / eta - t) * m - wo / eta;
            if (bent.z < 0) sum += seen * (1 - f) / (eta * eta) * keep(bent);
        }
    return sum;
}

enum class Light { sky, ball };

/// A plane across z = 0, its outside towards -z, seen at the angle whose cosine is given; from
/// inside if it is negative.
Scene lit_plane(double cosine, Light light) {
    Scene scene = empty_scene(8, 0.01);
    const double sine = std::sqrt(1 - cosine * cosine);
    scene.camera.world_from_camera = look_at(3.0 * dvec3(sine, 0, -cosine), {0, 0, 0}, {0, 1, 0});
    if (light == Light::sky)
        add_infinite(scene);
    else
        add_shape(scene, full_sphere(20),
                  {.material = black, .area_light = add_area_light(scene, Rgb(1), true)});
    return scene;
}

class RoughBoundaryTest : public DeviceTest {
  protected:
    /// @param wrong  an answer that the samples must rule out.
    void expect(const Scene& scene, std::uint32_t samples, double truth, double wrong) {
        expect_mean(mean_of(scene, samples), truth, wrong);
    }
};

TEST_F(RoughBoundaryTest, MetalReturnsItsAlbedo) {
    const std::complex<double> index(0.92, 2.45);
    for (const double cosine : {0.95, 0.3, -0.6})
        for (const Light light : {Light::sky, Light::ball}) {
            Scene scene = lit_plane(cosine, light);
            const double alpha = 0.4, truth = albedo({index, alpha}, std::abs(cosine));
            const int metal = add_conductor(scene, Rgb(index.real()), Rgb(index.imag()), alpha);
            add_shape(scene, square_mesh(10, 0, -1), {.material = metal});
            expect(scene, 1024, truth, 0.98 * truth);
        }
}

TEST_F(RoughBoundaryTest, GlassReturnsItsAlbedo) {
    for (const double cosine : {0.95, 0.3, -0.95, -0.6})
        for (const Light light : {Light::sky, Light::ball}) {
            Scene scene = lit_plane(cosine, light);
            const double alpha = 0.4, index = cosine > 0 ? 1.5 : 1 / 1.5;
            const double truth = albedo({index, alpha}, std::abs(cosine));
            add_shape(scene, square_mesh(10, 0, -1),
                      {.material = add_dielectric(scene, Rgb(1.5), alpha)});
            expect(scene, 2048, truth, 0.98 * truth);
        }
}

/// From smooth to rough there is no step.
TEST_F(RoughBoundaryTest, TheSmoothestFacetsAreAMirror) {
    for (const double alpha : {0.0, 0.001}) {
        Scene scene = lit_plane(0.8, Light::sky);
        add_shape(scene, square_mesh(10, 0, -1),
                  {.material = add_dielectric(scene, Rgb(1.5), alpha)});
        const double f = fresnel(1.5, 0.8), truth = f + (1 - f) / 2.25;
        expect(scene, 1024, truth, 0.98 * truth);
    }
}

/// The foggy room, its ball, cloud and torus (with vertex normals) of these materials.
Scene room_of(const Material& ball, const Material& cloud, const Material& torus) {
    Scene scene = busy_scene();
    for (const auto& [shape, material] : {std::pair{2, ball}, {3, torus}, {4, cloud}}) {
        scene.shapes[shape].material = static_cast<int>(scene.materials.size());
        scene.materials.push_back(material);
    }
    return scene;
}

constexpr auto kGlass = Material::Kind::dielectric;
constexpr auto kPane = Material::Kind::thin_dielectric;
constexpr auto kMetal = Material::Kind::conductor;

TEST_F(RoughBoundaryTest, SmoothBoundariesInFogAreTheReferences) {
    expect_agreement(room_of({.kind = kPane, .eta = Rgb(1.7)}, {.kind = kGlass, .eta = Rgb(1.35)},
                             {.kind = kMetal, .eta = {0.2, 0.9, 1.1}, .k = {3.9, 2.4, 2.1}}),
                     64);
}

TEST_F(RoughBoundaryTest, RoughBoundariesInFogAreTheReferences) {
    expect_agreement(
        room_of({.kind = kGlass, .eta = Rgb(1.5), .alpha = 0.05},
                {.kind = kGlass, .eta = Rgb(1.35), .alpha = 0.3},
                {.kind = kMetal, .eta = {0.2, 0.9, 1.1}, .k = {3.9, 2.4, 2.1}, .alpha = 0.2}),
        64);
}

TEST_F(RoughBoundaryTest, DispersionInFogIsTheReferences) {
    expect_agreement(room_of({.kind = kPane, .eta = {1.4, 1.6, 1.8}},
                             {.kind = kGlass, .eta = {1.3, 1.35, 1.4}},
                             {.kind = kGlass, .eta = {1.4, 1.6, 1.8}, .alpha = 0.2}),
                     64);
}

} // namespace
} // namespace tyndall::device_test

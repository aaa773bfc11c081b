// Moments of random walks, which any phase function with mean cosine g has: lengths in mean free
// paths, from a first direction of unit length.
//
// After n flights <r^2> = 2 n / (1 - g) - 2 g (1 - g^n) / (1 - g)^2. An emission of r^2 around the
// camera makes an image of it: with the albedo a, the radiance after at most n scattering events is
// the sum of (1 - a) a^(k - 1) <r^2> over k = 1 ... n + 1 flights, and 2 / ((1 - a) (1 - a g)) in
// the end.
#include "device/device_test.h"
#include "support/phases.h"
#include "support/volumes.h"

#include <cmath>

namespace tyndall::stability {
namespace {

using namespace support;

constexpr double kAlbedo = 0.5, kReach = 24, kSpacing = 0.375;
constexpr int kEndless = 1'000'000;
/// Between voxels, in [0, 3/4 spacing^2] above r^2: half of that, which is taken off and allowed.
constexpr double kInterpolation = 0.375 * kSpacing * kSpacing;

/// r^2 as emission, on voxels; beyond them is next to no light.
Scene glowing_space(const PhaseFunction& phase) {
    Scene scene = empty_scene(16, 1e-6);
    scene.integrator.samples_lights = false;
    scene.camera.medium = add_medium(scene, Rgb(1 - kAlbedo), Rgb(kAlbedo));
    Medium& medium = scene.media[0];
    medium.emission = Rgb(1);
    medium.phases = {phase};
    constexpr int count = static_cast<int>(2 * kReach / kSpacing) + 1;
    const Lattice lattice{glm::dvec3(-kReach), glm::dvec3(kReach), glm::ivec3(count)};
    GridDensity density = lattice.density([](const glm::ivec3&) { return 1; }, 64);
    density.emission_scale = lattice.grid([&](const glm::ivec3& v) {
        const glm::dvec3 place = lattice.place(v);
        return glm::dot(place, place);
    });
    medium.density = density;
    return scene;
}

double radiance_of_walks(double g, int scatterings) {
    if (scatterings == kEndless) return 2 / ((1 - kAlbedo) * (1 - kAlbedo * g));
    double sum = 0;
    for (int n = 1; n <= scatterings + 1; ++n) {
        const double square = 2 * n / (1 - g) - 2 * g * (1 - std::pow(g, n)) / ((1 - g) * (1 - g));
        sum += (1 - kAlbedo) * std::pow(kAlbedo, n - 1) * square;
    }
    return sum;
}

/// @param wrong  the mean cosine of which the same data must rule out the moment.
template<typename MeanOf>
void expect_moments(const PhaseFunction& phase, double g, double wrong, const MeanOf& mean_of) {
    Scene scene = glowing_space(phase);
    for (const int scatterings : {3, kEndless}) {
        scene.integrator.max_depth = scatterings;
        const Estimate e = mean_of(scene);
        const double found = e.mean.g - kInterpolation, error = e.standard_error.g;
        const double exact = radiance_of_walks(g, scatterings);
        EXPECT_LE(std::abs(found - exact), pass * error + kInterpolation)
            << "g = " << g << ", " << scatterings << " scatterings: " << found << " +- " << error
            << ", not " << exact;
        EXPECT_GT(std::abs(found - radiance_of_walks(wrong, scatterings)),
                  reject * error + kInterpolation)
            << "no teeth: g = " << g << ", " << scatterings << " scatterings: +- " << error;
    }
}

class Walks : public device_test::DeviceTest {};

TEST_F(Walks, HaveTheirMoments) {
    const auto mean_of = [](const Scene& scene) { return device_test::mean_of(scene, 1024); };
    for (const double g : {-0.5, 0.5, 0.9, 0.999})
        expect_moments(henyey_greenstein(g), g, g - 0.2, mean_of);
    expect_moments(rayleigh(), 0, 0.2, mean_of);
}

TEST_F(Walks, HaveTheirMomentsByTheReference) {
    const auto mean_of = [](const Scene& scene) { return image_mean(scene, 16, 8); };
    for (const double g : {-0.5, 0.9})
        expect_moments(henyey_greenstein(g), g, g > 0 ? 0 : 0.2, mean_of);
}

} // namespace
} // namespace tyndall::stability

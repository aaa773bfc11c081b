// Slabs against converged solutions of the radiative transport equation (discrete ordinates and
// doubling, confirmed by van de Hulst's tables).
#include "support/estimates.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace tyndall::reference {
namespace {

using support::add_shape;
using support::Estimate;
using support::image_mean;
using support::pass;
using support::reject;

/// A camera at normal incidence above a slab of thickness 2, and one side from which light comes:
/// by reciprocity it sees the share of a normal beam that leaves on that side.
Scene slab_scene(bool reflectance, const Rgb& albedo, const Rgb& depth, double g) {
    Scene scene = support::empty_scene(8);
    const Rgb sigma_t = depth / 2.0;
    const int medium = support::add_medium(scene, sigma_t * (1.0 - albedo), sigma_t * albedo, g);
    support::add_slab(scene, medium, 1, 3);
    // The other side is black.
    add_shape(scene, support::square_mesh(1e6f, reflectance ? 4 : -1, 1),
              {.material = support::black});
    support::add_infinite(scene);
    return scene;
}

struct Row {
    double albedo, depth, g, r, t;
};

/// Lost energy at this order is far below the noise.
constexpr std::uint32_t batches = 32, samples = 40;

TEST(Slab, MatchesReflectanceAndTransmittance) {
    for (const Row& row :
         {Row{0.5, 1, 0, 0.0991192, 0.4460584}, Row{0.9, 2, 0.75, 0.0973946, 0.6609577},
          Row{0.9, 2, -0.5, 0.4627721, 0.2760717}, Row{1, 2, 0, 0.5175149, 0.4824851},
          Row{0.99, 10, 0.9, 0.2476276, 0.5890815}}) {
        const Rgb albedo(row.albedo), depth(row.depth);
        const Estimate r = image_mean(slab_scene(true, albedo, depth, row.g), batches, samples);
        const Estimate t = image_mean(slab_scene(false, albedo, depth, row.g), batches, samples);
        EXPECT_LT(r.z(row.r), pass) << r.mean.x << " for " << row.r;
        EXPECT_LT(t.z(row.t), pass) << t.mean.x << " for " << row.t;
    }
}

/// Teeth: with more samples, the data reject a medium that is 2 % denser, and g off by 0.02.
TEST(Slab, RejectsADenserMediumAndAnotherPhaseFunction) {
    const Estimate dense = image_mean(slab_scene(false, Rgb(0.5), Rgb(1.02), 0), 32, 400);
    EXPECT_GT(dense.z(0.4460584), reject);
    const Estimate forward = image_mean(slab_scene(true, Rgb(0.9), Rgb(2), 0.77), 32, 400);
    EXPECT_GT(forward.z(0.0973946), reject);
}

/// Three different slabs at once, one a channel: the spectral weights must not mix them up.
TEST(Slab, ChromaticMediaMatchEachChannel) {
    const Rgb albedo(0.5, 0.9, 0.99), depth(1, 2, 10);
    const Estimate r = image_mean(slab_scene(true, albedo, depth, 0), 32, 160);
    EXPECT_LT(r.z(0.0991192, 0), pass);
    EXPECT_LT(r.z(0.3616489, 1), pass);
    EXPECT_LT(r.z(0.7409323, 2), pass);
    EXPECT_GT(r.z(0.0991192 * 1.05, 0), reject);
    const Estimate t = image_mean(slab_scene(false, albedo, depth, 0), 32, 160);
    EXPECT_LT(t.z(0.4460584, 0), pass);
    EXPECT_LT(t.z(0.3565007, 1), pass);
    EXPECT_LT(t.z(0.0847609, 2), pass);
}

/// Orders of scattering of the conservative slab tau = 1; maxdepth n gives the sum of 0 ... n.
TEST(Slab, DepthCapsCutTheSeriesOfOrders) {
    const double r[] = {0, 0.14201535, 0.07888152, 0.04668661, 0.02832607};
    const double t[] = {0.36787944, 0.10617289, 0.06862215, 0.04360838, 0.02738659};
    double sum_r = 0, sum_t = 0;
    for (int n = 0; n < 5; ++n) {
        sum_r += r[n];
        sum_t += t[n];
        Scene up = slab_scene(true, Rgb(1), Rgb(1), 0), down = slab_scene(false, Rgb(1), Rgb(1), 0);
        up.integrator.max_depth = down.integrator.max_depth = n;
        EXPECT_LT(image_mean(up, batches, samples).z(sum_r), pass) << n;
        EXPECT_LT(image_mean(down, batches, samples).z(sum_t), pass) << n;
        EXPECT_GT(image_mean(down, batches, samples).z(sum_t + 0.02), reject); // Of the next order.
    }
}

/// A closed box, 20000 times wider than thick, at a scale and place where epsilons would show.
TEST(Slab, MayBeFarWiderThanThick) {
    for (const double scale : {1e-4, 1.0, 1e6}) {
        Scene scene = support::empty_scene(8, scale);
        const int medium = support::add_medium(scene, Rgb(0.2 / scale), Rgb(1.8 / scale), 0.75);
        add_shape(scene, support::box_mesh({-1e4f, -1e4f, 1}, {1e4f, 1e4f, 2}), {.inside = medium},
                  support::scaling(glm::dvec3(scale)));
        add_shape(scene, support::square_mesh(1e6f, 4, 1), {.material = support::black},
                  support::scaling(glm::dvec3(scale)));
        support::add_infinite(scene);
        EXPECT_LT(image_mean(scene, batches, samples).z(0.0973946), pass);
    }
}

} // namespace
} // namespace tyndall::reference

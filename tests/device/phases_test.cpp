// Phase functions in scenes with everything else: device against reference.
#include "device/device_test.h"
#include "device/test_scenes.h"
#include "reference/phase.h"
#include "support/phases.h"

namespace tyndall::device_test {
namespace {

using namespace support;

std::vector<PhaseFunction> chromatic_haze() {
    return {weighted(0.2, rayleigh()), weighted(0.5, mie({4, 6, 9}, 1.4)),
            weighted(0.2, schlick(0.7)), weighted(0.1, henyey_greenstein(0))};
}

class PhasesTest : public DeviceTest {};

TEST_F(PhasesTest, EachKindAgreesWithTheReference) {
    for (const PhaseFunction& phase :
         {schlick(-0.6), rayleigh(), mie(8, 1.333), mie({4, 6, 9}, 1.4)}) {
        Scene scene = plain_scene();
        scene.media.front().phases = {phase};
        expect_agreement(scene, 16);
    }
}

/// With area lights, so that light is found by light sampling and by scattering; in two media of
/// different mixtures.
TEST_F(PhasesTest, ChromaticMixturesAgreeWithTheReference) {
    Scene scene = busy_scene();
    scene.media.at(0).phases = chromatic_haze();
    scene.media.at(1).phases = {weighted(0.5, rayleigh()), weighted(0.5, mie({20, 25, 30}, 1.333))};
    expect_agreement(scene, 16, 0.02);
    Scene other = scene;
    other.media.at(0).phases = {henyey_greenstein(reference::mean_cosine(chromatic_haze()).g)};
    EXPECT_NE(render_sums(scene, 0, 4), render_sums(other, 0, 4)); // the control
}

/// Lit from everywhere, what only scatters is invisible, whatever the phase function of each
/// channel.
TEST_F(PhasesTest, ChromaticScatteringKeepsTheFurnace) {
    Scene scene = empty_scene(16, 0.5);
    scene.integrator.max_depth = 10000;
    add_infinite(scene);
    const int medium = add_medium(scene, Rgb(0), Rgb(3, 2, 1));
    scene.media.back().phases = chromatic_haze();
    add_shape(scene, full_sphere(1), {.inside = medium}, translation({0, 0, 3}));
    const Estimate e = mean_of(scene, 1024);
    for (int c = 0; c < 3; ++c)
        expect_mean(e, 1, 1.02, c);
}

TEST_F(PhasesTest, OnlyKindsThatOccurAreBuilt) {
    Scene scene = plain_scene();
    const auto features = [&](std::vector<PhaseFunction> phases) {
        scene.media.front().phases = std::move(phases);
        return compute_effects(scene).features;
    };
    EXPECT_EQ(features({henyey_greenstein(0)}).phases, 0u);
    EXPECT_EQ(features({henyey_greenstein(0.1)}).phases, shared::PHASE_BIT_HENYEY_GREENSTEIN);
    EXPECT_EQ(features({rayleigh()}).phases, shared::PHASE_BIT_RAYLEIGH);
    EXPECT_EQ(features({rayleigh()}).has_mixtures, 0u);
    EXPECT_EQ(features({mie(3, 1.5)}).has_chromatic_phases, 0u);
    const shared::Features mixed = features(chromatic_haze());
    EXPECT_EQ(mixed.phases, 15u);
    EXPECT_EQ(mixed.has_mixtures, 1u);
    EXPECT_EQ(mixed.has_chromatic_phases, 1u);
    EXPECT_EQ(mixed.is_chromatic, 1u);
    EXPECT_EQ(mixed.is_grey, 0u);
}

} // namespace
} // namespace tyndall::device_test

// Phase functions of media and their parameters.
#include "unit/scene_files.h"

#include <cmath>
#include <gtest/gtest.h>

namespace tyndall {
namespace {

using Kind = PhaseFunction::Kind;

const std::string medium = "MakeNamedMedium \"a\" \"string type\" \"homogeneous\" ";

std::vector<PhaseFunction> phases_of(const std::string& parameters) {
    return read_world(medium + parameters).media.at(0).phases;
}

TEST(PhaseParameters, OneFunction) {
    EXPECT_EQ(phases_of("").at(0).kind, Kind::henyey_greenstein);
    EXPECT_EQ(phases_of("").at(0).g, 0);
    EXPECT_EQ(phases_of("\"string phase\" \"isotropic\"").at(0).g, 0);
    EXPECT_EQ(phases_of("\"string phase\" \"rayleigh\"").at(0).kind, Kind::rayleigh);
    const PhaseFunction given = phases_of("\"string phase\" \"schlick\" \"float k\" -0.5").at(0);
    EXPECT_EQ(given.kind, Kind::schlick);
    EXPECT_EQ(given.k, -0.5);
    const PhaseFunction fitted = phases_of("\"string phase\" \"schlick\" \"float g\" 0.5").at(0);
    EXPECT_DOUBLE_EQ(fitted.k, 0.70625);
}

TEST(PhaseParameters, SpheresOfWaterAreTheDefault) {
    const PhaseFunction mie = phases_of("\"string phase\" \"mie\" \"float mieradius\" 1").at(0);
    ASSERT_EQ(mie.kind, Kind::mie);
    EXPECT_NEAR(mie.spheres[1].size_parameter, 2 * std::acos(-1) / 0.5491, 1e-9);
    EXPECT_TRUE(mie.table->is_chromatic());
    const PhaseFunction soot = phases_of("\"string phase\" \"mie\" \"float mieradius\" 0.05 "
                                         "\"float miesigma\" 0.1 \"float mieeta\" 1.75 "
                                         "\"rgb miek\" [ 0.4 0.5 0.6 ]")
                                   .at(0);
    EXPECT_LT(soot.spheres[0].qsca, 0.5 * soot.spheres[0].qext);
    // Only ratios to the surroundings count, but for the wavelength in them.
    const PhaseFunction same = phases_of("\"string phase\" \"mie\" \"float mieradius\" 0.5 "
                                         "\"float mieeta\" 3 \"float miemediumeta\" 2")
                                   .at(0);
    const PhaseFunction other =
        phases_of("\"string phase\" \"mie\" \"float mieradius\" 1 \"float mieeta\" 1.5").at(0);
    EXPECT_NEAR(same.spheres[2].qext, other.spheres[2].qext, 1e-12);
}

TEST(PhaseParameters, MixturesTakeValuesInOrder) {
    const auto phases =
        phases_of("\"string phase\" [ \"mie\" \"henyey-greenstein\" \"rayleigh\" \"schlick\" ]\n"
                  "\"float phaseweights\" [ 4 3 2 1 ] \"float g\" [ 0.25 0.5 ]\n"
                  "\"float mieradius\" 0.3 \"spectrum mieeta\" [ 400 1.6 700 1.5 ]");
    ASSERT_EQ(phases.size(), 4u);
    EXPECT_EQ(phases[0].kind, Kind::mie);
    EXPECT_EQ(phases[1].g, 0.25);
    EXPECT_EQ(phases[3].k, 0.70625);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_DOUBLE_EQ(phases[i].weight, 0.1 * (4.0 - static_cast<double>(i)));
    EXPECT_DOUBLE_EQ(phases_of("\"string phase\" [ \"rayleigh\" \"isotropic\" ]").at(1).weight,
                     0.5);
}

TEST(PhaseParameters, AirScattersBlueAsRayleigh) {
    const Medium air =
        read_world(medium + "\"string preset\" \"air\" \"float scale\" 1000").media.at(0);
    EXPECT_EQ(air.phases.at(0).kind, Kind::rayleigh);
    EXPECT_EQ(air.sigma_a, Rgb(0));
    EXPECT_NEAR(air.sigma_s.g, 1.1565e-2, 1e-5); // 549.1 nm, from the coefficient at 550 nm
    EXPECT_NEAR(air.sigma_s.b / air.sigma_s.r, std::pow(611.4 / 464.3, 4.08), 0.02);
}

TEST(PhaseParameters, AreChecked) {
    EXPECT_EQ(world_error(medium + "\"string phase\" \"foggy\""),
              "unknown phase function \"foggy\" (expected one of henyey-greenstein, isotropic, "
              "schlick, rayleigh, mie)");
    EXPECT_EQ(world_error(medium + "\"string phase\" \"schlick\" \"float g\" 0.95"),
              "parameter \"float g\" is 0.95 (expected |g| < 0.938, where k = 1.55 g - 0.55 g^3 is "
              "below 1; or give \"float k\")");
    EXPECT_EQ(world_error(medium + "\"string phase\" \"schlick\" \"float k\" 1"),
              "parameter \"float k\" is 1 (expected a value in (-1, 1))");
    EXPECT_EQ(world_error(medium + "\"string phase\" \"mie\""),
              "medium \"a\" needs a parameter \"float mieradius\"");
    EXPECT_EQ(
        world_error(medium + "\"string phase\" \"mie\" \"float mieradius\" 5000"),
        "medium \"a\": a size parameter 2 pi r / wavelength is outside the range [1e-6, 1e4]");
    EXPECT_EQ(
        world_error(medium + "\"string phase\" \"mie\" \"float mieradius\" 1 \"float mieeta\" 1"),
        "medium \"a\": spheres with the refractive index of the medium do not scatter");
    EXPECT_EQ(world_error(medium + "\"float g\" [ 0.1 0.2 ]"),
              "parameter \"float g\" has 2 values (expected 1: one for each phase function that "
              "takes it)");
    EXPECT_EQ(world_error(medium + "\"string phase\" [ \"rayleigh\" \"isotropic\" ] "
                                   "\"float phaseweights\" [ 1 0 ]"),
              "parameter \"float phaseweights\" is 0 (expected a value > 0)");
    EXPECT_EQ(world_error(medium + "\"string phase\" [ \"rayleigh\" \"henyey-greenstein\" ] "
                                   "\"float g\" 1"),
              "medium \"a\": a mixture of phase functions with one that does not deflect light, or "
              "turns it back (expected |g| and |k| below 1 - 1e-6)");
    EXPECT_EQ(world_error(medium + "\"string phase\" \"rayleigh\" \"float g\" 0.5"),
              "unused parameter \"float g\" of medium \"a\"");
}

} // namespace
} // namespace tyndall

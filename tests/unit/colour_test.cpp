// Colour: observer, illuminants, blackbody, and colours as parameters.
#include "scene/spectrum.h"
#include "unit/scene_files.h"

#include <cmath>
#include <gtest/gtest.h>

namespace tyndall {
namespace {

glm::dvec2 chromaticity(const Spectrum& s) {
    const glm::dvec3 xyz = integrate_xyz(s);
    return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z);
}

Spectrum constant(double value) {
    return Spectrum::piecewise_linear({{300, value}, {900, value}});
}

TEST(Observer, HasTheIntegralsOfTheCie) {
    const glm::dvec3 xyz = integrate_xyz(constant(1));
    // CIE 15:2004: the sums of the 1 nm table.
    EXPECT_NEAR(xyz.x, 106.8655, 1e-3);
    EXPECT_NEAR(xyz.y, 106.8569, 1e-3);
    EXPECT_NEAR(xyz.z, 106.8922, 2e-3);
    EXPECT_GT(std::abs(xyz.x - xyz.y), 1e-3); // the tolerance tells x from y
}

TEST(Observer, InterpolatesToThe1nmTable) {
    // Narrow lines read the observer at one wavelength; values of the CIE table at 1 nm.
    const auto at = [](double wavelength) {
        const double half = 0.1;
        return integrate_xyz(Spectrum::piecewise_linear(
                   {{wavelength - half, 0}, {wavelength, 1}, {wavelength + half, 0}})) /
               half;
    };
    EXPECT_TRUE(is_near(at(507), {0.003836560, 0.4443096, 0.1901196}, 3e-4));
    EXPECT_TRUE(is_near(at(602), {1.0584436, 0.6053144, 0.000723680}, 3e-5));
    // A straight line between the 5 nm samples would miss by more than the tolerance.
    EXPECT_FALSE(is_near(at(507), {0.00516, 0.44558, 0.19066}, 3e-4));
}

TEST(Illuminants, HaveTheirChromaticities) {
    // CIE 15:2004, table T.3.
    EXPECT_TRUE(is_near(chromaticity(*named_spectrum("stdillum-D65")), {0.31272, 0.32903}, 3e-5));
    EXPECT_TRUE(is_near(chromaticity(*named_spectrum("stdillum-D50")), {0.34567, 0.35851}, 3e-5));
    EXPECT_TRUE(is_near(chromaticity(*named_spectrum("stdillum-A")), {0.44758, 0.40745}, 3e-5));
    EXPECT_TRUE(is_near(chromaticity(constant(1)), {1.0 / 3, 1.0 / 3}, 1e-4)); // E
    EXPECT_FALSE(is_near(chromaticity(constant(1)), {0.31272, 0.32903}, 3e-5));
}

TEST(Illuminants, MatchTheTableOfTheCie) {
    const Spectrum d65 = *named_spectrum("stdillum-D65");
    EXPECT_NEAR(d65(360), 46.6383, 1e-4);
    EXPECT_NEAR(d65(460), 117.812, 1e-3);
    EXPECT_NEAR(d65(705), 72.9790, 1e-4);
    EXPECT_NEAR(d65(830), 60.3125, 1e-4);
    const Spectrum d50 = *named_spectrum("stdillum-D50");
    EXPECT_NEAR(d50(380), 24.4880, 1e-3);
    EXPECT_NEAR(d50(560), 100, 1e-9);
    const Spectrum a = *named_spectrum("stdillum-A");
    EXPECT_NEAR(a(380), 9.7951, 1e-4);
    EXPECT_NEAR(a(780), 241.675, 1e-3);
    EXPECT_GT(std::abs(d65(460) - d50(460)), 1);
    EXPECT_FALSE(named_spectrum("stdillum-F1"));
    EXPECT_TRUE(is_unsupported_spectrum("illum-acesD60"));
    EXPECT_FALSE(is_unsupported_spectrum("copper.spd"));
}

TEST(Blackbody, HasTheChromaticityOfPlanck) {
    // Planckian locus, CIE 1931 (Wyszecki and Stiles 1982, table 1(3.11)).
    EXPECT_TRUE(is_near(chromaticity(Spectrum::blackbody(6500)), {0.3135, 0.3237}, 1e-4));
    EXPECT_TRUE(is_near(chromaticity(Spectrum::blackbody(5000)), {0.3451, 0.3516}, 1e-4));
    EXPECT_TRUE(is_near(chromaticity(Spectrum::blackbody(2000)), {0.5267, 0.4133}, 1e-4));
    EXPECT_FALSE(is_near(chromaticity(Spectrum::blackbody(6400)), {0.3135, 0.3237}, 1e-4));
}

TEST(Blackbody, HasItsMaximumWhereWienSays) {
    const double peak = 2.897771955e6 / 4000;
    const Spectrum s = Spectrum::blackbody(4000);
    EXPECT_NEAR(s(peak), 1, 1e-12);
    EXPECT_LT(s(peak + 5), 1);
    EXPECT_LT(s(peak - 5), 1);
    EXPECT_EQ(Spectrum::blackbody(1)(500), 0);
    EXPECT_TRUE(std::isfinite(Spectrum::blackbody(1e30)(500)));
}

TEST(Piecewise, IsLinearInsideAndZeroOutside) {
    const Spectrum s = Spectrum::piecewise_linear({{400, 1}, {500, 3}, {510, 0}});
    EXPECT_EQ(s(399.9), 0);
    EXPECT_EQ(s(400), 1);
    EXPECT_EQ(s(450), 2);
    EXPECT_EQ(s(505), 1.5);
    EXPECT_EQ(s(510), 0);
    EXPECT_EQ(s(511), 0);
}

TEST(Rgb, WhiteOfD65IsOne) {
    EXPECT_TRUE(is_near(light_colour(*named_spectrum("stdillum-D65")), glm::dvec3(1), 1e-12));
    EXPECT_FALSE(is_near(light_colour(*named_spectrum("stdillum-D50")), glm::dvec3(1), 0.01));
    // IEC 61966-2-1 rounds its matrix to four digits.
    EXPECT_TRUE(is_near(rgb_from_xyz({0.9505, 1, 1.0890}), glm::dvec3(1), 5e-4));
    EXPECT_TRUE(is_near(rgb_from_xyz({0.4124, 0.2126, 0.0193}), {1, 0, 0}, 5e-4));
    EXPECT_TRUE(is_near(rgb_from_xyz({0.1805, 0.0722, 0.9505}), {0, 0, 1}, 5e-4));
}

TEST(Rgb, LightHasLuminanceOneWhateverItsMagnitude) {
    const glm::dvec3 luminance(0.2126, 0.7152, 0.0722);
    for (const double magnitude : {1e-6, 1.0, 1e6}) {
        const glm::dvec3 rgb =
            light_colour(Spectrum::piecewise_linear({{400, magnitude}, {700, 3 * magnitude}}));
        EXPECT_NEAR(glm::dot(rgb, luminance), 1, 2e-4);
    }
    EXPECT_EQ(light_colour(constant(0)), glm::dvec3(0));
    EXPECT_EQ(light_colour(Spectrum::piecewise_linear({{900, 1}, {1000, 1}})), glm::dvec3(0));
}

TEST(Rgb, ReflectanceOneIsWhite) {
    EXPECT_TRUE(is_near(reflectance_colour(constant(1)), glm::dvec3(1), 1e-12));
    EXPECT_TRUE(is_near(reflectance_colour(constant(0.25)), glm::dvec3(0.25), 1e-12));
    const glm::dvec3 green =
        reflectance_colour(Spectrum::piecewise_linear({{515, 0}, {520, 1}, {530, 1}, {535, 0}}));
    EXPECT_EQ(green.r, 0); // outside the gamut
    EXPECT_GT(green.g, 0.1);
}

TEST(Rgb, ChannelsSeeTheirWavelengths) {
    EXPECT_EQ(channel_values(Spectrum::piecewise_linear({{400, 400}, {700, 700}})),
              channel_wavelengths);
}

/// The radiance of an infinite light.
Rgb light(const std::string& parameters, const SceneFolder& folder = {}) {
    const Scene scene = folder.read("WorldBegin LightSource \"infinite\" " + parameters);
    return std::get<InfiniteLight>(scene.lights.at(0).emitter).radiance;
}

TEST(ColourParameters, OfLights) {
    EXPECT_TRUE(is_near(light("\"rgb L\" [ 1 1 1 ]"), Rgb(1), 1e-15));
    EXPECT_TRUE(is_near(light("\"rgb L\" [ 0.3 0.3 0.3 ]"), Rgb(0.3), 1e-15));
    EXPECT_TRUE(is_near(light("\"spectrum L\" \"stdillum-D65\""), Rgb(1), 1e-12));
    EXPECT_TRUE(is_near(light("\"spectrum L\" \"stdillum-D65\" \"float scale\" 3"), Rgb(3), 1e-12));
    EXPECT_TRUE(
        is_near(light("\"blackbody L\" 3000"), light_colour(Spectrum::blackbody(3000)), 1e-12));
    EXPECT_GT(light("\"blackbody L\" 3000").r, light("\"blackbody L\" 3000").b);
    EXPECT_TRUE(is_near(light("\"spectrum L\" [ 300 7 900 7 ]"), light_colour(constant(1)), 1e-12));
}

TEST(ColourParameters, OfFiles) {
    SceneFolder folder;
    folder.write("lamp.spd", "# wavelength value\n300 7\n900 7 # the end\n");
    EXPECT_TRUE(
        is_near(light("\"spectrum L\" \"lamp.spd\"", folder), light_colour(constant(1)), 1e-12));
    const auto error = [&](const std::string& content) {
        folder.write("lamp.spd", content);
        const auto errors =
            folder.errors("WorldBegin\nLightSource \"infinite\" \"spectrum L\" \"lamp.spd\"");
        return errors.size() == 1 ? errors[0] : "not one error";
    };
    EXPECT_EQ(error("300 7 900"),
              "scene.pbrt:2:24: error: \"lamp.spd\" has 3 values (expected pairs of "
              "wavelength and value, at least two)");
    EXPECT_EQ(error("300 7 x 900"), "scene.pbrt:2:24: error: lamp.spd:1:7: \"x\" is no number");
    EXPECT_EQ(error("300 7 200 7"),
              "scene.pbrt:2:24: error: \"lamp.spd\": wavelength 200 follows 300 "
              "(expected increasing wavelengths)");
    EXPECT_EQ(error("# nothing"), "scene.pbrt:2:24: error: \"lamp.spd\" has no values");
}

TEST(ColourParameters, AreChecked) {
    const auto error = [](const std::string& parameter) {
        const auto errors = world_errors("LightSource \"infinite\" " + parameter);
        return errors.size() == 1 ? errors[0] : "not one error";
    };
    EXPECT_EQ(
        error("\"spectrum L\" [ 400 1 500 ]"),
        "scene.pbrt:2:24: error: \"spectrum L\" has 3 values (expected pairs of wavelength and "
        "value, at least two)");
    EXPECT_EQ(error("\"spectrum L\" [ 400 1 500 -1 ]"),
              "scene.pbrt:2:24: error: parameter \"spectrum L\" is -1 (expected a value >= 0)");
    EXPECT_EQ(
        error("\"blackbody L\" 0"),
        "scene.pbrt:2:24: error: parameter \"blackbody L\" is no temperature (expected one value > "
        "0, in kelvin)");
    EXPECT_EQ(error("\"spectrum L\" \"stdillum-F2\""),
              "scene.pbrt:2:24: error: named spectrum \"stdillum-F2\" is not supported yet");
    EXPECT_EQ(error("\"spectrum L\" \"none.spd\""),
              "scene.pbrt:2:24: error: no spectrum is named \"none.spd\", and cannot read "
              "\"none.spd\": no "
              "such file");
    EXPECT_EQ(error("\"spectrum L\" [ \"a\" \"b\" ]"),
              "scene.pbrt:2:24: error: parameter \"spectrum L\" has 2 names (expected 1)");
    EXPECT_EQ(error("\"spectrum L\" [ 400 \"b\" ]"),
              "scene.pbrt:2:43: error: the string \"b\" is no value for parameter \"spectrum L\" "
              "(expected "
              "numbers, or one string in quotes)");
    EXPECT_EQ(
        world_warnings("LightSource \"infinite\" \"spectrum L\" [ 519 0 520 1 521 0 ]").size(), 1u);
}

TEST(ColourParameters, OfReflectancesAndMedia) {
    const Scene scene = read_world(
        "Material \"diffuse\" \"spectrum reflectance\" [ 300 0.5 900 0.5 ]\n"
        "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"blackbody Le\" 3000\n"
        "  \"float Lescale\" 2 \"spectrum sigma_a\" [ 400 4 700 7 ] \"float scale\" 10\n");
    EXPECT_TRUE(is_near(scene.materials.at(1).reflectance, Rgb(0.5), 1e-12));
    EXPECT_TRUE(is_near(scene.media.at(0).sigma_a, channel_wavelengths / 10.0, 1e-9));
    EXPECT_TRUE(
        is_near(scene.media.at(0).emission, 2.0 * light_colour(Spectrum::blackbody(3000)), 1e-12));
    EXPECT_FALSE(
        is_near(scene.media.at(0).emission, light_colour(Spectrum::blackbody(3000)), 1e-12));
    EXPECT_EQ(
        world_errors("Material \"diffuse\" \"spectrum reflectance\" [ 300 0.5 900 1.5 ]").size(),
        1u);
}

} // namespace
} // namespace tyndall

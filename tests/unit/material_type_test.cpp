// Types of materials and their parameters.
#include "scene/material_spectra.h"
#include "unit/scene_files.h"

#include <cmath>
#include <gtest/gtest.h>

namespace tyndall {
namespace {

Material read_one(const std::string& text) {
    return read_world("Material " + text).materials.at(1);
}

std::string material_error(const std::string& text) {
    return world_error("Material " + text);
}

TEST(MaterialType, Dielectric) {
    const Material smooth = read_one("\"dielectric\"");
    EXPECT_EQ(smooth.kind, Material::Kind::dielectric);
    EXPECT_EQ(smooth.eta, Rgb(1.5));
    EXPECT_EQ(smooth.alpha, 0);
    EXPECT_NEAR(read_one("\"dielectric\" \"float roughness\" 0.25").alpha, 0.5, 1e-15);
    EXPECT_EQ(
        read_one("\"dielectric\" \"float roughness\" 0.25 \"bool remaproughness\" false").alpha,
        0.25);
    EXPECT_EQ(read_one("\"dielectric\" \"float uroughness\" 0.09 \"float vroughness\" 0.09").alpha,
              0.3);
    EXPECT_EQ(read_one("\"dielectric\" \"float eta\" 1.33").eta, Rgb(1.33));
    const Rgb glass = read_one("\"dielectric\" \"spectrum eta\" \"glass-BK7\"").eta;
    EXPECT_GT(glass.b, glass.g);
    EXPECT_GT(glass.g, glass.r);
    EXPECT_EQ(read_one("\"thindielectric\" \"float eta\" 1.2").kind,
              Material::Kind::thin_dielectric);
    EXPECT_EQ(read_one("\"thindielectric\" \"float eta\" 1.2").eta, Rgb(1.2));
    EXPECT_EQ(material_error("\"dielectric\" \"float uroughness\" 0.1"),
              "material \"dielectric\": \"uroughness\" 0.1 and \"vroughness\" 0 differ: "
              "anisotropic roughness is not "
              "supported yet");
    EXPECT_EQ(material_error("\"dielectric\" \"float eta\" 0"),
              "parameter \"float eta\" is 0 (expected a value > 0)");
    EXPECT_EQ(material_error("\"dielectric\" \"spectrum eta\" [ 600 1.5 700 1.5 ]"),
              "material \"dielectric\": \"eta\" is 0 at the wavelength of a channel, 464.3, 549.1 "
              "or 611.4 nm (expected an "
              "index > 0)");
    EXPECT_EQ(material_error("\"thindielectric\" \"float roughness\" 0.1"),
              "unused parameter \"float roughness\" of material \"thindielectric\"");
}

/// Reflectance at normal incidence.
double fresnel(double eta, double k) {
    return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
}

TEST(MaterialType, Conductor) {
    const Material copper = read_one("\"conductor\"");
    EXPECT_EQ(copper.kind, Material::Kind::conductor);
    EXPECT_EQ(copper.eta, read_one("\"conductor\" \"spectrum eta\" \"metal-Cu-eta\"").eta);
    EXPECT_EQ(copper.k, read_one("\"conductor\" \"spectrum k\" \"metal-Cu-k\"").k);
    const Material gold =
        read_one("\"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\"");
    EXPECT_GT(fresnel(gold.eta.r, gold.k.r), 0.9);
    EXPECT_LT(fresnel(gold.eta.b, gold.k.b), 0.5);
    const Material red =
        read_one("\"conductor\" \"rgb reflectance\" [ 0.9 0.5 1 ] \"float roughness\" 0.01");
    EXPECT_NEAR(fresnel(red.eta.r, red.k.r), 0.9, 1e-12);
    EXPECT_NEAR(fresnel(red.eta.g, red.k.g), 0.5, 1e-12);
    EXPECT_NEAR(fresnel(red.eta.b, red.k.b), 0.9999, 1e-12);
    EXPECT_NEAR(red.alpha, 0.1, 1e-15);
    EXPECT_EQ(
        material_error("\"conductor\" \"rgb reflectance\" [ 1 1 1 ] \"rgb k\" [ 1 1 1 ]"),
        "material \"conductor\" has both \"rgb reflectance\" and an index (expected one of them)");
}

TEST(MaterialSpectra, GlassesHaveTheirCodes) {
    // Six digits: n_d - 1 in thousandths, Abbe number in tenths (Schott's and others' catalogues).
    const std::vector<std::pair<std::string, std::pair<int, int>>> codes{
        {"BK7", {517, 642}}, {"BAF10", {670, 471}}, {"FK51A", {487, 845}}, {"LASF9", {850, 322}},
        {"F5", {673, 322}},  {"F10", {728, 284}},   {"SF11", {785, 258}}};
    for (const auto& [name, code] : codes) {
        const Spectrum n = *material_spectrum("glass-" + name);
        const double d = n(587.5618);
        EXPECT_NEAR(d, 1 + code.first * 1e-3, 0.51e-3) << name;
        EXPECT_NEAR((d - 1) / (n(486.1327) - n(656.2725)), code.second * 0.1, 0.1) << name;
    }
    EXPECT_NEAR((*material_spectrum("metal-MgO-eta"))(587.6), 1.7375,
                1e-3); // Stephens and Malitson
    EXPECT_NEAR((*material_spectrum("metal-TiO2-eta"))(587.6), 2.614, 1e-3); // Devore
}

TEST(MaterialSpectra, CoverTheChannels) {
    for (const char* metal : {"Ag", "Al", "Au", "Cu", "CuZn", "MgO", "TiO2"}) {
        const Rgb eta = channel_values(*material_spectrum("metal-" + std::string(metal) + "-eta"));
        EXPECT_TRUE(glm::all(glm::greaterThan(eta, Rgb(0.1)))) << metal;
        EXPECT_TRUE(material_spectrum("metal-" + std::string(metal) + "-k"));
    }
    for (const char* name : {"glass-XX", "metal-Cu", "metal-Fe-k", "metal-", "glass-"})
        EXPECT_FALSE(material_spectrum(name)) << name;
}

} // namespace
} // namespace tyndall

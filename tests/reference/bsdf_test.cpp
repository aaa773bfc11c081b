// Fresnel's equations, the distribution of microfacets, and what surfaces draw against what they
// state.
#include "reference/bsdf.h"
#include "reference/fresnel.h"
#include "reference/microfacet.h"
#include "support/estimates.h"

#include <gtest/gtest.h>

namespace tyndall::reference {
namespace {

using support::pass;
using support::reject;

dvec3 direction(double cosine, double turns = 0.1) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::cos(2 * pi * turns), sine * std::sin(2 * pi * turns), cosine};
}

double refracted_cosine(double eta, double cosine) {
    return std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
}

TEST(Fresnel, DielectricsMatchKnownValues) {
    EXPECT_NEAR(fresnel_dielectric(1.5, 1), 0.04, 1e-16);
    EXPECT_NEAR(fresnel_dielectric(1 / 1.5, 1), 0.04, 1e-16);
    // At Brewster's angle only s is reflected: (cos^2 - sin^2)^2 / 2.
    const double brewster = 1 / std::sqrt(1 + 1.5 * 1.5);
    EXPECT_NEAR(fresnel_dielectric(1.5, brewster), std::pow(2 * brewster * brewster - 1, 2) / 2,
                1e-15);
    // A faint boundary, to full relative precision: ((eta - 1) / 2)^2.
    EXPECT_NEAR(fresnel_dielectric(1 + 0x1p-30, 1) / 0x1p-62, 1, 1e-8);
    // Grazing, with the slope of both polarisations: 1 - 2 c (1 + eta^2) / sqrt(eta^2 - 1).
    const double c = 1e-9;
    EXPECT_NEAR((1 - fresnel_dielectric(1.5, c)) / c, 2 * 3.25 / std::sqrt(1.25), 1e-6);
    EXPECT_EQ(fresnel_dielectric(1, 1e-300), 0);
}

TEST(Fresnel, TotalReflectionStartsAtTheCriticalAngle) {
    const double critical = std::sqrt(1 - 1 / (1.5 * 1.5));
    for (const double c : {0.0, 0.3, critical * (1 - 1e-15)})
        EXPECT_EQ(fresnel_dielectric(1 / 1.5, c), 1);
    EXPECT_LT(fresnel_dielectric(1 / 1.5, critical * (1 + 1e-6)), 1);
    for (double c = critical * (1 - 1e-15); c < critical * (1 + 1e-15); c = std::nextafter(c, 1)) {
        const double f = fresnel_dielectric(1 / 1.5, c);
        EXPECT_TRUE(f >= 0.99 && f <= 1) << f;
    }
}

TEST(Fresnel, BothSidesReflectTheSame) {
    for (const double eta : {1.0001, 1.33, 2.4}) {
        for (const double c : {0.01, 0.5, 0.99}) {
            const double f = fresnel_dielectric(eta, c);
            EXPECT_NEAR(fresnel_dielectric(1 / eta, refracted_cosine(eta, c)), f, 1e-11 * f);
            if (eta < 1.1) continue;
            EXPECT_GT(std::abs(fresnel_dielectric(1 / eta, c) - f), 1e-6 * f); // Control.
        }
    }
}

TEST(Fresnel, MetalWithoutAbsorptionIsADielectric) {
    for (const double c : {1e-6, 0.3, 1.0})
        for (const double eta : {0.7, 1.0, 1.5})
            EXPECT_NEAR(fresnel_conductor(Rgb(eta), Rgb(0), c).x, fresnel_dielectric(eta, c),
                        1e-14);
    const Rgb eta(0.2, 0.92, 1.1), k(3.9, 2.45, 2.1);
    const Rgb expected = ((eta - 1.0) * (eta - 1.0) + k * k) / ((eta + 1.0) * (eta + 1.0) + k * k);
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(fresnel_conductor(eta, k, 1)[i], expected[i], 1e-15);
}

TEST(Fresnel, RefractionObeysSnell) {
    for (const double eta : {0.7, 1.000001, 1.5}) {
        const dvec3 wo = direction(0.8), wi = refract(eta, wo, {0, 0, 1});
        EXPECT_NEAR(eta * wi.x, -wo.x, 1e-15);
        EXPECT_NEAR(eta * wi.y, -wo.y, 1e-15);
        EXPECT_LT(wi.z, 0);
        EXPECT_NEAR(glm::length(wi), 1, 1e-15);
    }
}

/// Integral over the sphere (or its upper half), by the midpoint rule in azimuth and in the angle
/// from the z axis.
template<class Function>
double integrate_directions(Function&& f, double largest_angle = pi, int steps = 700) {
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double angle = largest_angle * (i + 0.5) / steps;
        for (int j = 0; j < steps; ++j) {
            const double phi = 2 * pi * (j + 0.5) / steps, sine = std::sin(angle);
            sum += sine * f(dvec3(sine * std::cos(phi), sine * std::sin(phi), std::cos(angle)));
        }
    }
    return sum * largest_angle / steps * 2 * pi / steps;
}

TEST(Ggx, FacetsCoverTheSurfaceAndWhatIsSeenOfIt) {
    for (const double alpha : {0.1, 0.5, 1.0}) {
        const Ggx ggx{alpha};
        EXPECT_NEAR(
            integrate_directions([&](const dvec3& m) { return ggx.density(m) * m.z; }, pi / 2), 1,
            1e-4);
        for (const double cosine : {0.1, 0.6, 1.0}) {
            const dvec3 wo = direction(cosine);
            const double seen = integrate_directions(
                [&](const dvec3& m) {
                    return glm::dot(wo, m) > 0 ? ggx.visible_density(wo, m) : 0;
                },
                pi / 2);
            EXPECT_NEAR(seen, 1, 1e-3) << alpha << ' ' << cosine;
            EXPECT_GT(std::abs(seen * (1 + ggx.lambda(wo)) / (1.02 + ggx.lambda(wo)) - 1),
                      1e-3); // Control.
        }
    }
}

struct Case {
    const char* name;
    Material material;
    bool from_outside;
    double cosine;
};

Material material_of(Material::Kind kind, double eta, double alpha) {
    return {.kind = kind,
            .eta = Rgb(eta),
            .k = Rgb(kind == Material::Kind::conductor ? 2 : 0),
            .alpha = alpha};
}

const std::vector<Case> cases = {
    {"diffuse", {.kind = Material::Kind::diffuse, .reflectance = Rgb(0.7)}, true, 0.4},
    {"glass", material_of(Material::Kind::dielectric, 1.5, 0.3), true, 0.7},
    {"glass, grazing", material_of(Material::Kind::dielectric, 1.5, 0.5), true, 0.2},
    {"glass from within", material_of(Material::Kind::dielectric, 1.5, 0.4), false, 0.8},
    {"glass from within, mostly total", material_of(Material::Kind::dielectric, 1.5, 0.3), false,
     0.6},
    {"water, rough", material_of(Material::Kind::dielectric, 1.33, 1), true, 0.9},
    {"metal", material_of(Material::Kind::conductor, 0.5, 0.3), true, 0.5},
    {"metal, rough", material_of(Material::Kind::conductor, 1.2, 0.8), false, 0.3},
};

/// Averages of what is drawn, times its weight, against integrals of what is stated; for several
/// test functions, so that a wrong distribution shows.
TEST(Bsdf, DrawsWhatItStates) {
    const std::array<double (*)(const dvec3&), 4> tests = {
        [](const dvec3&) { return 1.0; }, [](const dvec3& w) { return w.z; },
        [](const dvec3& w) { return w.x; },
        [](const dvec3& w) { return w.z > 0 ? w.y * w.y : 0.0; }};
    constexpr int n = 40000;
    for (const Case& c : cases) {
        const Bsdf bsdf(c.material, c.from_outside, 0);
        const dvec3 wo = direction(c.cosine);
        std::array<double, 4> weighted{}, squares{};
        double drawn = 0;
        for (std::uint32_t i = 0; i < n; ++i) {
            const glm::uvec4 words = shared::random_block({3, 4}, 5, i, 1, 0);
            const auto s = bsdf.sample(wo, {unit(words.x), unit(words.y), unit(words.z)});
            if (!s) continue;
            ++drawn;
            const Response response = bsdf.respond(wo, s->direction);
            EXPECT_NEAR(response.density / *s->density, 1, 1e-6) << c.name;
            EXPECT_NEAR(response.value.x / (s->weight.x * *s->density), 1, 1e-6) << c.name;
            for (std::size_t k = 0; k < tests.size(); ++k) {
                const double value = s->weight.x * tests[k](s->direction);
                weighted[k] += value / n;
                squares[k] += value * value / n;
            }
        }
        const auto value = [&](std::size_t k) {
            return integrate_directions(
                [&](const dvec3& w) { return bsdf.respond(wo, w).value.x * tests[k](w); });
        };
        for (std::size_t k = 0; k < tests.size(); ++k) {
            const double error =
                std::sqrt(std::max(0.0, squares[k] - weighted[k] * weighted[k]) / n);
            EXPECT_NEAR(weighted[k], value(k), pass * error + 2e-4)
                << c.name << ' ' << k; // 2e-4: of the quadrature
        }
        const double share = drawn / n;
        const double density =
            integrate_directions([&](const dvec3& w) { return bsdf.respond(wo, w).density; });
        const double error = std::sqrt(share * (1 - share) / n);
        EXPECT_LE(density, 1 + 2e-4) << c.name;
        EXPECT_NEAR(density, share, pass * error + 2e-4) << c.name;
        EXPECT_GT(std::abs(1.05 * density - share), reject * error + 2e-4) << c.name; // Control.
    }
}

/// Helmholtz, and for refraction Veach 1997, equation 5.14: f(wi -> wo) / eta_o^2 = f(wo -> wi) /
/// eta_i^2.
TEST(Bsdf, IsReciprocal) {
    for (const Case& c : cases) {
        const Bsdf here(c.material, c.from_outside, 0), beyond(c.material, !c.from_outside, 0);
        const dvec3 wo = direction(c.cosine);
        int refracted = 0;
        for (const double z : {0.9, 0.5, 0.2, -0.95, -0.8, -0.5}) {
            for (const double turns : {0.15, 0.55, 0.7}) {
                const dvec3 wi = direction(z, turns);
                const double there = here.respond(wo, wi).value.x / std::abs(wi.z);
                if (z > 0) {
                    EXPECT_NEAR(here.respond(wi, wo).value.x / wo.z, there, 1e-9 * there) << c.name;
                    continue;
                }
                // Seen from the other side, z is turned.
                const dvec3 flip(1, 1, -1);
                const double back = beyond.respond(flip * wi, flip * wo).value.x / wo.z;
                const double eta = c.from_outside ? c.material.eta.x : 1 / c.material.eta.x;
                EXPECT_NEAR(back, eta * eta * there, 1e-9 * back) << c.name;
                refracted += there > 0;
            }
        }
        EXPECT_EQ(refracted > 0, c.material.kind == Material::Kind::dielectric) << c.name;
    }
}

/// Power: weights of refraction count eta^2 times. What is lost is light between facets, of the
/// order of their slopes squared: Lambda is about alpha^2 tan^2 / 4 on each side.
TEST(Bsdf, RoughGlassLosesOnlyLightBetweenFacets) {
    for (const double alpha : {0.01, 0.1, 0.5}) {
        for (const bool from_outside : {false, true}) {
            const Bsdf bsdf(material_of(Material::Kind::dielectric, 1.5, alpha), from_outside, 0);
            const double eta = from_outside ? 1.5 : 1 / 1.5;
            double power = 0;
            constexpr std::uint32_t n = 20000;
            for (std::uint32_t i = 0; i < n; ++i) {
                const glm::uvec4 words = shared::random_block({3, 4}, 6, i, 1, 0);
                const auto s = bsdf.sample(direction(from_outside ? 0.7 : 0.9),
                                           {unit(words.x), unit(words.y), unit(words.z)});
                if (s) power += s->weight.x * (s->direction.z > 0 ? 1 : eta * eta) / n;
            }
            EXPECT_LE(power, 1 + 1e-12);
            EXPECT_GT(power, 1 - 2 * alpha * alpha) << alpha;
        }
    }
}

} // namespace
} // namespace tyndall::reference

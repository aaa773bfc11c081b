/// Fresnel's equations and Snell's law against double precision.

#include "shader/kernel.h"
#include "spirv/boundary.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace tyndall::shader_test {
namespace {

using glm::dvec3;
using glm::vec4;

constexpr double kUnit = 0x1p-24; ///< Of rounding, relative.

/// The textbook in extended precision, where its differences keep 15 digits.
double fresnel_dielectric(double eta, double cosine) {
    const long double e = eta, c = cosine;
    const long double sine2 = (1 - c) * (1 + c) / (e * e);
    if (sine2 >= 1) return 1;
    const long double t = std::sqrt(1 - sine2);
    if (c + e * t == 0) return 0; // no boundary
    const long double s = (c - e * t) / (c + e * t), p = (e * c - t) / (e * c + t);
    return static_cast<double>((s * s + p * p) / 2);
}

double fresnel_conductor(double eta, double k, double c) {
    const std::complex<double> index(eta, k);
    const std::complex<double> t = std::sqrt(1.0 - (1 - c) * (1 + c) / (index * index));
    return (std::norm((c - index * t) / (c + index * t)) +
            std::norm((index * c - t) / (index * c + t))) /
           2;
}

class Fresnel : public GpuTest {
  protected:
    Kernel kernel_{"boundary", boundary_spirv, 1u << 18, 1u << 17};
};

/// Where the exact function lies for cosines that are off by a few roundings: near the critical
/// angle no float32 form can do better than that.
struct Range {
    double low, high;
};
Range fresnel_range(double eta, double c) {
    const double off = 8 * kUnit * c;
    const double values[] = {fresnel_dielectric(eta, c),
                             fresnel_dielectric(eta, std::max(0.0, c - off)),
                             fresnel_dielectric(eta, std::min(1.0, c + off))};
    return {*std::min_element(values, values + 3), *std::max_element(values, values + 3)};
}

} // namespace

/// Some thirty roundings on the way to a square: 64 units of them, relative, for every index and
/// angle.
TEST_F(Fresnel, OfDielectricsKeepsItsDigits) {
    std::vector<vec4> inputs;
    for (const float eta :
         {1.0001f, 1.01f, 1.33f, 1.5f, 2.4f, 4.0f, 0.9999f, 0.75f, 1.0f + 0x1p-23f})
        for (const bool entering : {true, false})
            for (int i = 0; i <= 4096; ++i) {
                const double x = i / 4096.0; // dense next to grazing; 0 and 1 too
                inputs.emplace_back(eta, static_cast<float>(i % 2 ? x * x * x * x : x), entering,
                                    0);
                inputs.emplace_back(0);
            }
    const auto count = static_cast<std::uint32_t>(inputs.size() / 2);
    const auto worst = [&](std::uint32_t variant) {
        const auto found = kernel_.run<vec4>({.function = 0, .variant = variant}, inputs, count);
        double most = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const vec4& in = inputs[2 * i];
            const double index = in.z != 0 ? double{in.x} : 1.0 / in.x;
            const Range range = fresnel_range(index, in.y);
            const double f = found[i].x;
            const double off = std::max(range.low - f, f - range.high) / range.high;
            most = f >= 0 && f <= 1 ? std::max(most, off) : INFINITY;
        }
        return most / kUnit;
    };
    EXPECT_LT(worst(0), 64);
    EXPECT_GT(worst(1), 10000) << "no teeth";
}

TEST_F(Fresnel, AtTheEnds) {
    struct End {
        float eta, cosine, entering, expected;
    };
    const float critical = std::sqrt(1 - 1 / 2.25f);
    const std::vector<End> ends{
        {1.5f, 1, 1, 0.04f},   {1.5f, 0, 1, 1},        {1.5f, 0, 0, 1}, {1.5f, 1e-20f, 1, 1},
        {1.5f, 0.7453f, 0, 1}, {1.5f, 0.75f, 0, 0.5f}, {1, 0, 1, 0},    {1, 1e-8f, 0, 0},
        {1, 1, 1, 0},          {1.5f, critical, 0, 1}};
    std::vector<vec4> inputs;
    for (const End& e : ends) {
        inputs.emplace_back(e.eta, e.cosine, e.entering, 0);
        inputs.emplace_back(0);
    }
    const auto count = static_cast<std::uint32_t>(ends.size());
    const auto found = kernel_.run<vec4>({.function = 0}, inputs, count);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        EXPECT_NEAR(found[i].x, ends[i].expected, 64 * kUnit * ends[i].expected) << i;
        const double f = ends[i].expected;
        EXPECT_NEAR(found[i].y, 2 * f / (1 + f), 64 * kUnit) << i;
    }
    // At the critical angle a few roundings decide, and the curve is steep: 1 - F ~ sqrt(8
    // roundings).
    EXPECT_GT(found.back().x, 1 - 8 * std::sqrt(8 * kUnit));
    EXPECT_LE(found.back().x, 1);
    const auto naive = kernel_.run<vec4>({.function = 0, .variant = 1}, inputs, count);
    EXPECT_NE(naive[6].x, 0) << "no teeth: 0 / 0 went well";
}

/// A metal's index by channel: copper, gold, silver, titanium; and glass as a metal that does not
/// absorb.
TEST_F(Fresnel, OfMetalsKeepsItsDigits) {
    std::vector<vec4> inputs;
    const glm::vec3 etas[] = {{0.2f, 0.92f, 1.1f},
                              {0.14f, 0.37f, 1.44f},
                              {0.05f, 0.06f, 0.04f},
                              {2.16f, 1.9f, 1.6f},
                              {1.5f, 1.3f, 2.4f}};
    const glm::vec3 ks[] = {{3.9f, 2.45f, 2.1f},
                            {3.98f, 2.4f, 1.6f},
                            {4.4f, 3.6f, 2.6f},
                            {2.9f, 2.5f, 2.2f},
                            {0, 0, 0}};
    for (std::size_t metal = 0; metal < std::size(etas); ++metal)
        for (int i = 0; i <= 1024; ++i) {
            const double x = i / 1024.0;
            inputs.emplace_back(etas[metal], static_cast<float>(i % 2 ? x * x * x : x));
            inputs.emplace_back(ks[metal], 0);
        }
    const auto count = static_cast<std::uint32_t>(inputs.size() / 2);
    const auto worst = [&](std::uint32_t variant) {
        const auto found = kernel_.run<vec4>({.function = 1, .variant = variant}, inputs, count);
        double most = 0;
        for (std::uint32_t i = 0; i < count; ++i)
            for (int c = 0; c < 3; ++c) {
                const double exact =
                    fresnel_conductor(inputs[2 * i][c], inputs[2 * i + 1][c], inputs[2 * i].w);
                const double off = std::abs(found[i][c] / exact - 1);
                most = std::isfinite(off) ? std::max(most, off) : INFINITY;
            }
        return most / kUnit;
    };
    EXPECT_LT(worst(0), 64);
    EXPECT_GT(worst(1), 1000) << "no teeth";
}

/// Snell's law, in the plane of incidence; the bend itself is exact where the index is next to 1.
TEST_F(Fresnel, RefractionObeysSnell) {
    std::vector<vec4> inputs;
    for (const float eta : {1.0001f, 1.33f, 2.4f, 0.7f})
        for (const bool entering : {true, false})
            for (int i = 1; i <= 1024; ++i) {
                const double z = i / 1024.0, r = std::sqrt((1 - z) * (1 + z));
                const dvec3 w(r * std::cos(i), r * std::sin(i), z);
                const double index = entering ? double{eta} : 1.0 / eta;
                if ((1 - w.z * w.z) / (index * index) > 0.999) continue;
                inputs.emplace_back(w, eta);
                inputs.emplace_back(entering, 0, 0, 0);
            }
    const auto count = static_cast<std::uint32_t>(inputs.size() / 2);
    const auto worst = [&](std::uint32_t variant) {
        const auto found = kernel_.run<vec4>({.function = 3, .variant = variant}, inputs, count);
        double most = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const dvec3 w(inputs[2 * i]), wi(found[i]);
            const double eta = inputs[2 * i].w;
            const double index = inputs[2 * i + 1].x != 0 ? eta : 1 / eta;
            const double z = -std::sqrt(1 - (w.x * w.x + w.y * w.y) / (index * index));
            most = std::max(most, glm::length(wi - dvec3(-w.x / index, -w.y / index, z)));
        }
        return most;
    };
    // Errors of the square under the root, 8 roundings of at most 6 (eta 2.4), over the least root.
    EXPECT_LT(worst(0), 8 * 6 * kUnit / std::sqrt(0.001));
    EXPECT_GT(worst(1), 0.01) << "no teeth";
}

} // namespace tyndall::shader_test

#include "selftest/functions.h"

#include "selftest/evaluator.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <numbers>

namespace tyndall::selftest {
namespace {

using glm::dvec2;
using glm::dvec4;
using glm::vec4;
using std::numbers::pi;

constexpr double kUlp = 0x1p-23; ///< Of 1 in float32.

struct Function {
    std::string name;
    std::uint32_t id;
    std::vector<vec4> arguments;
    std::function<dvec2(const dvec4&)>
        exact; ///< x, y of the values; y equals x where there is one.
    double allowed;
    bool is_absolute = false;
    /// By how much rounding of the arguments is magnified; errors are divided by it.
    std::function<double(const dvec4&)> condition = [](const dvec4&) { return 1.0; };
};

/// count numbers from `least` to `most`, evenly by their logarithms.
std::vector<float> spread(double least, double most, int count) {
    std::vector<float> list;
    for (int i = 0; i < count; ++i)
        list.push_back(static_cast<float>(least * std::pow(most / least, i / (count - 1.0))));
    return list;
}

/// Numbers of [0, 1) on the grid of 2^-24, the ends and what is next to them included.
std::vector<float> draws() {
    std::vector<float> list{0,    0x1p-24F,        0x1p-23F,     0.5F - 0x1p-24F,
                            0.5F, 0.5F + 0x1p-24F, 1 - 0x1p-23F, 1 - 0x1p-24F};
    for (int i = 0; i < 128; ++i)
        list.push_back(static_cast<float>(i * 131071 % (1 << 24)) * 0x1p-24F);
    for (float tiny : spread(0x1p-22, 0.25, 32)) {
        list.push_back(std::floor(tiny * 0x1p24F) * 0x1p-24F);
        list.push_back(1 - std::floor(tiny * 0x1p24F) * 0x1p-24F);
    }
    return list;
}

std::vector<float> asymmetries() {
    std::vector<float> list{0};
    for (float g : {1e-8F, 1e-6F, 1e-4F, 0.01F, 0.3F, 0.9F, 0.99F, 0.999F, 0.9999F, 0.99999F}) {
        list.push_back(g);
        list.push_back(-g);
    }
    return list;
}

std::vector<vec4> pairs(const std::vector<float>& first, const std::vector<float>& second) {
    std::vector<vec4> list;
    for (float a : first)
        for (float b : second)
            list.emplace_back(a, b, 0, 0);
    return list;
}

/// Unit vectors at angles from 1e-6 to pi off +z, with a parameter.
std::vector<vec4> directions() {
    std::vector<vec4> list;
    for (float g : asymmetries())
        for (double angle : spread(1e-6, pi, 96)) {
            list.emplace_back(std::sin(angle), 0, std::cos(angle), g);
            list.emplace_back(std::sin(angle), 0, -std::cos(angle), g);
        }
    return list;
}

dvec2 same(double value) {
    return dvec2(value);
}

/// 1 - mu and 1 + mu as the identities of Henyey and Greenstein's inversion have them.
dvec2 draw_hg(const dvec4& a) {
    const double g = a.x, xi = a.y, d = 1 - g + 2 * g * xi;
    return {2 * (1 - xi) * (1 - g) * (1 - g) * (1 + g * xi) / (d * d),
            2 * xi * (1 + g) * (1 + g) * (1 - g * (1 - xi)) / (d * d)};
}

dvec2 draw_schlick(const dvec4& a) {
    const double k = a.x, xi = a.y, d = 1 - k + 2 * k * xi;
    return {2 * (1 - xi) * (1 - k) / d, 2 * xi * (1 + k) / d};
}

dvec2 draw_rayleigh(const dvec4& a) {
    const double mu = 2 * std::sinh(std::asinh(4 * a.y - 2) / 3); // root of mu^3 + 3 mu = 8 xi - 4
    return {1 - mu, 1 + mu};
}

/// 1 - |mu| between the z axis and the direction, on the side to which g scatters. The direction is
/// of unit length only up to rounding.
double complement(const dvec4& a) {
    const glm::dvec3 to = glm::normalize(glm::dvec3(a));
    const glm::dvec3 difference = to - glm::dvec3(0, 0, a.w < 0 ? -1 : 1);
    return 0.5 * glm::dot(difference, difference);
}

dvec2 value_hg(const dvec4& a) {
    const double g = std::abs(a.w), base = (1 - g) * (1 - g) + 2 * g * complement(a);
    return same((1 - g * g) / (4 * pi * base * std::sqrt(base)));
}

dvec2 value_schlick(const dvec4& a) {
    const double k = std::abs(a.w), base = (1 - k) + k * complement(a);
    return same((1 - k * k) / (4 * pi * base * base));
}

/// (eta cos_t)^2, which is not positive where all is reflected.
long double refracted(const dvec4& a) {
    const long double eta = a.z != 0 ? a.x : 1 / static_cast<long double>(a.x), c = a.y;
    return eta * eta - 1 + c * c;
}

/// In extended precision, as the textbook has it.
dvec2 fresnel(const dvec4& a) {
    const long double eta = a.z != 0 ? a.x : 1 / static_cast<long double>(a.x), c = a.y;
    const long double squared = refracted(a);
    if (squared <= 0) return same(1);
    const long double t = std::sqrt(squared), s = (c - t) / (c + t);
    const long double p = (eta * eta * c - t) / (eta * eta * c + t);
    return same(static_cast<double>((s * s + p * p) / 2));
}

dvec2 column(const dvec4& a) {
    const double fall = a.y / a.z; // height, rise, scale height, distance
    const double length = fall == 0 ? a.w : -std::expm1(-fall * a.w) / fall;
    return same(std::exp(-a.x / a.z) * length);
}

std::vector<vec4> boundaries() {
    std::vector<vec4> list;
    for (float eta : {1 + 1e-6F, 1.001F, 1.33F, 1.5F, 2.4F})
        for (float side : {0.0F, 1.0F}) {
            const float critical = std::sqrt((eta - 1) * (eta + 1)) / eta;
            for (float c : spread(1e-6, 1, 64))
                list.emplace_back(eta, c, side, 0);
            for (float nearly : {0.999F, 0.9999F, 1.0001F, 1.001F}) // next to total reflection
                list.emplace_back(eta, std::min(1.0F, nearly * critical), side, 0);
        }
    return list;
}

std::vector<vec4> lines() {
    std::vector<vec4> list;
    for (float rise : {0.0F, 1e-6F, -1e-6F, 1e-3F, -1e-3F, 0.1F, -0.1F, 1.0F, -1.0F})
        for (float distance : spread(1e-3, 8, 16))
            list.emplace_back(0.5F, rise, 2.0F, distance);
    return list;
}

std::vector<vec4> attenuations() {
    std::vector<vec4> list;
    for (float depth : spread(1e-8, 80, 64))
        for (float sigma : {1e-30F, 1e-6F, 1.0F, 1e6F, 1e30F})
            list.emplace_back(sigma, depth / sigma, 0, 0);
    return list;
}

/// 32-bit words, as their upper and lower halves.
std::vector<vec4> words() {
    std::vector<vec4> list;
    const auto add = [&](std::uint32_t w) { list.emplace_back(w >> 16, w & 0xFFFFu, 0, 0); };
    for (std::uint32_t w : {0u, 1u, 2u, 0x7FFFFFFFu, 0x80000000u, 0xB504F333u, 0xB504F334u,
                            0xFFFFFF7Fu, 0xFFFFFF80u, 0xFFFFFFFFu})
        add(w);
    for (std::uint32_t i = 0; i < 2048; ++i)
        add(i * 2097169u);
    return list;
}

dvec2 exponential(const dvec4& a) {
    const double w = 65536 * a.x + a.y, v = (w + 0.5) * 0x1p-32;
    return same(v < 0.5 ? -std::log(v) : -std::log1p(-(0xFFFFFFFFu - w + 0.5) * 0x1p-32));
}

std::vector<vec4> singles(const std::vector<float>& numbers) {
    return pairs(numbers, {0});
}

std::vector<Function> functions() {
    using namespace shared;
    return {
        {"exponential variates", FUNCTION_EXPONENTIAL, words(), exponential, 4 * kUlp},
        {"sine and cosine, absolute", FUNCTION_SINES, singles(draws()),
         [](const dvec4& a) { return dvec2(std::sin(2 * pi * a.x), std::cos(2 * pi * a.x)); }, kUlp,
         true},
        {"1 - exp(-x)", FUNCTION_ONE_MINUS_EXP, singles(spread(1e-30, 50, 512)),
         [](const dvec4& a) { return same(-std::expm1(-a.x)); }, 8 * kUlp},
        // (3 + 2 tau) ulp are what Vulkan allows to exp, and tau to its argument.
        {"transmittance", FUNCTION_ATTENUATION, attenuations(),
         [](const dvec4& a) { return same(std::exp(-a.x * a.y)); }, 3 * kUlp, false,
         [](const dvec4& a) { return 1 + a.x * a.y; }},
        {"Henyey-Greenstein, draws", FUNCTION_HG_DRAW, pairs(asymmetries(), draws()), draw_hg,
         8 * kUlp},
        {"Schlick, draws", FUNCTION_SCHLICK_DRAW, pairs(asymmetries(), draws()), draw_schlick,
         6 * kUlp},
        {"Rayleigh, draws, absolute", FUNCTION_RAYLEIGH_DRAW, pairs({0}, draws()), draw_rayleigh,
         4 * kUlp, true},
        {"Henyey-Greenstein, values", FUNCTION_HG_VALUE, directions(), value_hg, 16 * kUlp},
        {"Schlick, values", FUNCTION_SCHLICK_VALUE, directions(), value_schlick, 16 * kUlp},
        {"Fresnel", FUNCTION_FRESNEL, boundaries(), fresnel, 16 * kUlp, false,
         [](const dvec4& a) {
             return 1 + static_cast<double>(std::max(a.y * a.y, 1.0) / std::abs(refracted(a)));
         }},
        {"MIS weights, 1e-30 to 1e30", FUNCTION_HEURISTIC,
         pairs(spread(1e-30, 1e30, 61), spread(1e-30, 1e30, 60)),
         [](const dvec4& a) { return same(1 / (1 + a.y / a.x * (a.y / a.x))); }, 6 * kUlp},
        {"columns of an atmosphere", FUNCTION_COLUMN, lines(), column, 16 * kUlp},
    };
}

/// The error of a value that is off by `miss`. Denormal numbers may be flushed to 0.
double error_of(const Function& f, const vec4& a, double exact, double miss) {
    constexpr double least_normal = 0x1p-126;
    if (miss < least_normal) return 0;
    return miss / (f.is_absolute ? 1 : std::abs(exact)) / f.condition(dvec4(a));
}

Row check(Evaluator& evaluator, const Function& f, double corrupt) {
    const std::vector<vec4> values = evaluator.evaluate(f.id, f.arguments);
    double worst = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const dvec2 exact = f.exact(dvec4(f.arguments[i]));
        for (int k = 0; k < 2; ++k) {
            const double value = (1 + corrupt) * values[i][k];
            const double error = error_of(f, f.arguments[i], exact[k], std::abs(value - exact[k]));
            worst = error <= worst ? worst : error; // not a number is the worst
        }
    }
    return {f.name, 0, worst, f.allowed};
}

/// Known answers of Philox4x32-10 (Salmon et al. 2011): how many of the words differ.
Row check_philox(Evaluator& evaluator, double corrupt) {
    const std::vector<vec4> counters{vec4(0)};
    const vec4 found = evaluator.evaluate(shared::FUNCTION_PHILOX, counters)[0];
    constexpr std::array<std::uint32_t, 4> known{0x6627E8D5u, 0xE169C58Du, 0xBC57AC4Cu,
                                                 0x9B00DBD8u};
    double wrong = corrupt != 0 ? 1 : 0;
    for (int k = 0; k < 4; ++k)
        wrong += std::bit_cast<std::uint32_t>(found[k]) != known[static_cast<std::size_t>(k)];
    return {"random words that are wrong", 0, wrong, 0};
}

} // namespace

std::vector<Row> check_functions(const gpu::Context& context, double corrupt) {
    Evaluator evaluator(context);
    std::vector<Row> rows{check_philox(evaluator, corrupt)};
    for (const Function& f : functions())
        rows.push_back(check(evaluator, f, corrupt));
    return rows;
}

} // namespace tyndall::selftest

/// Elementary functions and warps of shaders/lib against closed forms in double precision, with the
/// naive form as control.

#include "shader/kernel.h"
#include "spirv/elementary.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace tyndall::shader_test {
namespace {

using glm::uvec4;
using glm::vec4;
using std::numbers::pi;

enum Function : std::uint32_t { // as in elementary.comp
    exponential,
    sines,
    complement_of_exp,
    frames,
    walk,
    disk,
    triangle,
    heuristic,
    cone,
    spot,
    triangle_filter
};

constexpr std::uint32_t kMost = 1u << 20;

class Elementary : public GpuTest {
  protected:
    std::vector<vec4> run(const Task& task, const std::vector<vec4>& inputs) {
        return kernel_.run<vec4>(task, inputs, static_cast<std::uint32_t>(inputs.size()));
    }
    std::vector<float> exponentials(const std::vector<std::uint32_t>& words,
                                    std::uint32_t variant = 0) {
        std::vector<uvec4> inputs;
        for (std::uint32_t word : words)
            inputs.emplace_back(word);
        const auto found = kernel_.run<vec4>({.function = exponential, .variant = variant}, inputs,
                                             static_cast<std::uint32_t>(inputs.size()));
        std::vector<float> values;
        for (const vec4& f : found)
            values.push_back(f.x);
        return values;
    }
    Kernel kernel_{"elementary", elementary_spirv, kMost, 2 * kMost};
};

double relative(double found, double exact) {
    return std::abs(found / exact - 1);
}

/// Unit vectors: the hard ones, then random ones, the last of them close to -z.
std::vector<vec4> directions(std::size_t count) {
    std::vector<vec4> list{{0, 0, 1, 0},       {0, 0, -1, 0},      {1e-20f, 0, -1, 0},
                           {0, 1e-20f, -1, 0}, {-1e-20f, 0, 1, 0}, {1, 0, 0, 0},
                           {0, -1, 0, 0},      {1, 0, -0.0f, 0}};
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    while (list.size() < count) {
        glm::dvec3 d(normal(random), normal(random), normal(random));
        if (list.size() > count / 2)
            d = {d.x * std::pow(10, -12 * uniform(random)), d.y * 1e-4, -1};
        list.emplace_back(glm::normalize(d), 0);
    }
    return list;
}

} // namespace

/// ORACLES T1 and T2.
TEST_F(Elementary, ExponentialVariatesAreFiniteAndMonotoneAndReachTheTail) {
    std::vector<std::uint32_t> words{0, 1, 1u << 31, 0xffffff7f, 0xffffff80, 0xffffffff};
    for (std::uint32_t i = 0; i < kMost - 6; ++i)
        words.push_back(i * 4099u); // coprime to 2^32: no repetition
    std::sort(words.begin(), words.end());
    const auto values = exponentials(words);
    for (std::size_t i = 0; i < values.size(); ++i) {
        ASSERT_TRUE(std::isfinite(values[i])) << words[i];
        ASSERT_FALSE(std::signbit(values[i])) << words[i];
        ASSERT_LE(values[i], 22.88f) << words[i];
        // Neighbours may differ by the rounding of their logarithms.
        const float before = i > 0 ? values[i - 1] : INFINITY;
        ASSERT_LE(values[i], before * (1 + 0x1p-21f)) << words[i];
    }
    EXPECT_GT(values.back(), 0);

    std::vector<std::uint32_t> least(4096), grid(4096);
    for (std::uint32_t i = 0; i < 4096; ++i) {
        least[i] = i;
        grid[i] = ~i; // the naive form has its tail at the other end
    }
    const auto in_tail = [](const std::vector<float>& list) {
        return std::count_if(list.begin(), list.end(), [](float tau) { return tau > 16; });
    };
    EXPECT_NEAR(static_cast<double>(in_tail(exponentials(least))), 483, 1);
    EXPECT_GT(std::abs(static_cast<double>(in_tail(exponentials(grid, 1))) - 483), 100)
        << "no teeth";
}

TEST_F(Elementary, ExponentialVariatesHaveASmallRelativeError) {
    std::vector<std::uint32_t> words;
    for (std::uint32_t i = 0; i < 1u << 16; ++i) {
        words.push_back(i);
        words.push_back(~i);
        words.push_back(0xB504F334u - (1u << 15) + i); // where the two branches meet
        words.push_back(i << 16 | 0x8000u);
    }
    const auto worst = [&](const std::vector<float>& values, bool mirrored) {
        double most = 0;
        for (std::size_t i = 0; i < words.size(); ++i) {
            const std::uint32_t word = mirrored ? ~words[i] : words[i];
            const long double v = (word + 0.5L) * 0x1p-32L, c = (~word + 0.5L) * 0x1p-32L;
            const auto exact = static_cast<double>(v < 0.5L ? -std::log(v) : -std::log1p(-c));
            most = std::max(most, relative(double{values[i]}, exact));
        }
        return most;
    };
    EXPECT_LT(worst(exponentials(words), false), 4e-7);
    EXPECT_GT(worst(exponentials(words, 1), true), 0.1) << "no teeth";
}

/// All of the 2^24 arguments that random numbers can give, and 1.
TEST_F(Elementary, SinesAreExactTo12e8) {
    const auto worst = [&](std::uint32_t variant) {
        double most = 0;
        for (std::uint32_t first = 0; first < 1u << 24; first += kMost) {
            const auto found =
                kernel_.run<vec4>({.function = sines, .variant = variant, .first = first}, kMost);
            for (std::uint32_t i = 0; i < kMost; ++i) {
                const double angle = 2 * pi * ((first + i) * 0x1p-24);
                const double s = std::sin(angle), c = std::cos(angle);
                most = std::max({most, std::abs(found[i].x - s), std::abs(found[i].y - c)});
            }
        }
        return most;
    };
    EXPECT_LT(worst(0), 1.2e-7);
    EXPECT_GT(worst(1), 2e-7) << "no teeth";
    const auto end = kernel_.run<vec4>({.function = sines, .first = 1u << 24}, 1)[0];
    EXPECT_NEAR(end.x, 0, 1.2e-7);
    EXPECT_EQ(end.y, 1);
}

TEST_F(Elementary, OneMinusExpDoesNotCancel) {
    std::vector<vec4> inputs;
    for (std::uint32_t i = 0; i < 1u << 18; ++i)
        inputs.emplace_back(std::pow(10.0, -30 + 33 * (i * 0x1p-18)));
    const auto worst = [&](std::uint32_t variant) {
        const auto found = run({.function = complement_of_exp, .variant = variant}, inputs);
        double most = 0;
        for (std::size_t i = 0; i < inputs.size(); ++i)
            most = std::max(most, relative(found[i].x, -std::expm1(-double{inputs[i].x})));
        return most;
    };
    EXPECT_LT(worst(0), 1e-6); // that of exp(-0.25), over 1 - exp(-0.25)
    EXPECT_GT(worst(1), 0.5) << "no teeth";
    EXPECT_EQ(run({.function = complement_of_exp}, {vec4(0)})[0].x, 0);
    EXPECT_EQ(run({.function = complement_of_exp}, {vec4(INFINITY)})[0].x, 1);
}

/// ORACLES T43.
TEST_F(Elementary, FramesAreOrthonormalEverywhere) {
    const std::vector<vec4> normals = directions(1u << 18);
    struct Frame {
        vec4 s, t;
    };
    const auto worst = [&](std::uint32_t variant) {
        const auto found = kernel_.run<Frame>({.function = frames, .variant = variant}, normals,
                                              static_cast<std::uint32_t>(normals.size()));
        double most = 0;
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const glm::dvec3 n(normals[i]), s(found[i].s), t(found[i].t);
            const glm::dvec3 handed = glm::cross(s, t) - n;
            for (double off : {glm::dot(s, s) - 1, glm::dot(t, t) - 1, glm::dot(s, t),
                               glm::dot(s, n), glm::dot(t, n), glm::length(handed)})
                most = std::isfinite(off) ? std::max(most, std::abs(off)) : INFINITY;
        }
        return most;
    };
    EXPECT_LT(worst(0), 1e-6);
    EXPECT_GT(worst(1), 1e-2) << "no teeth";
}

/// ORACLES T43: 64 walks of 10^5 deflections.
TEST_F(Elementary, DeflectedDirectionsStayNormalised) {
    const auto worst = [&](std::uint32_t variant) {
        double most = 0;
        const Task task{.function = walk, .variant = variant, .number = 1e5f};
        for (const vec4& end : kernel_.run<vec4>(task, 64))
            most = std::max(most, double{end.w});
        return most; // of |d^2 - 1|, twice that of |d|
    };
    EXPECT_LT(worst(0), 2 * 1.8e-7);
    EXPECT_GT(worst(1), 1e-4) << "no teeth";
}

/// Shirley and Chiu's map, as pbrt-v4 writes it (sampling.h, SampleUniformDiskConcentric).
TEST_F(Elementary, DisksAreMappedConcentrically) {
    const auto map = [](double u, double v) {
        const double x = 2 * u - 1, y = 2 * v - 1;
        if (x == 0 && y == 0) return glm::dvec2(0);
        const bool wide = std::abs(x) > std::abs(y);
        const double r = wide ? x : y;
        const double angle = wide ? pi / 4 * (y / x) : pi / 2 - pi / 4 * (x / y);
        return glm::dvec2(r * std::cos(angle), r * std::sin(angle));
    };
    std::vector<vec4> inputs;
    for (int i = 0; i < 1024; ++i)
        for (int k = 0; k < 1024; ++k)
            inputs.emplace_back(i / 1024.0, k / 1024.0, 0, 0);
    const auto found = run({.function = disk}, inputs);
    double worst = 0, swapped = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const glm::dvec2 p(found[i]);
        worst = std::max(worst, glm::length(p - map(inputs[i].x, inputs[i].y)));
        swapped = std::max(swapped, glm::length(p - map(inputs[i].y, inputs[i].x)));
        ASSERT_LE(glm::length(p), 1 + 2e-7);
    }
    EXPECT_LT(worst, 4e-7); // of it a square root and a division, which may be off by 1.5e-7 each
    EXPECT_GT(swapped, 0.1) << "no teeth";
}

TEST_F(Elementary, TrianglePointsAreUniform) {
    std::vector<vec4> inputs;
    for (int i = 0; i < 1024; ++i)
        for (int k = 0; k < 1024; ++k)
            inputs.emplace_back((i + 0.5) / 1024, (k + 0.5) / 1024, 0, 0);
    const auto found = run({.function = triangle}, inputs);
    glm::dvec3 mean(0), square(0);
    double worst = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const double s = std::sqrt(double{inputs[i].x});
        const glm::dvec3 exact(1 - s, inputs[i].y * s, s - inputs[i].y * s);
        worst = std::max(worst, glm::length(glm::dvec3(found[i]) - exact));
        mean += glm::dvec3(found[i]) / double{kMost};
        square += glm::dvec3(found[i]) * glm::dvec3(found[i]) / double{kMost};
    }
    EXPECT_LT(worst, 2e-7);
    for (int c = 0; c < 3; ++c) { // moments of the uniform distribution; midpoint rule
        EXPECT_NEAR(mean[c], 1 / 3.0, 1e-5);
        EXPECT_NEAR(square[c], 1 / 6.0, 1e-5);
    }
}

TEST_F(Elementary, PowerHeuristicNeitherOverflowsNorCancels) {
    std::vector<vec4> inputs;
    for (double a = -35; a <= 35; a += 0.5)
        for (double b = -35; b <= 35; b += 0.5)
            inputs.emplace_back(std::pow(10, a), std::pow(10, b), 0, 0);
    const auto worst = [&](std::uint32_t variant) {
        const auto found = run({.function = heuristic, .variant = variant}, inputs);
        double most = 0;
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const double ratio = double{inputs[i].y} / double{inputs[i].x};
            const double exact = 1 / (1 + ratio * ratio);
            const double off = std::abs(found[i].x - exact);
            most = std::isfinite(off) ? std::max(most, off) : INFINITY;
        }
        return most;
    };
    EXPECT_LT(worst(0), 1e-6);
    EXPECT_GT(worst(1), 0.1) << "no teeth";
    const auto ends = run({.function = heuristic}, {vec4(1, 0, 0, 0), vec4(0, 1, 0, 0)});
    EXPECT_EQ(ends[0].x, 1);
    EXPECT_EQ(ends[1].x, 0);
}

TEST_F(Elementary, NarrowConesKeepTheirSolidAngle) {
    std::vector<vec4> inputs;
    for (int i = 0; i <= 4000; ++i)
        inputs.emplace_back(std::pow(10.0, -20 + i * 0.005));
    const auto worst = [&](std::uint32_t variant) {
        const auto found = run({.function = cone, .variant = variant}, inputs);
        double most = 0;
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const double sin2 = std::min(1.0, double{inputs[i].x});
            most = std::max(most, relative(found[i].x, sin2 / (1 + std::sqrt(1 - sin2))));
        }
        return most;
    };
    // Near a half sphere 1 - sin2 is known to 2^-25, its root to the root of that.
    EXPECT_LT(worst(0), 3e-4);
    inputs.resize(inputs.size() - 100);
    EXPECT_LT(worst(0), 1e-6);
    EXPECT_GT(worst(1), 0.5) << "no teeth";
}

/// Wide and narrow cones: smoothstep of the cosine, from complements 1 - cos.
TEST_F(Elementary, SpotlightsFadeSmoothly) {
    const auto complement = [](double angle) { return 2 * std::pow(std::sin(angle / 2), 2); };
    double worst = 0, from_cosines = 0;
    for (const double width : {1.2, 0.1, 1e-3}) {
        const double start = 0.8 * width;
        std::vector<vec4> inputs;
        for (int i = 0; i <= 1000; ++i)
            inputs.emplace_back(complement(1.2 * width * i / 1000), complement(width),
                                complement(start), 0);
        const auto found = run({.function = spot}, inputs);
        const auto step = [](double x) {
            x = std::clamp(x, 0.0, 1.0);
            return x * x * (3 - 2 * x);
        };
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const vec4 c = inputs[i];
            const double exact = step((double{c.y} - c.x) / (double{c.y} - c.z));
            worst = std::max(worst, std::abs(found[i].x - exact));
            const vec4 cosine = 1.0f - c;
            const double naive =
                step((double{cosine.x} - cosine.y) / (double{cosine.z} - cosine.y));
            from_cosines = std::max(from_cosines, std::abs(naive - exact));
        }
    }
    EXPECT_LT(worst, 2e-6);
    EXPECT_GT(from_cosines, 0.05) << "no teeth";
}

TEST_F(Elementary, TriangleFilterIsInverted) {
    std::vector<vec4> inputs;
    for (std::uint32_t i = 0; i < kMost; ++i)
        inputs.emplace_back(static_cast<float>(i) * 0x1p-20f);
    const double radius = 2;
    const auto found =
        run({.function = triangle_filter, .number = static_cast<float>(radius)}, inputs);
    double worst = 0, wrong = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        // The cumulative integral at what came out is what went in.
        const double x = found[i].x / radius;
        const double cdf = x < 0 ? (1 + x) * (1 + x) / 2 : 1 - (1 - x) * (1 - x) / 2;
        worst = std::max(worst, std::abs(cdf - inputs[i].x));
        wrong = std::max(wrong, std::abs(0.5 * (1 + x) - inputs[i].x)); // a box
    }
    EXPECT_LT(worst, 2e-7);
    EXPECT_GT(wrong, 0.1) << "no teeth";
}

} // namespace tyndall::shader_test

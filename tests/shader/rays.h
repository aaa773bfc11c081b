/// Rays and random numbers for the tests of intersections.
#pragma once

#include "shader/kernel.h"

#include <cmath>
#include <random>

namespace tyndall::shader_test {

inline constexpr double kEpsilon = 0x1p-24; ///< Half an ulp of 1, as in shaders/lib.

struct RayTexels {
    glm::vec4 origin, direction;
};
inline RayTexels make_ray(glm::dvec3 origin, glm::dvec3 direction) {
    return {glm::vec4(origin, 0), glm::vec4(direction, 0)};
}
inline glm::dvec3 origin_of(const RayTexels& ray) {
    return glm::dvec3(ray.origin);
}
inline glm::dvec3 direction_of(const RayTexels& ray) {
    return glm::dvec3(ray.direction);
}

/// What intersect.comp gives for one ray and one primitive.
struct HitTexel {
    float t, is_hit, a, b; ///< a, b: far distance of a sphere, or parameters of a patch
    bool hit() const { return is_hit != 0; }
};

class Randomness {
  public:
    explicit Randomness(unsigned seed) : engine_(seed) {}
    double uniform(double low, double high) {
        return std::uniform_real_distribution(low, high)(engine_);
    }
    glm::dvec3 in_cube(double half) {
        const double x = uniform(-half, half), y = uniform(-half, half);
        return {x, y, uniform(-half, half)};
    }
    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 d = in_cube(1);
            const double square = glm::dot(d, d);
            if (square > 1e-4 && square <= 1) return d / std::sqrt(square);
        }
    }
    /// A multiple of 2^-6 in [-half, half]: differences and midpoints of such numbers are exact.
    double on_grid(double half) { return std::round(uniform(-half, half) * 64) / 64; }
    glm::dvec3 grid_point(double half) {
        const double x = on_grid(half), y = on_grid(half);
        return {x, y, on_grid(half)};
    }
    int below(int n) { return std::uniform_int_distribution(0, n - 1)(engine_); }

  private:
    std::mt19937 engine_;
};

} // namespace tyndall::shader_test

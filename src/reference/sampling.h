/// Random words, and the mappings from them to directions and discs that the renderers share.
#pragma once

#include "scene/scene.h"
#include "shared/random.h"
#include "shared/sobol.h"

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>

namespace tyndall::reference {

using glm::dmat3;
using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using std::numbers::pi;

struct Ray {
    dvec3 origin;
    dvec3 direction; ///< Unit length, but for rays in the space of an object.
};

/// The random numbers of one path.
struct RandomPath {
    glm::uvec2 seed;
    std::uint32_t pixel = 0; ///< Its index in the picture; for zsobol, its Morton code.
    std::uint32_t sample = 0;
    Sampler sampler = Sampler::independent;
    std::uint32_t zsobol_bits = 0; ///< Scene::zsobol_bits
    /// From the end of this event's flight on, the path goes on as another sample would: two paths
    /// with one beginning.
    std::uint32_t branch_event = 0xFFFFFFFF;

    glm::uvec4 words(std::uint32_t event, std::uint32_t block) const {
        if (event < branch_event) return words_of(sample, event, block);
        glm::uvec4 other = words_of(~sample, event, block);
        if (event == branch_event && block == shared::BLOCK_PATH)
            other.x = words_of(sample, event, block).x;
        return other;
    }

    /// Of event 0: two for the place in the pixel, two for that on the lens.
    glm::uvec4 camera_words() const {
        const glm::uvec4 own = words(0, shared::BLOCK_PATH);
        return sampler == Sampler::independent ? own : shared::pairs_in_order(own);
    }

  private:
    glm::uvec4 words_of(std::uint32_t index, std::uint32_t event, std::uint32_t block) const {
        if (sampler == Sampler::sobol && block <= shared::BLOCK_LIGHT)
            return shared::sobol_block(seed, pixel, index, event, block);
        if (sampler == Sampler::zsobol && block <= shared::BLOCK_LIGHT)
            return shared::zsobol_block(seed, pixel, index, event, block, zsobol_bits);
        return shared::random_block(seed, pixel, index, event, block);
    }
};

/// A word as a number in [0, 1).
inline double unit(std::uint32_t word) {
    return shared::unit_float(word);
}

/// An orthonormal frame (s, t, n) around the unit vector n (Duff et al. 2017, "Building an
/// Orthonormal Basis, Revisited"). Theirs jumps where n.z changes its sign, so that rounding
/// decides it for every upright wall; this one jumps at -0.75, where few normals are.
inline dmat3 frame_around(const dvec3& n) {
    const double sign = n.z < -0.75 ? -1 : 1;
    const double a = -1 / (sign + n.z);
    const double b = n.x * n.y * a;
    const dvec3 s(1 + sign * n.x * n.x * a, sign * b, -sign * n.x);
    const dvec3 t(b, sign + n.y * n.y * a, -n.y);
    return {s, t, n};
}

/// The unit vector at the azimuth 2 pi u around n whose polar angle has this sine and cosine.
inline dvec3 direction_around(const dvec3& n, double sine, double cosine, double u) {
    const double phi = 2 * pi * u;
    return glm::normalize(frame_around(n) *
                          dvec3(sine * std::cos(phi), sine * std::sin(phi), cosine));
}

/// Uniform on the unit disc from the unit square (Shirley and Chiu 1997).
inline dvec2 concentric_disk(double u1, double u2) {
    const double x = 2 * u1 - 1;
    const double y = 2 * u2 - 1;
    if (x == 0 && y == 0) return {0, 0};
    const bool x_leads = std::abs(x) > std::abs(y);
    const double r = x_leads ? x : y;
    const double theta = x_leads ? pi / 4 * (y / x) : pi / 2 - pi / 4 * (x / y);
    return {r * std::cos(theta), r * std::sin(theta)};
}

} // namespace tyndall::reference

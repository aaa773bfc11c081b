#include "bench/yardstick.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <thread>
#include <vector>

namespace tyndall::bench {
namespace {

constexpr float kSigmaT = 2.5f, kAlbedo = 0.8f, kG = 0.5f;
constexpr std::uint32_t kSize = 256, kSamples = 64;

struct Vec3 {
    float x, y, z;
};

float uniform(std::uint32_t& state) { // PCG-RXS-M-XS 32
    const std::uint32_t s = state;
    state = state * 747796405u + 2891336453u;
    const std::uint32_t w = ((s >> ((s >> 28u) + 4u)) ^ s) * 277803737u;
    return static_cast<float>(((w >> 22u) ^ w) >> 8) * (1.0f / 16777216.0f);
}

bool intersect_cube(Vec3 o, Vec3 d, float& t_near, float& t_far) {
    const float ix = 1 / d.x, iy = 1 / d.y, iz = 1 / d.z;
    const float ax = (-1 - o.x) * ix, bx = (1 - o.x) * ix, ay = (-1 - o.y) * iy,
                by = (1 - o.y) * iy, az = (-1 - o.z) * iz, bz = (1 - o.z) * iz;
    t_near = std::max({std::min(ax, bx), std::min(ay, by), std::min(az, bz)});
    t_far = std::min({std::max(ax, bx), std::max(ay, by), std::max(az, bz)});
    return t_far > std::max(t_near, 0.0f);
}

Vec3 scatter(Vec3 n, float u, float v) { // Henyey-Greenstein about n
    const float q = (1 - kG * kG) / (1 - kG + 2 * kG * u);
    const float cos_theta = (1 + kG * kG - q * q) / (2 * kG);
    const float sin_theta = std::sqrt(std::max(0.0f, 1 - cos_theta * cos_theta)),
                phi = 6.2831853f * v;
    const float sign = n.z >= 0 ? 1.0f : -1.0f, a = -1 / (sign + n.z), b = n.x * n.y * a;
    const float c = std::cos(phi) * sin_theta, s = std::sin(phi) * sin_theta;
    const Vec3 r{(1 + sign * n.x * n.x * a) * c + b * s + n.x * cos_theta,
                 sign * b * c + (sign + n.y * n.y * a) * s + n.y * cos_theta,
                 -sign * n.x * c - n.y * s + n.z * cos_theta};
    const float l = 1 / std::sqrt(r.x * r.x + r.y * r.y + r.z * r.z);
    return {r.x * l, r.y * l, r.z * l};
}

float path(std::uint32_t pixel, std::uint32_t& state) {
    const float x = (static_cast<float>(pixel % kSize) + uniform(state)) / kSize * 2 - 1;
    const float y = (static_cast<float>(pixel / kSize) + uniform(state)) / kSize * 2 - 1;
    const float l = 1 / std::sqrt(0.1225f * (x * x + y * y) + 1);
    Vec3 o{0, 0, -6}, d{0.35f * x * l, 0.35f * y * l, l};
    float t_near, t_far, weight = 1;
    if (!intersect_cube(o, d, t_near, t_far)) return 1;
    float t = t_near;
    for (;;) {
        o = {o.x + t * d.x, o.y + t * d.y, o.z + t * d.z};
        if (t != t_near) {
            weight *= kAlbedo;
            if (weight < 0.05f) {
                if (uniform(state) < 0.5f) return 0;
                weight *= 2;
            }
            const float u = uniform(state);
            d = scatter(d, u, uniform(state));
        }
        float ignored;
        intersect_cube(o, d, ignored, t_far);
        t = -std::log(1 - uniform(state)) / kSigmaT;
        if (t >= t_far) return weight;
        t_near = -1;
    }
}

} // namespace

YardstickResult run_yardstick(std::uint32_t round) {
    std::vector<float> image(kSize * kSize);
    const auto work = [&](std::uint32_t first) {
        for (std::uint32_t row = first; row < kSize; row += 2)
            for (std::uint32_t pixel = row * kSize; pixel < (row + 1) * kSize; ++pixel) {
                std::uint32_t state = pixel * 9781u + round * 6271u + 1u;
                float sum = 0;
                for (std::uint32_t k = 0; k < kSamples; ++k)
                    sum += path(pixel, state);
                image[pixel] = sum / kSamples;
            }
    };
    std::thread a(work, 0), b(work, 1);
    a.join();
    b.join();
    return {double(kSize) * kSize * kSamples,
            std::accumulate(image.begin(), image.end(), 0.0) / (kSize * kSize)};
}

} // namespace tyndall::bench

/// Rays against spheres and disks, whole and cut, compared with double precision.

#include "shader/rays.h"
#include "spirv/intersect.h"

#include <algorithm>
#include <bit>
#include <numbers>
#include <optional>

namespace tyndall::shader_test {
namespace {

using glm::dvec3;
using glm::vec4;
using std::numbers::pi;

struct QuadricCase {
    RayTexels ray;
    float radius, inner_radius, z_min, z_max;
    float phi_max;
    std::uint32_t flags = 0;
    float unused0 = 0, unused1 = 0;
};

class Quadrics : public GpuTest {
  protected:
    std::vector<HitTexel> run(std::uint32_t function, const std::vector<QuadricCase>& cases,
                              std::uint32_t variant = 0) {
        return kernel_.run<HitTexel>({.function = function, .variant = variant}, cases,
                                     static_cast<std::uint32_t>(cases.size()));
    }
    Kernel kernel_{"intersect", intersect_spirv, 4u << 16, 1u << 16};
};

/// Rays at a sphere of radius r from `distance` radii away, up to its very rim.
std::vector<QuadricCase> rays_at_sphere(double r, double distance, Randomness& random) {
    std::vector<QuadricCase> cases;
    while (cases.size() < 1u << 13) {
        const dvec3 center = random.direction();
        const dvec3 across = glm::normalize(glm::cross(center, random.direction()));
        const dvec3 target = across * r * random.uniform(0, 0.9999);
        const dvec3 origin = center * (r * distance);
        cases.push_back(
            {make_ray(origin, (target - origin) * random.uniform(0.1, 10) / (r * distance)),
             static_cast<float>(r), 0, static_cast<float>(-r), static_cast<float>(r),
             static_cast<float>(2 * pi), shared::QUADRIC_FULL});
    }
    return cases;
}

bool azimuth_within(dvec3 p, double phi_max, bool& is_clear) {
    double phi = std::atan2(p.y, p.x);
    if (phi < 0) phi += 2 * pi;
    if (std::min(std::abs(phi - phi_max), phi) < 1e-3) is_clear = false;
    return phi <= phi_max;
}

struct ExactHit {
    std::optional<double> t;
    bool is_clear = true; ///< Not near any rim.
};

ExactHit exact_cut_sphere(const QuadricCase& c) {
    const dvec3 o = origin_of(c.ray), d = direction_of(c.ray);
    const double a = glm::dot(d, d), b = glm::dot(o, d), r = c.radius;
    const double discriminant = b * b - a * (glm::dot(o, o) - r * r);
    ExactHit hit;
    if (std::abs(discriminant) < 1e-3 * a * r * r) hit.is_clear = false;
    if (discriminant < 0) return hit;
    for (const double sign : {-1.0, 1.0}) {
        const double t = (-b + sign * std::sqrt(discriminant)) / a;
        const dvec3 p = o + t * d;
        if (std::min(std::abs(p.z - c.z_min), std::abs(p.z - c.z_max)) < 1e-4 * r ||
            std::abs(t) < 1e-4)
            hit.is_clear = false;
        if (!(t > 0) || p.z < c.z_min || p.z > c.z_max) continue;
        if (azimuth_within(p, c.phi_max, hit.is_clear)) {
            hit.t = t;
            return hit;
        }
    }
    return hit;
}

ExactHit exact_disk(const QuadricCase& c) {
    const dvec3 o = origin_of(c.ray), d = direction_of(c.ray);
    ExactHit hit;
    const double t = (c.z_min - o.z) / d.z;
    if (!(t > 0)) return hit;
    const dvec3 p = o + t * d;
    const double r = std::hypot(p.x, p.y);
    if (std::min(std::abs(r - c.radius), std::abs(r - c.inner_radius)) < 1e-3) hit.is_clear = false;
    if (r > c.radius || r < c.inner_radius) return hit;
    if (azimuth_within(p, c.phi_max, hit.is_clear)) hit.t = t;
    return hit;
}

std::vector<QuadricCase> rays_at_pieces(Randomness& random) {
    std::vector<QuadricCase> cases;
    while (cases.size() < 1u << 16) {
        const double r = random.uniform(0.5, 2);
        const double z0 = random.uniform(-r, r), z1 = random.uniform(-r, r);
        const dvec3 origin = random.in_cube(4);
        cases.push_back(
            {make_ray(origin, random.in_cube(r) - origin), static_cast<float>(r),
             static_cast<float>(random.below(2) * random.uniform(0, r)),
             static_cast<float>(std::min(z0, z1)), static_cast<float>(std::max(z0, z1)),
             static_cast<float>(random.below(2) ? 2 * pi : random.uniform(0.1, 2 * pi))});
    }
    return cases;
}

void compare(const std::vector<QuadricCase>& cases, const std::vector<HitTexel>& hits,
             ExactHit (*exact_hit)(const QuadricCase&)) {
    int compared = 0, found = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const ExactHit exact = exact_hit(cases[i]);
        if (!exact.is_clear) continue;
        ++compared;
        ASSERT_EQ(hits[i].hit(), exact.t.has_value()) << "case " << i;
        if (!exact.t) continue;
        ++found;
        EXPECT_NEAR(hits[i].t, *exact.t, 1e-4) << "case " << i;
    }
    EXPECT_GT(compared, 50000);
    EXPECT_GT(found, 5000);
}

} // namespace

/// Both ends of the chord lie on the sphere, to the rounding of the coordinates that come in: tiny
/// and huge spheres, near and far.
TEST_F(Quadrics, ChordsEndOnTheSphere) {
    Randomness random(7);
    for (const double r : {1e-4, 1.0, 1e6})
        for (const double distance : {0.5, 1.5, 30.0, 1000.0}) {
            const auto cases = rays_at_sphere(r, distance, random);
            const auto worst = [&](std::uint32_t variant) {
                const auto hits = run(2, cases, variant);
                double most = 0;
                for (std::size_t i = 0; i < cases.size(); ++i) {
                    const dvec3 o = origin_of(cases[i].ray), d = direction_of(cases[i].ray);
                    for (const double t : {double{hits[i].t}, double{hits[i].a}}) {
                        const double off = std::abs(glm::length(o + t * d) - r);
                        most =
                            std::max(most, hits[i].hit() ? off / (glm::length(o) + r) : INFINITY);
                    }
                }
                return most;
            };
            EXPECT_LT(worst(0), 8 * kEpsilon) << r << ' ' << distance;
            if (distance == 1000) {
                EXPECT_GT(worst(1), 80 * kEpsilon) << "no teeth: " << r;
            }
        }
}

TEST_F(Quadrics, RaysBesideASphereMissIt) {
    Randomness random(8);
    std::vector<QuadricCase> cases;
    while (cases.size() < 1u << 13) {
        const dvec3 center = random.direction();
        const dvec3 across = glm::normalize(glm::cross(center, random.direction()));
        const dvec3 origin = center * 10.0;
        // The ray passes at 1.001 to 3 radii.
        cases.push_back({make_ray(origin, across * random.uniform(1.006, 3) - origin), 1, 0, -1, 1,
                         static_cast<float>(2 * pi), shared::QUADRIC_FULL});
    }
    for (const HitTexel& hit : run(2, cases))
        EXPECT_FALSE(hit.hit());
}

TEST_F(Quadrics, CutSpheresAreHitWhereDoublePrecisionSays) {
    Randomness random(9);
    const auto cases = rays_at_pieces(random);
    compare(cases, run(3, cases), exact_cut_sphere);
}

TEST_F(Quadrics, DisksAreHitWhereDoublePrecisionSays) {
    Randomness random(10);
    const auto cases = rays_at_pieces(random);
    compare(cases, run(4, cases), exact_disk);
}

/// A ray within the plane of a disk, and one from that plane, do not hit it.
TEST_F(Quadrics, DisksAreNotHitFromTheirPlane) {
    const auto from = [](dvec3 origin, dvec3 direction) {
        return QuadricCase{make_ray(origin, direction), 1, 0, 0.5f, 0.5f,
                           static_cast<float>(2 * pi)};
    };
    const auto hits = run(4, {from({-2, 0, 0.5}, {1, 0, 0}), from({0, 0, 0.5}, {0, 0, 1}),
                              from({0, 0, 0.5}, {0, 1, 0}), from({0, 0, 0}, {0, 0, 1})});
    EXPECT_FALSE(hits[0].hit());
    EXPECT_FALSE(hits[1].hit());
    EXPECT_FALSE(hits[2].hit());
    EXPECT_TRUE(hits[3].hit());
}

} // namespace tyndall::shader_test

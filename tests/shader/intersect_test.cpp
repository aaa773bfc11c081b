/// Rays against triangles, boxes and patches, compared with double precision.

#include "render/bvh_node.h"
#include "shader/node_box.h"
#include "shader/rays.h"
#include "spirv/intersect.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace tyndall::shader_test {
namespace {

using glm::dvec3;
using glm::vec3;
using glm::vec4;

using Triangle = std::array<dvec3, 3>;

/// A closed mesh about the origin: an icosahedron, each face in 4^levels, its vertices moved in and
/// out at random and put on the grid of multiples of 2^-6.
std::vector<Triangle> make_closed_mesh(int levels, Randomness& random) {
    const double p = (1 + std::sqrt(5)) / 2;
    const std::array<dvec3, 12> v{{{-1, p, 0},
                                   {1, p, 0},
                                   {-1, -p, 0},
                                   {1, -p, 0},
                                   {0, -1, p},
                                   {0, 1, p},
                                   {0, -1, -p},
                                   {0, 1, -p},
                                   {p, 0, -1},
                                   {p, 0, 1},
                                   {-p, 0, -1},
                                   {-p, 0, 1}}};
    const int faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                              {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                              {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                              {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    std::vector<Triangle> mesh;
    for (const auto& f : faces)
        mesh.push_back({v[f[0]], v[f[1]], v[f[2]]});
    for (int level = 0; level < levels; ++level) {
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : mesh) {
            const dvec3 ab = (a + b) / 2.0, bc = (b + c) / 2.0, ca = (c + a) / 2.0;
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh = finer;
    }
    std::map<std::array<long, 3>, dvec3> moved; // each vertex moves once, for all its triangles
    for (Triangle& triangle : mesh)
        for (dvec3& vertex : triangle) {
            const std::array<long, 3> key{std::lround(vertex.x * 1024),
                                          std::lround(vertex.y * 1024),
                                          std::lround(vertex.z * 1024)};
            const double length = random.uniform(3, 4.5);
            const dvec3 at = glm::round(glm::normalize(vertex) * length * 64.0) / 64.0;
            vertex = moved.try_emplace(key, at).first->second;
        }
    return mesh;
}

/// As the renderer packs it (render/primitives.cpp).
shared::PrimitiveRecord pack(const Triangle& t) {
    const vec3 normal(glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0])));
    const double offset = glm::dot(dvec3(normal), (t[0] + t[1] + t[2]) / 3.0);
    return {.a = t[0],
            .kind_and_shape = 0,
            .b = t[1],
            .light = 0,
            .c = t[2],
            .extra = 0,
            .normal = normal,
            .offset = static_cast<float>(offset)};
}

struct MeshHit {
    float t, count, unused0, unused1;
};

/// Rays against a whole mesh.
class MeshKernel {
  public:
    explicit MeshKernel(const std::vector<Triangle>& mesh) {
        for (const Triangle& t : mesh) {
            const shared::PrimitiveRecord record = pack(t);
            const auto* texels = reinterpret_cast<const vec4*>(&record);
            texels_.insert(texels_.end(), texels, texels + shared::PRIMITIVE_TEXELS);
        }
        kernel_.push.primitives = 0;
        kernel_.push.shapes = static_cast<std::uint32_t>(mesh.size());
        kernel_.push.media = static_cast<std::uint32_t>(texels_.size());
    }
    std::vector<MeshHit> trace(const std::vector<RayTexels>& rays, std::uint32_t variant = 0) {
        std::vector<vec4> texels = texels_;
        for (const RayTexels& ray : rays)
            texels.insert(texels.end(), {ray.origin, ray.direction});
        return kernel_.run<MeshHit>({.variant = variant}, texels,
                                    static_cast<std::uint32_t>(rays.size()));
    }

  private:
    std::vector<vec4> texels_;
    Kernel kernel_{"intersect", intersect_spirv, 1u << 19, 1u << 18};
};

/// Distance along the ray, if it hits; not a number if it passes too near an edge to say.
std::optional<double> exact_hit(const Triangle& t, dvec3 o, dvec3 d) {
    const dvec3 a = t[0] - o, b = t[1] - o, c = t[2] - o;
    const double u = glm::dot(glm::cross(b, c), d), v = glm::dot(glm::cross(c, a), d),
                 w = glm::dot(glm::cross(a, b), d);
    const double sum = u + v + w;
    const double least = std::min({u / sum, v / sum, w / sum});
    if (std::abs(least) < 1e-5 || std::abs(sum) < 1e-3) return NAN;
    if (least < 0) return std::nullopt;
    const double distance =
        glm::dot(a, glm::cross(b - a, c - a)) / glm::dot(d, glm::cross(b - a, c - a));
    return distance > 0 ? std::optional(distance) : std::nullopt;
}

/// Where turn() moves a mesh to.
const dvec3 kMoved(10, -20, 5);

/// The mesh in coordinates that have all bits.
std::vector<Triangle> turn(std::vector<Triangle> mesh) {
    const dvec3 x = glm::normalize(dvec3(0.3, -0.8, 0.5)),
                y = glm::normalize(glm::cross(x, dvec3(0.1, 0.2, -0.9)));
    const glm::dmat3 rotation(x, y, glm::cross(x, y));
    for (Triangle& triangle : mesh)
        for (dvec3& vertex : triangle)
            vertex = vec3(rotation * vertex + kMoved);
    return mesh;
}

/// Rays from inside that hit nothing, of those at vertices, at the middles of edges, and anywhere.
template<typename MakeOrigin>
long leaks(const std::vector<Triangle>& mesh, Randomness& random, const MakeOrigin& make_origin,
           std::uint32_t variant) {
    std::vector<RayTexels> rays;
    for (int i = 0; i < 48; ++i) {
        const dvec3 origin = make_origin();
        for (const Triangle& t : mesh)
            for (int k = 0; k < 3; ++k) {
                rays.push_back(make_ray(origin, t[k] - origin));
                rays.push_back(make_ray(origin, (t[k] + t[(k + 1) % 3]) / 2.0 - origin));
            }
    }
    while (rays.size() < 1u << 17)
        rays.push_back(make_ray(make_origin(), random.direction()));
    const auto hits = MeshKernel(mesh).trace(rays, variant);
    return std::count_if(hits.begin(), hits.end(), [](const MeshHit& h) { return h.count == 0; });
}

} // namespace

class Triangles : public GpuTest {};

/// From inside a closed mesh no ray gets out, not even through its edges and vertices, at which
/// these rays are aimed: exactly where all coordinates are multiples of 2^-7, and as closely as
/// rounding allows where the mesh was turned and moved.
TEST_F(Triangles, ClosedMeshesAreWatertight) {
    Randomness random(1);
    const std::vector<Triangle> mesh = make_closed_mesh(2, random);
    EXPECT_EQ(leaks(
                  mesh, random, [&] { return random.grid_point(1); }, 0),
              0);
    const std::vector<Triangle> turned = turn(mesh);
    const auto origin = [&] { return kMoved + random.in_cube(1); };
    EXPECT_EQ(leaks(turned, random, origin, 0), 0);
    EXPECT_GT(leaks(turned, random, origin, 1), 0) << "no teeth: nor does the textbook's test leak";
}

TEST_F(Triangles, NearestHitsAreThoseOfDoublePrecision) {
    Randomness random(2);
    const std::vector<Triangle> mesh = make_closed_mesh(1, random);
    std::vector<RayTexels> rays;
    while (rays.size() < 1u << 14)
        rays.push_back(make_ray(random.in_cube(5), random.direction() * random.uniform(0.1, 10)));
    MeshKernel kernel(mesh);
    const auto hits = kernel.trace(rays);
    int compared = 0, found = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        std::optional<double> nearest;
        bool is_clear = true;
        double slope = 0; // of the ray against the plane that it hits
        int count = 0;
        for (const Triangle& t : mesh) {
            const auto distance = exact_hit(t, origin_of(rays[i]), direction_of(rays[i]));
            if (!distance) continue;
            is_clear = is_clear && !std::isnan(*distance);
            if (*distance < nearest.value_or(INFINITY)) {
                nearest = distance;
                slope = std::abs(glm::dot(dvec3(pack(t).normal), direction_of(rays[i])));
            }
            ++count;
        }
        if (!is_clear) continue;
        ++compared;
        ASSERT_EQ(hits[i].count, count) << "ray " << i;
        if (!nearest) continue;
        ++found;
        // The plane is off by a few ulps of its offset, the ray by as many of its origin: along the
        // ray that is more, the more it grazes.
        const double off = std::abs(hits[i].t - *nearest) * slope;
        EXPECT_LT(off, 4 * kEpsilon * (5 + 2 * glm::length(origin_of(rays[i])))) << "ray " << i;
    }
    EXPECT_GT(compared, 15000);
    EXPECT_GT(found, 3000);
}

/// The distance is that of the plane: vertices 10^5 away cost nothing.
TEST_F(Triangles, FarVerticesDoNotSpoilTheDistance) {
    Randomness random(3);
    const double far = 1e5;
    const std::vector<Triangle> mesh{{dvec3(-far, -far, 1), dvec3(far, -far, 1), dvec3(0, far, 1)}};
    MeshKernel kernel(mesh);
    std::vector<RayTexels> rays;
    while (rays.size() < 1u << 12)
        rays.push_back(make_ray(random.in_cube(0.5), random.in_cube(0.5) + dvec3(0, 0, 1)));
    const auto worst = [&](std::uint32_t variant) {
        const auto hits = kernel.trace(rays, variant);
        double most = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            EXPECT_EQ(hits[i].count, 1);
            const double exact = (1 - origin_of(rays[i]).z) / direction_of(rays[i]).z;
            most = std::max(most, std::abs(hits[i].t / exact - 1));
        }
        return most;
    };
    EXPECT_LT(worst(0), 4 * kEpsilon);
    EXPECT_GT(worst(2), 1000 * kEpsilon) << "no teeth";
}

class Boxes : public GpuTest {};

namespace {

struct BoxCase {
    RayTexels ray;
    vec4 lower, upper; ///< lower.w: the ray ends there; upper.w: which child of the node
    shared::NodeRecord node;
};

struct Span {
    double near, far;
};

constexpr double kSlack = 0x1p-11; ///< More than the error of the device's distances, in steps.

/// Exact slabs, in double, of the case's box or of another; near > far if the ray misses.
Span exact_span(const BoxCase& c, const dvec3& lower, const dvec3& upper) {
    Span span{0, double{c.lower.w}};
    for (int k = 0; k < 3; ++k) {
        const double o = c.ray.origin[k], d = c.ray.direction[k];
        const double a = lower[k] - o, b = upper[k] - o;
        if (d == 0) {
            if (a > 0 || b < 0) return {1, 0};
            continue;
        }
        span.near = std::max(span.near, std::min(a / d, b / d));
        span.far = std::min(span.far, std::max(a / d, b / d));
    }
    return span;
}

Span exact_span(const BoxCase& c) {
    return exact_span(c, dvec3(c.lower), dvec3(c.upper));
}

/// Of the box as the node has it, wider by so many steps.
Span span_in_node(const BoxCase& c, double steps) {
    const NodeBox box = unpack_node(c.node, c.upper.w != 0);
    return exact_span(c, box.lower - steps * box.step, box.upper + steps * box.step);
}

BoxCase make_box(Randomness& random) {
    const auto make = [&] {
        const dvec3 a = random.grid_point(4), b = random.grid_point(4);
        return Bounds{glm::min(a, b), glm::max(a, b)};
    };
    const Bounds box = make(), other = make();
    const bool second = random.below(2) != 0;
    return {{},
            vec4(box.lower, 3.4e38f),
            vec4(box.upper, second),
            second ? pack_node(other, 0, box, 1) : pack_node(box, 0, other, 1)};
}

/// A point of the box: inside, on a face, on an edge or at a corner; all multiples of 2^-6.
dvec3 box_point(const BoxCase& c, Randomness& random) {
    dvec3 p;
    for (int k = 0; k < 3; ++k) {
        const int where = random.below(3);
        const double low = c.lower[k], high = c.upper[k];
        p[k] = where == 0   ? low
               : where == 1 ? high
                            : low + std::floor(random.uniform(0, 1) * (high - low) * 64) / 64;
    }
    return p;
}

} // namespace

/// Every ray goes exactly through a point of its box, most of them on faces, edges or corners, and
/// many run along an axis within a face.
TEST_F(Boxes, AreNeverMissed) {
    Randomness random(4);
    std::vector<BoxCase> cases;
    while (cases.size() < 1u << 17) {
        BoxCase c = make_box(random);
        const dvec3 p = box_point(c, random);
        dvec3 origin = random.grid_point(8) * std::ldexp(1.0, random.below(10));
        for (int k = 0; k < 3; ++k)
            if (random.below(3) == 0) origin[k] = p[k]; // that component of the direction is 0
        if (origin == p) continue;
        c.ray = make_ray(origin, p - origin);
        if (random.below(2)) c.lower.w = 1; // just long enough
        cases.push_back(c);
    }
    Kernel kernel("intersect", intersect_spirv, 1u << 20, 1u << 17);
    const auto misses = [&](std::uint32_t variant) {
        const auto hits = kernel.run<HitTexel>({.function = 1, .variant = variant}, cases,
                                               static_cast<std::uint32_t>(cases.size()));
        for (std::size_t i = 0; variant == 0 && i < hits.size(); ++i) {
            EXPECT_LE(hits[i].t, exact_span(cases[i]).near * (1 + 16 * kEpsilon));
            EXPECT_GE(hits[i].t, span_in_node(cases[i], kSlack).near * (1 - 16 * kEpsilon));
        }
        return std::count_if(hits.begin(), hits.end(), [](const HitTexel& h) { return !h.hit(); });
    };
    EXPECT_EQ(misses(0), 0);
    EXPECT_GT(misses(1), 0) << "no teeth: the textbook's test misses none";
}

TEST_F(Boxes, AreNotHitFromAside) {
    Randomness random(5);
    std::vector<BoxCase> cases;
    std::size_t hits_expected = 0;
    while (cases.size() < 1u << 17) {
        BoxCase c = make_box(random);
        c.ray = make_ray(random.grid_point(8), random.grid_point(2));
        const dvec3 d = direction_of(c.ray);
        if (d == dvec3(0)) continue;
        if (random.below(2)) c.lower.w = static_cast<float>(random.uniform(0.1, 4));
        const Span narrow = span_in_node(c, -kSlack), wide = span_in_node(c, kSlack);
        if (narrow.near <= narrow.far) ++hits_expected;
        if (narrow.near > narrow.far && wide.near < wide.far * (1 + 1e-5))
            continue; // may be taken for a hit
        cases.push_back(c);
    }
    ASSERT_GT(hits_expected, 1000u);
    Kernel kernel("intersect", intersect_spirv, 1u << 20, 1u << 17);
    const auto hits =
        kernel.run<HitTexel>({.function = 1}, cases, static_cast<std::uint32_t>(cases.size()));
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Span span = span_in_node(cases[i], 0);
        ASSERT_EQ(hits[i].hit(), span.near <= span.far) << "case " << i;
    }
}

/// From outside the near face, from inside the far one; nothing gets out of a box.
TEST_F(Boxes, SurfacesAreHitWhereDoublePrecisionSays) {
    Randomness random(11);
    std::vector<BoxCase> cases;
    std::vector<double> distances; // not finite: no hit
    int inside = 0;
    while (cases.size() < 1u << 17) {
        BoxCase c = make_box(random);
        const dvec3 direction = random.grid_point(2);
        c.ray = make_ray(random.grid_point(5), direction);
        const dvec3 o = origin_of(c.ray), lower(c.lower), upper(c.upper);
        bool on_plane = direction == dvec3(0), is_inside = true;
        for (int k = 0; k < 3; ++k) {
            on_plane = on_plane || o[k] == lower[k] || o[k] == upper[k];
            is_inside = is_inside && o[k] > lower[k] && o[k] < upper[k];
        }
        if (on_plane) continue; // either answer will do
        const Span span = exact_span(c);
        const bool is_edge = std::abs(span.near - span.far) < 1e-5 * span.far;
        if (is_edge) continue;
        cases.push_back(c);
        distances.push_back(span.near > span.far ? INFINITY : is_inside ? span.far : span.near);
        inside += is_inside;
    }
    EXPECT_GT(inside, 2000);
    Kernel kernel("intersect", intersect_spirv, 1u << 20, 1u << 17);
    const auto hits =
        kernel.run<HitTexel>({.function = 6}, cases, static_cast<std::uint32_t>(cases.size()));
    for (std::size_t i = 0; i < cases.size(); ++i) {
        ASSERT_EQ(hits[i].hit(), std::isfinite(distances[i])) << "case " << i;
        if (hits[i].hit()) {
            ASSERT_NEAR(hits[i].t / distances[i], 1, 8 * kEpsilon) << "case " << i;
        }
    }
}

class Patches : public GpuTest {};

namespace {

struct PatchCase {
    RayTexels ray;
    vec4 p00, p10, p01, p11;

    dvec3 at(double u, double v) const {
        return glm::mix(glm::mix(dvec3(p00), dvec3(p10), u), glm::mix(dvec3(p01), dvec3(p11), u),
                        v);
    }
    dvec3 along_u(double v) const {
        return glm::mix(dvec3(p10) - dvec3(p00), dvec3(p11) - dvec3(p01), v);
    }
    dvec3 along_v(double u) const {
        return glm::mix(dvec3(p01) - dvec3(p00), dvec3(p11) - dvec3(p10), u);
    }
};

struct PatchHit {
    double t = INFINITY, u = 0, v = 0;
    bool is_clear = true; ///< Neither near an edge nor near grazing.
};

/// In the plane perpendicular to the ray the patch is A + B u + C v + D u v = 0: a quadratic in u.
PatchHit exact_patch(const PatchCase& c) {
    const dvec3 o = origin_of(c.ray), d = direction_of(c.ray);
    const dvec3 s =
        glm::normalize(glm::cross(d, std::abs(d.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    const dvec3 t = glm::cross(glm::normalize(d), s);
    const auto flat = [&](dvec3 p) { return glm::dvec2(glm::dot(p, s), glm::dot(p, t)); };
    const auto cross2 = [](glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; };
    const glm::dvec2 A = flat(c.at(0, 0) - o), B = flat(c.at(1, 0) - c.at(0, 0)),
                     C = flat(c.at(0, 1) - c.at(0, 0)),
                     D = flat(c.at(1, 1) - c.at(1, 0) - c.at(0, 1) + c.at(0, 0));
    // (A + B u) x (C + D u) = 0
    const double q2 = cross2(B, D), q1 = cross2(A, D) + cross2(B, C), q0 = cross2(A, C);
    const double discriminant = q1 * q1 - 4 * q2 * q0;
    PatchHit hit;
    hit.is_clear = std::abs(discriminant) > 1e-3;
    if (discriminant < 0) return hit;
    const double h = -0.5 * (q1 + std::copysign(std::sqrt(discriminant), q1));
    for (const double u : {h / q2, q0 / h}) {
        if (!std::isfinite(u)) continue;
        const glm::dvec2 line = C + D * u;
        const double v = -glm::dot(A + B * u, line) / glm::dot(line, line);
        const double distance = glm::dot(c.at(u, v) - o, d) / glm::dot(d, d);
        const double margin = std::min({u, 1 - u, v, 1 - v});
        if (std::abs(margin) < 1e-3) hit.is_clear = false;
        if (margin > 0 && distance > 0 && distance < hit.t) hit = {distance, u, v, hit.is_clear};
    }
    return hit;
}

} // namespace

TEST_F(Patches, AreHitWhereDoublePrecisionSays) {
    Randomness random(6);
    std::vector<PatchCase> cases;
    while (cases.size() < 1u << 16) {
        PatchCase c{{},
                    vec4(random.in_cube(1), 0),
                    vec4(random.in_cube(1) + dvec3(2, 0, 0), 0),
                    vec4(random.in_cube(1) + dvec3(0, 2, 0), 0),
                    vec4(random.in_cube(1) + dvec3(2, 2, 0), 0)};
        if (random.below(4) == 0) // a parallelogram: the quadratic loses its square
            c.p11 = vec4(vec3(c.p10) + vec3(c.p01) - vec3(c.p00), 0);
        const dvec3 origin = random.in_cube(6);
        const dvec3 target = c.at(random.uniform(-0.3, 1.3), random.uniform(-0.3, 1.3));
        c.ray = make_ray(origin, target - origin);
        cases.push_back(c);
    }
    Kernel kernel("intersect", intersect_spirv, 6u << 16, 1u << 16);
    const auto hits = kernel.run<HitTexel>({.function = 5}, cases, 1u << 16);
    int compared = 0, found = 0;
    double worst_t = 0, worst_uv = 0, worst_swapped = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const PatchHit exact = exact_patch(cases[i]);
        if (!exact.is_clear) continue;
        ++compared;
        ASSERT_EQ(hits[i].hit(), exact.t < INFINITY) << "case " << i;
        if (!hits[i].hit()) continue;
        ++found;
        // What rounding moves across the ray moves the hit by more where the ray grazes the patch.
        const dvec3 normal = glm::cross(cases[i].along_u(exact.v), cases[i].along_v(exact.u));
        const double slope = std::abs(glm::dot(normal, glm::normalize(direction_of(cases[i].ray))));
        worst_t = std::max(worst_t, std::abs(hits[i].t / exact.t - 1) * slope);
        worst_uv = std::max(worst_uv, std::hypot(hits[i].a - exact.u, hits[i].b - exact.v) * slope);
        worst_swapped =
            std::max(worst_swapped, std::hypot(hits[i].b - exact.u, hits[i].a - exact.v));
    }
    EXPECT_GT(compared, 40000);
    EXPECT_GT(found, 15000);
    EXPECT_LT(worst_t, 1e-4);
    EXPECT_LT(worst_uv, 1e-4);
    EXPECT_GT(worst_swapped, 0.1) << "no teeth";
}

} // namespace tyndall::shader_test

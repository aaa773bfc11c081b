/// Hierarchies: the boxes in their nodes, and walks through them.

#include "render/bvh_node.h"
#include "shader/node_box.h"
#include "shader/rays.h"
#include "spirv/hierarchy.h"

#include <cstring>

namespace tyndall::shader_test {
namespace {

/// Flat ones and points among them, of all sizes and at all distances.
Bounds make_bounds(Randomness& random) {
    const double place = std::ldexp(1.0, random.below(120) - 60);
    const double size = place * std::ldexp(1.0, random.below(40) - 30);
    const glm::dvec3 at = random.below(4) ? random.in_cube(place) : glm::dvec3(0);
    glm::dvec3 edges = random.in_cube(size) + size;
    for (int axis = 0; axis < 3; ++axis)
        if (random.below(4) == 0) edges[axis] = 0;
    return round_outward(at, at + edges);
}

struct Margins {
    double least = INFINITY, most = 0; ///< In steps.

    void add(const Bounds& box, const NodeBox& packed) {
        for (int axis = 0; axis < 3; ++axis) {
            const double below = (box.lower[axis] - packed.lower[axis]) / packed.step[axis];
            const double above = (packed.upper[axis] - box.upper[axis]) / packed.step[axis];
            least = std::min({least, below, above});
            most = std::max({most, below, above});
        }
    }
};

} // namespace

TEST(Nodes, ContainTheirChildrenWithAMargin) {
    Randomness random(21);
    Margins margins;
    for (int i = 0; i < 200000; ++i) {
        const Bounds a = make_bounds(random), b = make_bounds(random);
        const shared::NodeRecord node = pack_node(a, 3, b, 5);
        EXPECT_EQ(node.child0, 3u);
        EXPECT_EQ(node.child1, 5u);
        margins.add(a, unpack_node(node, 0));
        margins.add(b, unpack_node(node, 1));
    }
    EXPECT_GE(margins.least, 0x0.ffffp-10); // rounded here
    EXPECT_LT(margins.least, 0x1.01p-10) << "no teeth: no box comes close";
    EXPECT_LE(margins.most, 1 + 0x1p-9);
}

/// Boxes in bytes are of use as long as steps are small.
TEST(Nodes, TakeSmallSteps) {
    Randomness random(22);
    for (int i = 0; i < 200000; ++i) {
        const Bounds a = make_bounds(random), b = make_bounds(random);
        const glm::dvec3 lower = glm::min(a.lower, b.lower), upper = glm::max(a.upper, b.upper);
        const glm::dvec3 step = unpack_node(pack_node(a, 0, b, 0), 0).step;
        for (int axis = 0; axis < 3; ++axis) {
            const double edge = upper[axis] - lower[axis];
            const double least = std::max(0x1p-21 * std::abs(lower[axis]), 0x1p-100);
            ASSERT_LE(step[axis], std::max(edge / 168, least)) << i;
            ASSERT_GE(step[axis], edge / 255) << i;
        }
    }
}

class Hierarchies : public GpuTest {};

namespace {

using Triangle = std::array<glm::vec3, 3>;

/// Triangles behind a hierarchy, and rays.
class WalkKernel {
  public:
    explicit WalkKernel(const std::vector<Triangle>& mesh);
    std::vector<HitTexel> run(const std::vector<RayTexels>& rays, std::uint32_t function);

  private:
    template<typename Record>
    std::uint32_t append(const Record& record) {
        const auto at = static_cast<std::uint32_t>(texels_.size());
        texels_.resize(at + sizeof(Record) / 16);
        std::memcpy(&texels_[at], &record, sizeof(Record));
        return at;
    }

    std::vector<glm::vec4> texels_;
    Kernel kernel_{"hierarchy", hierarchy_spirv, 1u << 17, 1u << 14};
};

WalkKernel::WalkKernel(const std::vector<Triangle>& mesh) {
    std::vector<Bounds> bounds;
    for (const auto& [a, b, c] : mesh)
        bounds.push_back({glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)});
    const Bvh bvh = build_bvh(bounds, 2, 0);
    kernel_.push.triangle_root = bvh.root;
    kernel_.push.nodes = 0;
    for (const shared::NodeRecord& node : bvh.nodes)
        append(node);
    kernel_.push.primitives = static_cast<std::uint32_t>(texels_.size());
    for (std::uint32_t index : bvh.order) {
        const auto& [a, b, c] = mesh[index];
        const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
        append(shared::PrimitiveRecord{
            .a = a, .b = b, .c = c, .normal = normal, .offset = glm::dot(normal, a)});
    }
    kernel_.push.shapes = static_cast<std::uint32_t>(mesh.size());
    kernel_.push.media = static_cast<std::uint32_t>(texels_.size());
}

std::vector<HitTexel> WalkKernel::run(const std::vector<RayTexels>& rays, std::uint32_t function) {
    std::vector<glm::vec4> texels = texels_;
    for (const RayTexels& ray : rays)
        texels.insert(texels.end(), {ray.origin, ray.direction});
    return kernel_.run<HitTexel>({.function = function}, texels,
                                 static_cast<std::uint32_t>(rays.size()));
}

long differences(const std::vector<HitTexel>& a, const std::vector<HitTexel>& b) {
    long count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += a[i].t != b[i].t;
    return count;
}

/// Walks find what looking at all triangles finds, and would not if they did not start anew.
void expect_nearest_hits(const std::vector<Triangle>& mesh, Randomness& random) {
    std::vector<RayTexels> rays;
    while (rays.size() < 1u << 12)
        rays.push_back(make_ray(random.in_cube(1), random.direction()));
    WalkKernel kernel(mesh);
    const auto expected = kernel.run(rays, 1);
    EXPECT_GT(std::count_if(expected.begin(), expected.end(),
                            [](const HitTexel& h) { return std::isfinite(h.t); }),
              500);
    EXPECT_EQ(differences(kernel.run(rays, 0), expected), 0);
    EXPECT_GT(differences(kernel.run(rays, 2), expected), 0) << "no teeth: nothing is forgotten";
}

} // namespace

TEST_F(Hierarchies, FindTheNearestOfScatteredTriangles) {
    Randomness random(23);
    std::vector<Triangle> mesh;
    while (mesh.size() < 3000) {
        const glm::dvec3 at = random.in_cube(1);
        mesh.push_back(
            {at, at + random.in_cube(0.05), at + random.in_cube(random.below(50) ? 0.05 : 1)});
    }
    expect_nearest_hits(mesh, random);
}

/// Every box meets every ray here, or nearly so.
TEST_F(Hierarchies, FindTheNearestOfAStack) {
    Randomness random(24);
    std::vector<Triangle> mesh;
    for (int i = 0; i < 1000; ++i) {
        const float z = 1e-4F * static_cast<float>(i);
        mesh.push_back({{{-9, -9, z}, {9, -9, z}, {9, 9, z}}});
        mesh.push_back({{{-9, -9, z}, {9, 9, z}, {-9, 9, z}}});
    }
    expect_nearest_hits(mesh, random);
}

} // namespace tyndall::shader_test

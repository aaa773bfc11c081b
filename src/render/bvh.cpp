#include "render/bvh.h"

#include "core/error.h"
#include "render/bvh_node.h"

#include <cmath>
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <numeric>

namespace tyndall {
namespace {

using namespace shared;

/// What Embree's callbacks build: a tree of nodes in Embree's own arena.
struct Node {
    Bounds bounds[2];
    Node* children[2]{};                           ///< Inner node; null children mean a leaf.
    const RTCBuildPrimitive* primitives = nullptr; ///< Leaf.
    std::uint32_t count = 0;
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned int, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(Node), alignof(Node))) Node;
}

void set_children(void* node, void** children, unsigned int count, void*) {
    for (unsigned int i = 0; i < count; ++i)
        static_cast<Node*>(node)->children[i] = static_cast<Node*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned int count, void*) {
    for (unsigned int i = 0; i < count; ++i) {
        const RTCBounds& b = *bounds[i];
        static_cast<Node*>(node)->bounds[i] = {{b.lower_x, b.lower_y, b.lower_z},
                                               {b.upper_x, b.upper_y, b.upper_z}};
    }
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                  std::size_t count, void*) {
    void* memory = rtcThreadLocalAlloc(allocator, sizeof(Node) + count * sizeof(RTCBuildPrimitive),
                                       alignof(RTCBuildPrimitive));
    auto* copy =
        reinterpret_cast<RTCBuildPrimitive*>(static_cast<std::byte*>(memory) + sizeof(Node));
    std::copy(primitives, primitives + count, copy);
    auto* leaf = new (memory) Node;
    leaf->primitives = copy;
    leaf->count = static_cast<std::uint32_t>(count);
    return leaf;
}

/// Flattens the subtree, parents first; returns its child word. The device's trail holds
/// BVH_DEPTH_MAX bits (shaders/wavefront/hierarchy.glsl).
std::uint32_t flatten(const Node& node, std::uint32_t depth, Bvh& bvh) {
    if (depth > BVH_DEPTH_MAX)
        throw Error(ExitStatus::failed,
                    fmt::format("a hierarchy is deeper than {}", BVH_DEPTH_MAX));
    if (node.primitives) {
        const auto first = static_cast<std::uint32_t>(bvh.order.size());
        for (std::uint32_t i = 0; i < node.count; ++i)
            bvh.order.push_back(node.primitives[i].primID);
        return LEAF | (node.count - 1) << LEAF_COUNT_SHIFT | first;
    }
    const auto index = static_cast<std::uint32_t>(bvh.nodes.size());
    bvh.nodes.emplace_back();
    const std::uint32_t child0 = flatten(*node.children[0], depth + 1, bvh);
    const std::uint32_t child1 = flatten(*node.children[1], depth + 1, bvh);
    bvh.nodes[index] = pack_node(node.bounds[0], child0, node.bounds[1], child1);
    return index;
}

std::vector<RTCBuildPrimitive> build_primitives(std::span<const Bounds> primitives) {
    std::vector<RTCBuildPrimitive> list;
    list.reserve(primitives.size());
    for (const Bounds& b : primitives)
        list.push_back({b.lower.x, b.lower.y, b.lower.z, 0, b.upper.x, b.upper.y, b.upper.z,
                        static_cast<unsigned int>(list.size())});
    return list;
}

struct DeviceDeleter {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct BvhDeleter {
    void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

} // namespace

Bounds round_outward(const glm::dvec3& lower, const glm::dvec3& upper) {
    Bounds bounds;
    for (int i = 0; i < 3; ++i) {
        bounds.lower[i] = static_cast<float>(lower[i]);
        bounds.upper[i] = static_cast<float>(upper[i]);
        constexpr float infinity = std::numeric_limits<float>::infinity();
        if (bounds.lower[i] > lower[i])
            bounds.lower[i] = std::nextafter(bounds.lower[i], -infinity);
        if (bounds.upper[i] < upper[i]) bounds.upper[i] = std::nextafter(bounds.upper[i], infinity);
    }
    return bounds;
}

Bvh build_bvh(std::span<const Bounds> primitives, std::uint32_t leaf_size,
              std::uint32_t one_leaf_size) {
    Bvh bvh;
    if (primitives.empty()) return bvh;
    if (primitives.size() > LEAF_FIRST_MASK)
        throw Error(ExitStatus::failed,
                    fmt::format("{} primitives in one hierarchy are more than {}",
                                primitives.size(), LEAF_FIRST_MASK));
    bvh.bounds = primitives[0];
    for (const Bounds& b : primitives) {
        bvh.bounds.lower = glm::min(bvh.bounds.lower, b.lower);
        bvh.bounds.upper = glm::max(bvh.bounds.upper, b.upper);
    }
    if (primitives.size() <= one_leaf_size) {
        bvh.order.resize(primitives.size());
        std::iota(bvh.order.begin(), bvh.order.end(), 0u);
        bvh.root = LEAF | (static_cast<std::uint32_t>(primitives.size()) - 1) << LEAF_COUNT_SHIFT;
        return bvh;
    }
    const std::unique_ptr<RTCDeviceTy, DeviceDeleter> device(rtcNewDevice(nullptr));
    if (!device) throw Error(ExitStatus::failed, "cannot start Embree");
    const std::unique_ptr<RTCBVHTy, BvhDeleter> builder(rtcNewBVH(device.get()));
    std::vector<RTCBuildPrimitive> list = build_primitives(primitives);

    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = BVH_DEPTH_MAX;
    arguments.sahBlockSize = 1;
    arguments.minLeafSize = 1;
    arguments.maxLeafSize = leaf_size;
    arguments.bvh = builder.get();
    arguments.primitives = list.data();
    arguments.primitiveCount = list.size();
    arguments.primitiveArrayCapacity = list.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    const auto* root = static_cast<const Node*>(rtcBuildBVH(&arguments));
    if (!root)
        throw Error(ExitStatus::failed,
                    fmt::format("Embree cannot build a hierarchy (error {})",
                                static_cast<int>(rtcGetDeviceError(device.get()))));
    bvh.order.reserve(primitives.size());
    bvh.root = flatten(*root, 0, bvh);
    return bvh;
}

} // namespace tyndall

#include "reference/box_tree.h"

#include "core/error.h"

#include <algorithm>
#include <embree3/rtcore.h>
#include <string>

namespace tyndall::reference {
namespace {

float round_down(double x) {
    const float f = static_cast<float>(x);
    return f > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}

float round_up(double x) {
    const float f = static_cast<float>(x);
    return f < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

/// What the callbacks of one traversal share. Embree hands back the address of the first member.
struct Traversal {
    RTCIntersectContext context;
    BoxTree::Visitor* visitor;
    double t_max;
    double t_start; ///< Where on the ray Embree's ray begins.
};

/// The part of the ray inside a box, from t = 0 on; empty if t0 > t1.
struct Interval {
    double t0, t1;
};

Interval clip(const Ray& ray, const Bounds& box, double t_max) {
    Interval inside{0, t_max};
    for (int i = 0; i < 3; ++i) {
        if (ray.direction[i] == 0) {
            if (ray.origin[i] < box.lower[i] || ray.origin[i] > box.upper[i]) return {1, 0};
            continue;
        }
        double near = (box.lower[i] - ray.origin[i]) / ray.direction[i];
        double far = (box.upper[i] - ray.origin[i]) / ray.direction[i];
        if (near > far) std::swap(near, far);
        inside = {std::max(inside.t0, near), std::min(inside.t1, far)};
    }
    return inside;
}

/// What Embree's builder asks for boxes: relative to the centre, padded, and rounded outward.
struct BoxSource {
    const std::vector<Bounds>& boxes;
    dvec3 center;
    double padding;
};

void bound_item(const RTCBoundsFunctionArguments* arguments) {
    const auto& source = *static_cast<const BoxSource*>(arguments->geometryUserPtr);
    const Bounds& box = source.boxes[arguments->primID];
    const dvec3 lower = box.lower - source.center - source.padding;
    const dvec3 upper = box.upper - source.center + source.padding;
    *arguments->bounds_o = {round_down(lower.x), round_down(lower.y), round_down(lower.z), 0,
                            round_up(upper.x),   round_up(upper.y),   round_up(upper.z),   0};
}

void intersect_item(const RTCIntersectFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0) return;
    auto& traversal = *reinterpret_cast<Traversal*>(arguments->context);
    const double t = traversal.visitor->visit(arguments->primID, traversal.t_max);
    if (t >= traversal.t_max) return;
    traversal.t_max = t;
    RTCRay& ray = reinterpret_cast<RTCRayHit*>(arguments->rayhit)->ray;
    ray.tfar = std::min(ray.tfar, round_up(t - traversal.t_start));
}

} // namespace

/// The boxes relative to their common centre, where single precision is at its best.
struct BoxTree::Embree {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = nullptr;
    dvec3 center{0};
    Bounds padded; ///< Of all boxes.

    ~Embree() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
    void check(const char* what) const {
        const RTCError error = rtcGetDeviceError(device);
        if (error != RTC_ERROR_NONE)
            throw Error(ExitStatus::failed, std::string("Embree cannot ") + what + " (error " +
                                                std::to_string(error) + ")");
    }
};

BoxTree::BoxTree(const std::vector<Bounds>& boxes) {
    for (const Bounds& box : boxes)
        bounds_.extend(box);
    if (boxes.empty()) return;
    embree_ = std::make_unique<Embree>();
    Embree& embree = *embree_;
    embree.check("start");
    embree.center = (bounds_.lower + bounds_.upper) / 2.0;
    const dvec3 half = (bounds_.upper - bounds_.lower) / 2.0;
    // Rounding a ray of this scene to float moves its points by at most 3 * 2^-24 of the extent.
    const double padding = std::max({half.x, half.y, half.z}) * 0x1p-20;
    embree.padded = {bounds_.lower - padding, bounds_.upper + padding};

    BoxSource source{boxes, embree.center, padding};
    embree.scene = rtcNewScene(embree.device);
    rtcSetSceneFlags(embree.scene, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(embree.device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes.size()));
    rtcSetGeometryUserData(geometry, &source); // Read while building only.
    rtcSetGeometryBoundsFunction(geometry, bound_item, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect_item);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree.scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(embree.scene);
    embree.check("build the tree");
}

BoxTree::~BoxTree() = default;
BoxTree::BoxTree(BoxTree&&) noexcept = default;
BoxTree& BoxTree::operator=(BoxTree&&) noexcept = default;

void BoxTree::traverse(const Ray& ray, double t_max, Visitor& visitor) const {
    if (!embree_) return;
    const Interval inside = clip(ray, embree_->padded, t_max);
    if (inside.t0 > inside.t1) return;
    Traversal traversal{{}, &visitor, t_max, inside.t0};
    rtcInitIntersectContext(&traversal.context);
    const dvec3 origin = ray.origin + inside.t0 * ray.direction - embree_->center;
    RTCRayHit query{};
    query.ray.org_x = static_cast<float>(origin.x);
    query.ray.org_y = static_cast<float>(origin.y);
    query.ray.org_z = static_cast<float>(origin.z);
    query.ray.dir_x = static_cast<float>(ray.direction.x);
    query.ray.dir_y = static_cast<float>(ray.direction.y);
    query.ray.dir_z = static_cast<float>(ray.direction.z);
    query.ray.tfar = round_up(inside.t1 - inside.t0);
    query.ray.mask = 0xffffffffu;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree_->scene, &traversal.context, &query);
}

} // namespace tyndall::reference

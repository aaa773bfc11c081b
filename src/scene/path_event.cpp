#include "scene/path_event.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr double kTolerance = 1e-3;

bool are_close(double a, double b, double scale) {
    if (a == b || (!std::isfinite(a) && !std::isfinite(b))) return true;
    return std::abs(a - b) <= kTolerance * scale;
}

bool are_close(const glm::dvec3& a, const glm::dvec3& b, double scale) {
    return are_close(a.x, b.x, scale) && are_close(a.y, b.y, scale) && are_close(a.z, b.z, scale);
}

double largest(const Rgb& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// @param way  of the path so far, with its start's distance from where rounding is finest.
bool are_alike(const PathEvent& a, const PathEvent& b, double way) {
    return a.kind == b.kind && a.event == b.event && a.medium == b.medium &&
           are_close(a.position, b.position, way) && are_close(a.direction, b.direction, 1) &&
           are_close(a.throughput, b.throughput, largest(b.throughput)) &&
           are_close(a.radiance, b.radiance, largest(b.radiance));
}

} // namespace

std::size_t first_difference(const Replay& a, const Replay& b) {
    const std::size_t count = std::min(a.events.size(), b.events.size());
    double way = count > 0 ? glm::length(b.events[0].position - b.camera) : 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) way += glm::length(b.events[i].position - b.events[i - 1].position);
        if (!are_alike(a.events[i], b.events[i], way)) return i;
    }
    return count;
}

bool are_same(const Replay& a, const Replay& b) {
    return a.event_count == b.event_count && a.events.size() == b.events.size() &&
           first_difference(a, b) == a.events.size();
}

} // namespace tyndall

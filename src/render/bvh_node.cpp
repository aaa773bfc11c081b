#include "render/bvh_node.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace tyndall {
namespace {

using namespace shared;

constexpr double kMargin = 1.0 / 1024; ///< In steps.

/// Bits of a float that is at most `upper`, and close to it, and ends in these bits.
std::uint32_t origin_word(double upper, std::uint32_t low_bits) {
    auto value = static_cast<float>(upper);
    if (value > upper) value = std::nextafter(value, -std::numeric_limits<float>::infinity());
    const auto bits = std::bit_cast<std::uint32_t>(value);
    constexpr std::uint32_t unit = (NODE_WIDTH_MASK >> NODE_WIDTH_SHIFT) + 1, sign = 0x80000000u;
    const std::uint32_t word = (bits & ~(unit - 1)) | low_bits;
    if (bits & sign) return word < bits ? word + unit : word;
    if (word <= bits) return word;
    return word >= unit ? word - unit : sign | low_bits; // below 0, all but 0
}

struct Interval {
    double lower, upper;
};

struct PackedAxis {
    std::uint32_t origin, bytes;
};

/// Two intervals in such steps, if a byte holds them.
std::optional<PackedAxis> pack_axis(const std::array<Interval, 2>& boxes,
                                    std::uint32_t width_bits) {
    const double step = std::bit_cast<float>(width_bits << NODE_WIDTH_SHIFT) / 256;
    const double lower = std::min(boxes[0].lower, boxes[1].lower) - 2 * kMargin * step;
    PackedAxis axis{origin_word(lower, width_bits), 0};
    const double origin = std::bit_cast<float>(axis.origin);
    for (int child = 0; child < 2; ++child) {
        const double from = std::floor((boxes[child].lower - origin) / step - kMargin);
        const double to = std::ceil((boxes[child].upper - origin) / step + kMargin);
        if (from < 0 || to > 255) return std::nullopt;
        axis.bytes |= (static_cast<std::uint32_t>(from) | static_cast<std::uint32_t>(to) << 8)
                      << (16 * child);
    }
    return axis;
}

/// Likewise in the smallest steps.
PackedAxis pack_axis(const std::array<Interval, 2>& boxes) {
    const double edge =
        std::max(boxes[0].upper, boxes[1].upper) - std::min(boxes[0].lower, boxes[1].lower);
    const auto least = static_cast<float>(std::max(edge, std::ldexp(1.0, -93)));
    std::uint32_t width = std::bit_cast<std::uint32_t>(least) >> NODE_WIDTH_SHIFT;
    while (true) {
        if (const auto axis = pack_axis(boxes, width)) return *axis;
        ++width;
    }
}

} // namespace

NodeRecord pack_node(const Bounds& box0, std::uint32_t child0, const Bounds& box1,
                     std::uint32_t child1) {
    const auto pack = [&](int axis) {
        return pack_axis(
            {{{box0.lower[axis], box0.upper[axis]}, {box1.lower[axis], box1.upper[axis]}}});
    };
    const PackedAxis x = pack(0), y = pack(1), z = pack(2);
    return {.child0 = child0,
            .child1 = child1,
            .origin_x = x.origin,
            .origin_y = y.origin,
            .origin_z = z.origin,
            .box_x = x.bytes,
            .box_y = y.bytes,
            .box_z = z.bytes};
}

} // namespace tyndall

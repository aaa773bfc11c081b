#include "render/health_counts.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tyndall {
namespace {

std::uint64_t lost_throughput(const shared::Control& control) {
    return std::uint64_t{control.lost_throughput_high} << 32 | control.lost_throughput_low;
}

} // namespace

void HealthCounts::take_in(const shared::Control& control) {
    for (int kind = 0; kind < shared::HEALTH_COUNT; ++kind) {
        shared::Mishap& mishap = health_.kinds[static_cast<std::size_t>(kind)];
        const std::uint32_t grown = control.health[kind] - seen_.health[kind]; // modulo 2^32
        if (mishap.count == 0 && grown > 0) {
            mishap.x = control.health_pixel[kind] & 0xFFFF;
            mishap.y = control.health_pixel[kind] >> 16;
            mishap.sample = control.health_sample[kind];
        }
        mishap.count += grown;
    }
    const double ratio = std::bit_cast<float>(control.worst_majorant_ratio);
    health_.worst_majorant_ratio = std::max(health_.worst_majorant_ratio, ratio);
    const std::uint64_t lost = lost_throughput(control) - lost_throughput(seen_);
    health_.lost_throughput += std::ldexp(static_cast<double>(lost), -16);
    seen_ = control;
}

} // namespace tyndall

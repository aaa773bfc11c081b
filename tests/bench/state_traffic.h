/// What a stage moves of the state of a path.
#pragma once

#include <cstdint>
#include <span>

namespace tyndall::bench {

struct StateTraffic {
    std::uint32_t read = 0, written = 0; ///< Bytes a visit.
};

/// Read off the module: all loads of the state as texels and stores of it as storage (slots.glsl),
/// on any way through, those of loops once. A visit that ends early moves less.
/// @param spirv  specialized.
StateTraffic state_traffic(std::span<const std::uint32_t> spirv);

} // namespace tyndall::bench

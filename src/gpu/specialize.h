/// Specialization of shaders on the host, before a driver sees them.
#pragma once

#include "shared/features.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tyndall::gpu {

/// The module with its specialization constants fixed to the features, without the branches and
/// functions that they rule out. No arithmetic is touched: results stay the same to the last bit.
///
/// Drivers would do so as well, but not all of them first: SwiftShader looks for
/// paths through the branches of every loop while those that a constant decides still stand there,
/// in a time that doubles with each. The stage for whole paths took more than 8 minutes, and
/// takes 0.3 s so.
///
/// @param name  for the message of the error.
/// @throws Error if the module is damaged.
std::vector<std::uint32_t> specialize(std::span<const std::uint32_t> spirv,
                                      const shared::Features& features, const std::string& name);

/// Instructions between the beginning and the end of functions.
std::size_t count_instructions(std::span<const std::uint32_t> spirv);

} // namespace tyndall::gpu

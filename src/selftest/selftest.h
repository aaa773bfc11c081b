/// The short form of the tests of numerical stability, on the user's own device.
#pragma once

#include "gpu/context.h"
#include "selftest/row.h"

#include <functional>
#include <vector>

namespace tyndall::selftest {

/// Called with each row as it comes; false ends the selftest.
using OnRow = std::function<bool(const Row&)>;

/// Functions of the shaders' library, scenes with known radiance, and at last the health counters
/// of all those renders.
///
/// A statistical row allows 4.5 standard errors: 7 in a million of right devices fail one.
/// @param corrupt  the control: makes what the device gives wrong by this fraction.
/// @throws Error   if the device fails.
std::vector<Row> run(const gpu::Context& context, double corrupt, const OnRow& on_row);

} // namespace tyndall::selftest

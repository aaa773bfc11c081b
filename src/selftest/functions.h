/// Functions of shaders/lib where the textbook's forms fail, against double precision.
#pragma once

#include "gpu/context.h"
#include "selftest/row.h"

#include <vector>

namespace tyndall::selftest {

/// A row for each function: its greatest error over arguments that matter, relative unless the name
/// says otherwise. What is allowed are a few roundings of float32, and twice as much where a driver
/// may be coarse (exp).
/// @param corrupt  the control: by how much the device's values are made wrong, relative.
std::vector<Row> check_functions(const gpu::Context& context, double corrupt);

} // namespace tyndall::selftest

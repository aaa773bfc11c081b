/// The table of hard scenes with known radiance.
#pragma once

#include "selftest/cases.h"

#include <vector>

namespace tyndall::stability {

/// Those of the selftest, and more: one row each. A name is letters, digits and underscores.
const std::vector<selftest::Case>& rows();

} // namespace tyndall::stability

/// The picture by scattering order (--aov orders).
#pragma once

#include "cli/options.h"
#include "image/image.h"

#include <functional>
#include <optional>

namespace tyndall::cli {

/// Orders that have a layer of their own: 0 ... kOrders - 1. What scatters more often is one more.
constexpr int kOrders = 4;

/// The picture with more channels: order0.R to order3.B, light that came after so many scattering
/// events of surfaces or media (0: emission and what nothing scattered), and order4+.R to
/// order4+.B, the rest. They sum to R G B.
///
/// No random number depends on how often a path may scatter, so renders with fewer events trace the
/// same paths up to there: a layer is the difference of two of them, exact but for rounding. That
/// costs four more renders, of short paths, and nothing where it is not asked for.
///
/// @param film            The picture of the samples 0 ... samples - 1; R G B first.
/// @param is_interrupted  Asked now and then.
/// @return                None if it was interrupted.
/// @throws Error          as a render, and if the validation layer has messages.
std::optional<Image> with_orders(const Image& film, const Scene& scene,
                                 const DeviceOptions& options, std::uint32_t samples,
                                 const std::function<bool()>& is_interrupted);

} // namespace tyndall::cli

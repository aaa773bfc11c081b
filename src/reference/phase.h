/// Phase functions. Directions are those of travel; a cosine of 1 is no deflection.
#pragma once

#include "reference/sampling.h"
#include "scene/scene.h"

namespace tyndall::reference {

/// A scattering angle by its cosine, sine, and 1 - cosine, each to full relative precision.
struct ScatteringAngle {
    double cosine;
    double sine;
    double one_minus_cosine;
};

/// Whether the angle is fixed (|g| within 1e-6 of 1): such a function has no density.
bool is_delta(const PhaseFunction& phase);

/// Inverts the CDF of the cosine; xi in [0, 1], 0 is straight back. Henyey-Greenstein in the form
/// of products, which neither cancels nor divides by g.
ScatteringAngle sample_angle(const PhaseFunction& phase, double xi);

/// Density per solid angle, for one_minus_cosine in [0, 2]. Not for a delta.
double evaluate_phase(const PhaseFunction& phase, double one_minus_cosine);

/// 1 - cos of the angle between unit vectors, without cancellation.
double one_minus_cosine(const dvec3& a, const dvec3& b);

} // namespace tyndall::reference

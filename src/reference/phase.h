/// Phase functions and mixtures of them. Directions are those of travel; a cosine of 1 is no
/// deflection.
#pragma once

#include "reference/sampling.h"
#include "scene/scene.h"

#include <vector>

namespace tyndall::reference {

/// A scattering angle by its cosine, sine, and 1 - cosine, each to full relative precision.
struct ScatteringAngle {
    double cosine;
    double sine;
    double one_minus_cosine;
};

/// Whether the angle is fixed (|g| or |k| within 1e-6 of 1): such a function has no density. In
/// mixtures it does not occur.
bool is_delta(const PhaseFunction& phase);
bool is_delta(const std::vector<PhaseFunction>& mixture);

/// Channels differ in some phase function.
bool is_chromatic(const std::vector<PhaseFunction>& mixture);

/// Inverts the CDF of the cosine; xi in [0, 1], 0 is straight back. Henyey-Greenstein and Schlick
/// in the form of products, which neither cancels nor divides by g; Rayleigh by Cardano's formula;
/// tables by that of the hero, whose density is linear between nodes.
ScatteringAngle sample_angle(const PhaseFunction& phase, double xi, int hero = 0);

/// The same number chooses the component and then, stretched, its angle.
ScatteringAngle sample_angle(const std::vector<PhaseFunction>& mixture, double xi, int hero);

/// Density per solid angle by channel, for one_minus_cosine in [0, 2]. Not for a delta.
Rgb evaluate_phase(const PhaseFunction& phase, double one_minus_cosine);
Rgb evaluate_phase(const std::vector<PhaseFunction>& mixture, double one_minus_cosine);

/// Mean cosine by channel, in closed form or that of the table.
Rgb mean_cosine(const PhaseFunction& phase);
Rgb mean_cosine(const std::vector<PhaseFunction>& mixture);

/// 1 - cos of the angle between unit vectors, without cancellation.
double one_minus_cosine(const dvec3& a, const dvec3& b);

} // namespace tyndall::reference

/// The isotropic GGX distribution of microfacets (Walter et al. 2007, "Microfacet Models for
/// Refraction through Rough Surfaces").
///
/// Directions are unit vectors in the frame of the surface, away from it; z is the normal.
#pragma once

#include "reference/sampling.h"

namespace tyndall::reference {

struct Ggx {
    double alpha; ///< Roughness, > 0.

    /// Facets by the solid angle of their normal m and the area of the surface (equation 33).
    double density(const dvec3& m) const;
    /// Smith's Lambda: 1 / (1 + Lambda) of the facets that face w are not masked.
    double lambda(const dvec3& w) const;
    /// Share of the facets that are seen from wo which wi sees, too, on whatever sides the two are:
    /// G(wo, wi) / G1(wo), height-correlated (Heitz 2014, "Understanding the Masking-Shadowing
    /// Function", equation 99).
    double visible_share(const dvec3& wo, const dvec3& wi) const;
    /// Density of sample_visible per solid angle, for m.z > 0 and dot(wo, m) > 0.
    double visible_density(const dvec3& wo, const dvec3& m) const;
    /// A facet as seen from wo, wo.z > 0 (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals
    /// with Spherical Caps").
    dvec3 sample_visible(const dvec3& wo, double u1, double u2) const;
};

} // namespace tyndall::reference

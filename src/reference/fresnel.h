/// Reflection and refraction of unpolarised light at smooth boundaries (Born and Wolf, Principles
/// of Optics, 1.5.2 and 14.2).
///
/// Cosines are of incidence, in (0, 1]. `eta` of dielectrics is the index beyond the boundary over
/// that of the side that the light comes from.
#pragma once

#include "reference/sampling.h"
#include "scene/scene.h"

namespace tyndall::reference {

/// Share of the light that is reflected; 1 from the critical angle on.
double fresnel_dielectric(double eta, double cosine);

/// Of a thin pane, both of whose faces reflect R: R + T^2 R / (1 - R^2) = 2 R / (1 + R).
double fresnel_pane(double eta, double cosine);

/// Of metal with the index eta + i k, by channel.
Rgb fresnel_conductor(const Rgb& eta, const Rgb& k, double cosine);

/// Directions point away from the boundary; both normals are on the side of w.
dvec3 reflect(const dvec3& w, const dvec3& normal);
/// Snell's law; not beyond the critical angle.
dvec3 refract(double eta, const dvec3& w, const dvec3& normal);

} // namespace tyndall::reference

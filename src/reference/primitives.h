/// Intersections of a ray with single primitives, in double precision, each in its own space.
#pragma once

#include "reference/surface.h"

#include <array>

namespace tyndall::reference {

/// Watertight: a ray never slips through an edge that two triangles share (Woop et al. 2013,
/// "Watertight Ray/Triangle Intersection"). Parameters: weights of p[1] and p[2].
std::optional<PrimitiveHit> intersect_triangle(const std::array<dvec3, 3>& p, const Ray& ray,
                                               double t_max);

/// Bilinear patch with corners p00, p10, p01, p11 (Reshetov 2019, "Cool Patches", polished by
/// Newton's method). Parameters: (u, v).
std::optional<PrimitiveHit> intersect_patch(const std::array<dvec3, 4>& p, const Ray& ray,
                                            double t_max);

/// In object space. Parameters: the point, exactly at the radius.
std::optional<PrimitiveHit> intersect_sphere(const Sphere& sphere, const Ray& ray, double t_max);

/// In object space. Parameters: the point, exactly at the height.
std::optional<PrimitiveHit> intersect_disk(const Disk& disk, const Ray& ray, double t_max);

} // namespace tyndall::reference

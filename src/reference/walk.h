/// The estimator: one path from the camera, with light sampling at every scattering event.
#pragma once

#include "reference/geometry.h"
#include "reference/lights.h"
#include "reference/medium.h"

namespace tyndall::reference {

/// Traces paths through one scene. It holds references; what they refer to must outlive it.
class PathTracer {
  public:
    PathTracer(const Scene& scene, const Geometry& geometry, const Lights& lights);

    /// An unbiased estimate of the radiance that comes in along the ray, from the random numbers of
    /// the events 1, 2, ... (and the hero channel of event 0).
    Rgb radiance(const Ray& camera_ray, const RandomPath& random) const;

  private:
    class Walk;
    /// A place in a medium, on the way in a direction.
    struct Start {
        Ray ray;
        int medium;
    };

    const Medium* medium(int index) const;
    /// What a light gives through all interfaces on the way; 0 behind any other surface.
    Rgb visibility(Start start, const LightSample& light) const;
    /// The start of a ray that leaves a surface in a direction.
    Start leave_surface(const SurfaceHit& hit, const dvec3& direction, int medium_before) const;

    const Scene& scene_;
    const Geometry& geometry_;
    const Lights& lights_;
    bool has_media_;
    bool is_grey_;
};

} // namespace tyndall::reference

/// The estimator: one path from the camera, with light sampling at every scattering event.
#pragma once

#include "reference/geometry.h"
#include "reference/lights.h"
#include "reference/march.h"
#include "reference/medium.h"
#include "reference/path_report.h"
#include "reference/placed_medium.h"
#include "scene/lit_ball.h"

namespace tyndall::reference {

/// Traces paths through one scene. It holds references; what they refer to must outlive it.
class PathTracer {
  public:
    PathTracer(const Scene& scene, const Geometry& geometry, const Lights& lights);

    /// An unbiased estimate of the radiance that comes in along the ray, from the random numbers of
    /// the events 1, 2, ... (and the hero channel of event 0).
    Rgb radiance(const Ray& camera_ray, const RandomPath& random, PathReport& report) const;

  private:
    class Walk;
    /// The medium at a place.
    struct Surroundings {
        int medium;             ///< Index into Scene::media, or -1.
        const Placement* space; ///< Of what the medium's shape belongs to.

        bool operator==(const Surroundings& o) const {
            return medium == o.medium && (medium < 0 || space == o.space);
        }
    };
    /// A place in a medium, on the way in a direction.
    struct Start {
        Ray ray;
        Surroundings in;
    };

    /// The ray in the medium that it starts in; none in a vacuum.
    std::optional<MediumLine> medium_line(const Start& start) const;
    /// The surface that the ray meets before t_max: of those that touch where it is a boundary, the
    /// one that decides (shaders/wavefront/contact.glsl).
    std::optional<SurfaceHit> intersect(const Start& start, double t_max) const;
    bool is_boundary(const SurfaceHit& hit) const;
    /// Of two boundaries in one place, whether the ray crosses `a` before `b`.
    static bool is_crossed_first(const SurfaceHit& a, const SurfaceHit& b, const Start& start);
    /// What a light gives through all interfaces on the way; 0 behind any other surface.
    Rgb visibility(Start start, const LightSample& light, const RandomPath& random,
                   std::uint32_t event, PathReport& report) const;
    /// Relative to a place in the ball around all surfaces and lights, at most 1.
    double reach_of_light(const dvec3& place, const Medium& medium) const;
    /// The world, from render space.
    dvec3 world_point(const dvec3& p) const { return geometry_.world_space().inverse_point(p); }
    /// That a ray starts in; -1 where media are ignored.
    int medium_index(const Start& start) const { return media_.empty() ? -1 : start.in.medium; }
    /// What is on the side of a surface that a direction goes to.
    static Surroundings beyond(const SurfaceHit& hit, const dvec3& direction,
                               const Surroundings& before);
    /// The start of a ray that leaves a surface in a direction.
    static Start leave_surface(const SurfaceHit& hit, const dvec3& direction,
                               const Surroundings& before);

    Integrator::Placement placement() const { return scene_.integrator.placement; }

    const Scene& scene_;
    const Geometry& geometry_;
    const Lights& lights_;
    std::vector<PlacedMedium> media_; ///< Empty if media are ignored.
    bool samples_lights_;
    bool marches_; ///< And does not scatter in media more than once.
    bool is_analog_;
    bool marches_shadows_;
    bool has_contacts_;
    MarchSteps steps_;
    bool is_grey_;
    std::optional<Ball> lit_ball_; ///< In render space.
};

} // namespace tyndall::reference

/// What surfaces do with light (pbrt-v4, chapter 9).
///
/// Directions are unit vectors in the frame of the shading normal, away from the surface; the z
/// axis is on the side that the path comes from: wo.z > 0.
#pragma once

#include "reference/sampling.h"
#include "scene/scene.h"

#include <optional>

namespace tyndall::reference {

/// What an event does with light from one direction.
struct Response {
    Rgb value{0};       ///< Phase function, or BSDF times cosine.
    double density = 0; ///< With which the event itself draws that direction, per solid angle.
};

/// A direction that an event has drawn.
struct Scattering {
    dvec3 direction;
    Rgb weight;                    ///< Value over density.
    std::optional<double> density; ///< None for mirrors and windows, which leave no choice.
};

/// The uniform numbers that a surface draws a direction with.
struct SurfaceNumbers {
    double u1, u2; ///< Direction or microfacet.
    double lobe;   ///< Reflection or transmission.
};

/// Whether channels are refracted differently: a path has to choose one.
bool is_dispersive(const Material& material);

class Bsdf {
  public:
    /// @param from_outside  The path comes from the side of the shading normal.
    /// @param channel       Whose index of refraction counts for dielectrics.
    /// Keeps a reference to the material, which is not an interface.
    Bsdf(const Material& material, bool from_outside, int channel);

    /// Mirrors and windows: no light can be sampled.
    bool is_delta() const;
    /// Not for a delta.
    Response respond(const dvec3& wo, const dvec3& wi) const;
    /// None if a rough surface sends the path to where it cannot go.
    std::optional<Scattering> sample(const dvec3& wo, const SurfaceNumbers& numbers) const;

  private:
    /// Of wi and wo that the facet m makes of each other; value over density is Scattering::weight.
    Response respond_facet(const dvec3& wo, const dvec3& wi, const dvec3& m) const;
    Scattering sample_diffuse(const SurfaceNumbers& numbers) const;

    const Material& material_;
    double eta_; ///< Beyond the surface over before it.
};

} // namespace tyndall::reference

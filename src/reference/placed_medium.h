/// Media in the space in which their density is given.
#pragma once

#include "reference/exponential.h"
#include "reference/surface.h"

namespace tyndall::reference {

/// A medium with its placement. Coefficients are per unit of the world, whatever the transforms (as
/// in pbrt, which carries rays to a medium without normalising them): a medium that is scaled is
/// stretched, not thinned.
struct PlacedMedium {
    explicit PlacedMedium(const Medium& medium); ///< Keeps a reference.

    const Medium& medium;
    /// To the space of the definition that the medium's shape belongs to, or the world: from index
    /// space for grids, else from medium space.
    Placement outer_from_local;
};

/// A ray in a medium. Distances are those of the world.
struct MediumLine {
    /// @param space  Of what the medium's shape belongs to (SurfaceHit::space).
    MediumLine(const PlacedMedium& placed, const Placement& space, const Ray& ray);

    /// Flights are sampled by tracking (reference/tracking.h), not in closed form.
    bool is_tracked() const;
    /// Length of medium of density 1 that has the optical depth of [0, t]. Not for tracked media.
    double column(double t) const;
    /// The distance at which it is `length`; infinite if it never is. Not for tracked media.
    double distance(double length) const;

    const Medium& medium;
    Ray local; ///< In the space in which the density is given; the direction is not of unit length.

  private:
    ExponentialLine exponential(const ExponentialDensity& density) const;
};

} // namespace tyndall::reference

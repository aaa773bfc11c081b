/// Density exp(-height / scale_height) above a plane, along a line: closed forms.
#pragma once

namespace tyndall::reference {

/// A line whose height is `start` + `rise` t.
struct ExponentialLine {
    double start;
    double rise; ///< Any sign; 0 is parallel to the plane.
    double scale_height;

    /// Integral of the density over [0, t]; both may be infinite.
    double column(double t) const;
    /// The distance at which the column is reached; infinite if it never is.
    double distance(double column) const;
};

} // namespace tyndall::reference

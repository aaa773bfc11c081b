/// Marching through media: sums over steps along a line. Biased by the size of the steps.
#pragma once

#include "reference/placed_medium.h"

#include <functional>
#include <utility>

namespace tyndall::reference {

/// How many steps a march has.
struct MarchSteps {
    int count;   ///< For any length, > 0 ...
    double size; ///< ... or, if > 0, the length of a step at most.

    int over(double length) const;
};

/// The part of [0, t_end] of a line in which there is any of the medium. What has no end is cut
/// where e^-20 of the light or of the density is left. Empty (first >= second) if there is none.
std::pair<double, double> march_range(const MediumLine& line, double t_end);

/// The part of a range in steps: of equal length, or of equal angle at a point beside the line
/// (Kulla and Fajardo 2012, "Importance Sampling Techniques for Path Tracing in Participating
/// Media").
class Steps {
  public:
    Steps(double begin, double end, int count);
    /// @param nearest, offset  Where on the line the point is nearest, and how far it is away. Less
    ///                         than 1e-3 of the length counts as that.
    Steps(double begin, double end, int count, double nearest, double offset);

    int count() const { return count_; }
    /// Where x steps end.
    double place(double x) const;
    /// The length that a sample at t stands for.
    double weight(double t) const;

  private:
    double begin_, end_;
    int count_;
    double nearest_ = 0, offset_ = 0; ///< 0: equal length.
    double angle0_ = 0, angle1_ = 0;
};

/// What the medium is like at a place.
struct Matter {
    Rgb sigma_a{0}, sigma_s{0};
    Rgb source{0}; ///< sigma_a Le, times a weight.
};

/// MIS weight of emission sigma_a Le of a voxel with extinction sigma_t.
using EmissionWeight = std::function<double(const Rgb& emission, const Rgb& extinction)>;

/// At distance t, trilinear between voxels, of which each has a weight of its emission.
Matter matter_at(const MediumLine& line, double t, const EmissionWeight& weight);

/// exp(-sum of sigma_t dt) over [0, t_end], taken at the middles of steps.
Rgb march_transmittance(const MediumLine& line, double t_end, const MarchSteps& steps);

} // namespace tyndall::reference

/// Delta tracking through media whose density varies, against local majorants (Woodcock et al.
/// 1965; Novak et al. 2018, "Monte Carlo Methods for Volumetric Light Transport Simulation",
/// sections 4 and 5).
///
/// A flight against a majorant mu >= sigma_t ends in a tentative collision. There the medium
/// absorbs and emits with the share sigma_a / mu, scatters with the share sigma_s / mu, and does
/// nothing with what is left. The majorant is that of the channel with the greatest sigma_t, so
/// that the places of collisions are the same for all channels.
#pragma once

#include "reference/placed_medium.h"

#include <variant>

namespace tyndall::reference {

struct TentativeCollision {
    double t;      ///< Distance along the ray.
    Rgb absorbed;  ///< sigma_a / majorant
    Rgb scattered; ///< sigma_s / majorant
    Rgb emission;  ///< Le
};

/// Cells of the majorant grid along a line (Amanatides and Woo 1987), cut to the box of the medium.
class GridFlight {
  public:
    GridFlight(const GridDensity& grid, const Medium& medium, const Ray& local, double t_end);
    /// Goes on until the optical distance tau of the majorants is used up, and returns the majorant
    /// there; 0 if the line ends before.
    double advance(double tau);
    /// At the present place, by one stochastic trilinear tap.
    TentativeCollision collision(double majorant, double u) const;

  private:
    double cell_exit(int axis) const;

    const GridDensity& grid_;
    const Medium& medium_;
    Ray ray_; ///< In index space.
    double t_ = 0, t_end_;
    glm::ivec3 cell_{0};
    double sigma_max_; ///< Extinction per unit of the bounds.
};

/// Steps through a spherical atmosphere over which the density hardly changes.
class AtmosphereFlight {
  public:
    AtmosphereFlight(const ExponentialDensity& density, const Medium& medium, const Ray& local,
                     double t_end);
    double advance(double tau);
    TentativeCollision collision(double majorant, double u) const;

  private:
    /// Height of the point at distance t over the scale height, not below 0.
    double relative_height(double t) const;

    const ExponentialDensity& density_;
    const Medium& medium_;
    Ray ray_; ///< Relative to the centre of the sphere.
    double t_ = 0, t_end_;
    double speed_, t_nearest_;
    double sigma_max_;
};

/// The part of a line within a box, cut to [0, t_end]; empty (first >= second) if there is none.
std::pair<double, double> clip_to_box(const Ray& ray, const dvec3& lower, const dvec3& upper,
                                      double t_end);

/// The tentative collisions along a line, one after the other.
class Flight {
  public:
    /// The line ends at t_end, which may be infinite.
    Flight(const MediumLine& line, double t_end);

    /// The next one.
    /// @param tau  Exponentially distributed.
    /// @param u    In [0, 1): chooses the voxel of the tap.
    /// @return     None if the line ends before; what is left of tau is lost.
    std::optional<TentativeCollision> next(double tau, double u);

  private:
    std::variant<GridFlight, AtmosphereFlight> flight_;
};

/// What roulette makes of a transmittance, by a uniform number: its expectation is the same.
Rgb play_shadow_roulette(const Rgb& transmittance, double u);

/// Along the whole line, by ratio tracking. draw() gives (tau, u, chance) for each flight, the last
/// one that leaves the medium included; see() is told of the extinction over its majorant at each
/// collision.
template<class Draw, class See>
Rgb track_transmittance(const MediumLine& line, double t_end, Draw&& draw, See&& see) {
    Flight flight(line, t_end);
    Rgb result(1);
    while (result != Rgb(0)) {
        const auto [tau, u, chance] = draw();
        const std::optional<TentativeCollision> at = flight.next(tau, u);
        if (!at) break;
        see(at->absorbed + at->scattered);
        result *= glm::max(1.0 - (at->absorbed + at->scattered), 0.0); // rounding: beyond 1
        result = play_shadow_roulette(result, chance);
    }
    return result;
}

/// The voxel that a stochastic trilinear tap at a point of index space reads: each of the eight
/// around it with its trilinear weight. One number is enough: what is left of it after the choice
/// along an axis is uniform again.
glm::ivec3 choose_corner(const dvec3& index, double u);

} // namespace tyndall::reference

/// Free flights, and what a segment of a path does to its throughput.
///
/// Lengths are those of medium of density 1 (MediumLine::column); in homogeneous media, distances.
/// Flights are drawn from the scattering coefficient of one channel, the hero; absorption is a
/// weight in closed form. The choice of the hero is averaged over by the balance heuristic (Wilkie
/// et al. 2014, "Hero Wavelength Spectral Sampling"), kept normalised so that nothing underflows.
#pragma once

#include "reference/sampling.h"
#include "scene/scene.h"

namespace tyndall::reference {

struct Throughput {
    Rgb beta{
        1}; ///< Contribution of the path so far, over its probability averaged over the heroes.
    Rgb ratio{1}; ///< Probability of the path for each hero, over that average; mean 1.
    int hero = 0;
};

/// The medium has coefficients of its own for each voxel and channel (rgbgrid).
bool has_channel_grids(const Medium& medium);

/// Channels are alike in sigma_a, sigma_s and phase function: the hero does not matter.
bool is_grey(const Medium& medium);
bool is_scattering(const Medium& medium);

/// 0, 1 or 2 with equal probability, from u in [0, 1).
int choose_hero(double u);

/// -log((word + 1/2) / 2^32): exponentially distributed, in (0, 22.9).
double flight_optical_depth(std::uint32_t word);

/// Where the flight would collide, if nothing were in the way; may be infinite.
double flight_distance(const Medium& medium, int hero, std::uint32_t word);
/// The same for flights that absorption ends, too.
double analog_flight_distance(const Medium& medium, int hero, std::uint32_t word);

/// A segment that the flight has covered.
struct Segment {
    double length;  ///< May be infinite.
    bool collision; ///< It ends in a collision, not at a surface or nowhere.
};

/// What the segment emits towards the start of the path, times the throughput at its start: the
/// expectation over the distance at which it is emitted.
Rgb emitted_radiance(const Medium& medium, const Throughput& throughput, const Segment& segment);

/// The throughput after the segment, before scattering.
Throughput after_segment(const Medium& medium, const Throughput& before, const Segment& segment);

/// What ends a flight through a medium in which absorption does, too.
enum class AnalogEnd { passed, scattered, absorbed };

/// The throughput after such a flight over a length of medium of density 1: its contribution is its
/// probability, so that without colour nothing changes.
Throughput after_analog_flight(const Medium& medium, const Throughput& before, double length,
                               AnalogEnd end);

/// The throughput after something that has this probability for each hero, which is also what it
/// contributes.
Throughput after_event(const Rgb& probability, const Throughput& before);

/// The throughput after a tentative collision (reference/tracking.h) that was taken for a real one
/// with the probability `scattered` of the hero, or else for none.
/// @param absorbed, scattered  sigma_a and sigma_s over the majorant.
Throughput after_collision(const Rgb& absorbed, const Rgb& scattered, const Throughput& before,
                           bool is_real);

/// The throughput of a path that goes on in its hero channel alone: a fair sample of that channel,
/// as the path has this hero with the probability ratio / 3.
Throughput disperse(const Throughput& before);

/// The density with which scattering draws a direction, whichever channel is the hero.
/// @param value  of the phase function in that direction, which is the density for each hero.
double mean_density(const Rgb& value, const Throughput& throughput);

/// The throughput after a direction was drawn from the phase function of the hero.
Throughput after_scattering(const Rgb& value, const Throughput& before);

/// exp(-(sigma_a + sigma_s) distance) for each channel; distance may be infinite.
Rgb transmittance(const Medium& medium, double distance);

} // namespace tyndall::reference

#include "reference/medium.h"

#include "reference/phase.h"
#include "reference/quadrature.h"

#include <algorithm>
#include <limits>

namespace tyndall::reference {
namespace {

/// exp(-sigma s), with 1 for sigma = 0 even if s is infinite.
double decay(double sigma, double s) {
    return sigma == 0 ? 1 : std::exp(-sigma * s);
}

/// Where the optical depth is reached; infinite if it never is.
double distance_of_depth(double sigma, double depth) {
    return sigma == 0 ? std::numeric_limits<double>::infinity() : depth / sigma;
}

double mean(const Rgb& v) {
    return (v.x + v.y + v.z) / 3;
}

bool all_equal(const Rgb& v) {
    return v.x == v.y && v.y == v.z;
}

/// integral_0^s sigma_a exp(-(sigma_a + sigma_s[c]) x) / mean_k(r_k exp(-sigma_s[k] x)) dx:
/// emission at x counts for each hero that gets there without a collision. Relative to the least
/// sigma_s the integrand falls at least as exp(-lambda x); x = end v^2 puts the nodes where it is
/// steep.
double emission_integral(const Medium& medium, const Throughput& throughput, int c, double s) {
    const double least = std::min({medium.sigma_s.x, medium.sigma_s.y, medium.sigma_s.z});
    const double lambda = medium.sigma_a[c] + (medium.sigma_s[c] - least);
    const double end = std::min(s, 40 / lambda); // exp(-40) is below the precision of a double.
    const auto integrand = [&](double v) {
        const double x = end * v * v;
        double reach = 0;
        for (int k = 0; k < 3; ++k)
            reach += throughput.ratio[k] * std::exp((least - medium.sigma_s[k]) * x);
        return 2 * v * std::exp(-lambda * x) * 3 / reach;
    };
    return medium.sigma_a[c] * end * integrate(integrand, 0, 1);
}

} // namespace

bool has_channel_grids(const Medium& medium) {
    const auto* grid = std::get_if<GridDensity>(&medium.density);
    return grid && (grid->sigma_a[0] || grid->sigma_s[0]);
}

bool is_grey(const Medium& medium) {
    return !has_channel_grids(medium) && all_equal(medium.sigma_a) && all_equal(medium.sigma_s) &&
           !is_chromatic(medium.phases);
}

bool is_scattering(const Medium& medium) {
    return medium.sigma_s != Rgb(0);
}

int choose_hero(double u) {
    return std::min(2, static_cast<int>(3 * u));
}

double flight_optical_depth(std::uint32_t word) {
    return -std::log((word + 0.5) * 0x1p-32); // The argument is exact: log loses nothing near 1.
}

double flight_distance(const Medium& medium, int hero, std::uint32_t word) {
    return distance_of_depth(medium.sigma_s[hero], flight_optical_depth(word));
}

double analog_flight_distance(const Medium& medium, int hero, std::uint32_t word) {
    return distance_of_depth(medium.sigma_a[hero] + medium.sigma_s[hero],
                             flight_optical_depth(word));
}

Rgb emitted_radiance(const Medium& medium, const Throughput& throughput, const Segment& segment) {
    Rgb radiance(0);
    for (int c = 0; c < 3; ++c) {
        if (throughput.beta[c] * medium.sigma_a[c] * medium.emission[c] == 0) continue;
        const double share = all_equal(medium.sigma_s)
                                 ? -std::expm1(-medium.sigma_a[c] * segment.length)
                                 : emission_integral(medium, throughput, c, segment.length);
        radiance[c] = throughput.beta[c] * medium.emission[c] * share;
    }
    return radiance;
}

Throughput after_segment(const Medium& medium, const Throughput& before, const Segment& segment) {
    // Everything is divided by the hero's own exp(-sigma_s s), which is at least 2^-33.
    const double hero_sigma = medium.sigma_s[before.hero];
    Throughput after = before;
    Rgb probability, contribution;
    for (int k = 0; k < 3; ++k) {
        const double sigma_s = medium.sigma_s[k];
        const double density = segment.collision ? sigma_s : 1;
        probability[k] = density * decay(sigma_s - hero_sigma, segment.length);
        contribution[k] = probability[k] * decay(medium.sigma_a[k], segment.length);
    }
    const double average = mean(before.ratio * probability);
    after.beta = before.beta * contribution / average;
    after.ratio = before.ratio * probability / average;
    return after;
}

Throughput after_event(const Rgb& probability, const Throughput& before) {
    const Rgb factor = probability / mean(before.ratio * probability);
    Throughput after = before;
    after.beta *= factor;
    after.ratio *= factor;
    return after;
}

Throughput after_analog_flight(const Medium& medium, const Throughput& before, double length,
                               AnalogEnd end) {
    const Rgb sigma_t = medium.sigma_a + medium.sigma_s;
    const Rgb ending = end == AnalogEnd::scattered  ? medium.sigma_s
                       : end == AnalogEnd::absorbed ? medium.sigma_a
                                                    : Rgb(1);
    if (all_equal(sigma_t) && all_equal(ending)) return before; // exactly
    Rgb probability;
    for (int k = 0; k < 3; ++k)
        probability[k] = ending[k] * decay(sigma_t[k] - sigma_t[before.hero], length);
    return after_event(probability, before);
}

Throughput after_collision(const Rgb& absorbed, const Rgb& scattered, const Throughput& before,
                           bool is_real) {
    // Where the majorant is the extinction, rounding may take the shares beyond 1.
    const Rgb probability = is_real ? scattered : glm::max(1.0 - scattered, 0.0);
    const Rgb contribution = is_real ? scattered : glm::max(1.0 - scattered - absorbed, 0.0);
    const double average = mean(before.ratio * probability);
    Throughput after = before;
    after.beta *= contribution / average;
    after.ratio *= probability / average;
    return after;
}

Throughput disperse(const Throughput& before) {
    const int hero = before.hero;
    Throughput after{Rgb(0), Rgb(0), hero};
    after.beta[hero] = before.beta[hero] * 3 / before.ratio[hero];
    after.ratio[hero] = 3;
    return after;
}

double mean_density(const Rgb& value, const Throughput& throughput) {
    return all_equal(value) ? value.x : mean(throughput.ratio * value);
}

Throughput after_scattering(const Rgb& value, const Throughput& before) {
    return all_equal(value) ? before : after_event(value, before); // exactly
}

Rgb transmittance(const Medium& medium, double distance) {
    Rgb result;
    for (int c = 0; c < 3; ++c)
        result[c] = decay(medium.sigma_a[c] + medium.sigma_s[c], distance);
    return result;
}

} // namespace tyndall::reference

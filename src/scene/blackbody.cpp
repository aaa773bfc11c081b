#include "scene/blackbody.h"

#include "scene/spectrum.h"

namespace tyndall {
namespace {

constexpr double coldest = 100, hottest = 1e6; // kelvin
constexpr int intervals = 512;
const double interval = std::log(hottest / coldest) / intervals;

/// log XYZ at temperatures evenly spaced in the logarithm, with one more before and after. XYZ is
/// positive, unlike the colour, and its logarithm, about -c / T, is smooth: cubic interpolation is
/// off by less than 240 interval^4 / 40 = 6e-7.
std::vector<glm::dvec3> make_table() {
    std::vector<glm::dvec3> table;
    for (int i = -1; i <= intervals + 1; ++i)
        table.push_back(
            glm::log(integrate_xyz(Spectrum::blackbody(coldest * std::exp(i * interval)))));
    return table;
}

} // namespace

Rgb blackbody_radiance(double kelvin) {
    if (!(kelvin > coldest)) return Rgb(0);
    if (kelvin >= hottest) return blackbody_emission(kelvin);
    static const std::vector<glm::dvec3> table = make_table();
    const double x = std::log(kelvin / coldest) / interval;
    const auto i = static_cast<std::size_t>(x);
    const double t = x - static_cast<double>(i);
    // Lagrange's cubic through the values at -1, 0, 1 and 2.
    const glm::dvec3 log_xyz =
        -t * (t - 1) * (t - 2) / 6 * table[i] + (t + 1) * (t - 1) * (t - 2) / 2 * table[i + 1] -
        (t + 1) * t * (t - 2) / 2 * table[i + 2] + (t + 1) * t * (t - 1) / 6 * table[i + 3];
    return glm::max(rgb_from_xyz(glm::exp(log_xyz)), 0.0);
}

} // namespace tyndall

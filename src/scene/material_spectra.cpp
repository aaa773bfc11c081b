#include "scene/material_spectra.h"

#include <array>
#include <cmath>
#include <vector>

namespace tyndall {
namespace {

/// n^2 = 1 + sum B x^2 / (x^2 - C), x in micrometres.
struct Glass {
    std::string_view name;
    std::array<double, 3> b, c;
};
constexpr std::array glasses{
    Glass{"BK7", {1.03961212, 0.231792344, 1.01046945}, {0.00600069867, 0.0200179144, 103.560653}},
    Glass{"BAF10", {1.5851495, 0.143559385, 1.08521269}, {0.00926681282, 0.0424489805, 105.613573}},
    Glass{
        "FK51A", {0.971247817, 0.216901417, 0.904651666}, {0.00472301995, 0.0153575612, 168.68133}},
    Glass{"LASF9", {2.00029547, 0.298926886, 1.80691843}, {0.0121426017, 0.0538736236, 156.530829}},
    Glass{"F5", {1.46141885, 0.247713019, 0.949995832}, {0.0111826126, 0.0508594669, 112.041888}},
    Glass{"F10", {1.61625977, 0.259229334, 1.07762317}, {0.0127534559, 0.0581983954, 116.60768}},
    Glass{"F11", {1.73848403, 0.311168974, 1.17490871}, {0.0136068604, 0.0615960463, 121.922711}},
};

/// Values at some wavelengths about each channel.
constexpr std::array palik_wavelengths{459.200653, 467.864838, 539.061646,
                                       551.040771, 604.800842, 619.920898};
constexpr std::array brass_wavelengths{460.0, 470.0, 540.0, 550.0, 610.0, 620.0};
struct Metal {
    std::string_view name;
    const std::array<double, 6>& wavelengths;
    std::array<double, 6> eta, k;
};
constexpr std::array metals{
    Metal{"Ag",
          palik_wavelengths,
          {0.144, 0.137313, 0.129, 0.124375, 0.1255, 0.131},
          {2.56, 2.64, 3.25, 3.348125, 3.76625, 3.88}},
    Metal{"Al",
          palik_wavelengths,
          {0.644, 0.668625, 0.912, 0.963, 1.22, 1.3},
          {5.58, 5.69, 6.55, 6.7, 7.31, 7.48}},
    Metal{"Au",
          palik_wavelengths,
          {1.426, 1.345875, 0.402, 0.3455, 0.212375, 0.194},
          {1.846, 1.814625, 2.54, 2.730625, 3.015, 3.06}},
    Metal{"Cu",
          palik_wavelengths,
          {1.16, 1.155312, 1.04, 0.950375, 0.35125, 0.272},
          {2.433, 2.469187, 2.583, 2.5765, 3.01075, 3.24}},
    Metal{"CuZn",
          brass_wavelengths,
          {0.994, 0.9, 0.549, 0.527, 0.452, 0.449},
          {1.883, 1.957, 2.668, 2.765, 3.345, 3.434}},
};

double sellmeier(const Glass& glass, double x2) {
    double square = 1;
    for (int i = 0; i < 3; ++i)
        square += glass.b[i] * x2 / (x2 - glass.c[i]);
    return std::sqrt(square);
}

double magnesia(double x2) {
    return std::sqrt(2.956362 + 0.0219577 / (x2 - 0.01428322) - 0.01062387 * x2 -
                     2.04968e-5 * x2 * x2);
}

double rutile(double x2) {
    return std::sqrt(5.913 + 0.2441 / (x2 - 0.0803));
}

/// A formula in the square of the wavelength in micrometres, tabulated.
template<typename Formula>
Spectrum tabulate(const Formula& formula) {
    std::vector<Spectrum::Sample> samples;
    for (double x = 430; x <= 830; x += 5)
        samples.push_back({x, formula(x * x * 1e-6)});
    return Spectrum::piecewise_linear(std::move(samples));
}

std::optional<Spectrum> glass_spectrum(std::string_view name) {
    if (name.starts_with('S')) name.remove_prefix(1);
    for (const Glass& glass : glasses)
        if (glass.name == name) return tabulate([&](double x2) { return sellmeier(glass, x2); });
    return std::nullopt;
}

std::optional<Spectrum> metal_spectrum(std::string_view name, bool is_k) {
    if (name == "MgO") return tabulate([&](double x2) { return is_k ? 0 : magnesia(x2); });
    if (name == "TiO2") return tabulate([&](double x2) { return is_k ? 0 : rutile(x2); });
    for (const Metal& metal : metals) {
        if (metal.name != name) continue;
        std::vector<Spectrum::Sample> samples;
        for (std::size_t i = 0; i < metal.wavelengths.size(); ++i)
            samples.push_back({metal.wavelengths[i], is_k ? metal.k[i] : metal.eta[i]});
        return Spectrum::piecewise_linear(std::move(samples));
    }
    return std::nullopt;
}

} // namespace

std::optional<Spectrum> material_spectrum(std::string_view name) {
    constexpr std::string_view glass = "glass-", metal = "metal-", eta = "-eta", k = "-k";
    if (name.starts_with(glass)) return glass_spectrum(name.substr(glass.size()));
    if (!name.starts_with(metal)) return std::nullopt;
    name.remove_prefix(metal.size());
    for (const std::string_view suffix : {eta, k})
        if (name.ends_with(suffix))
            return metal_spectrum(name.substr(0, name.size() - suffix.size()), suffix == k);
    return std::nullopt;
}

} // namespace tyndall

#include "scene/spectrum.h"

#include "scene/cie.h"
#include "scene/material_spectra.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tyndall {
namespace {

constexpr double integration_step = 0.1; // nm; divides observer_step

/// The observer between its samples: the cubic through the four around, so that 5 nm samples give
/// the 1 nm table of the CIE to 1e-3, and mostly to 1e-5.
glm::dvec3 interpolate_observer(std::size_t interval, double t) {
    const auto at = [](std::ptrdiff_t i) {
        const auto last = static_cast<std::ptrdiff_t>(observer.size()) - 1;
        return observer[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))];
    };
    const auto i = static_cast<std::ptrdiff_t>(interval);
    return -t * (t - 1) * (t - 2) / 6 * at(i - 1) + (t + 1) * (t - 1) * (t - 2) / 2 * at(i) -
           (t + 1) * t * (t - 2) / 2 * at(i + 1) + (t + 1) * t * (t - 1) / 6 * at(i + 2);
}

/// Samples of the observer times their weights in the trapezoidal rule.
std::vector<glm::dvec3> make_weights() {
    const auto per_interval =
        static_cast<std::size_t>(std::lround(observer_step / integration_step));
    std::vector<glm::dvec3> weights;
    weights.reserve((observer.size() - 1) * per_interval + 1);
    for (std::size_t i = 0; i + 1 < observer.size(); ++i) {
        for (std::size_t k = 0; k < per_interval; ++k) {
            const double t = static_cast<double>(k) / static_cast<double>(per_interval);
            weights.push_back(interpolate_observer(i, t) * integration_step);
        }
    }
    weights.push_back(observer.back() * integration_step);
    weights.front() *= 0.5;
    weights.back() *= 0.5;
    return weights;
}

/// Integral of s times the observer; s is any function of the wavelength.
template<typename Function>
glm::dvec3 integrate(const Function& s) {
    static const std::vector<glm::dvec3> weights = make_weights();
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double wavelength = observer_start + integration_step * static_cast<double>(i);
        sum += weights[i] * s(wavelength);
    }
    return sum;
}

/// Daylight of a colour temperature in kelvin, 4000 to 7000: CIE 15:2004, eq. 3.2 to 3.4, with M1
/// and M2 rounded to three decimals as the CIE does for its tables.
Spectrum make_daylight(double kelvin) {
    const double t = kelvin / 1000;
    const double x = -4.6070 / (t * t * t) + 2.9678 / (t * t) + 0.09911 / t + 0.244063;
    const double y = -3 * x * x + 2.870 * x - 0.275;
    const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
    const double m1 = std::round((-1.3515 - 1.7703 * x + 5.9114 * y) / m * 1000) / 1000;
    const double m2 = std::round((0.0300 - 31.4424 * x + 30.0717 * y) / m * 1000) / 1000;
    std::vector<Spectrum::Sample> samples;
    for (std::size_t i = 0; i < daylight.size(); ++i) {
        samples.push_back({daylight_start + daylight_step * static_cast<double>(i),
                           glm::dot(daylight[i], glm::dvec3(1, m1, m2))});
    }
    return Spectrum::piecewise_linear(std::move(samples));
}

/// Illuminant A: CIE 15:2004, eq. 3.1.
Spectrum make_illuminant_a() {
    std::vector<Spectrum::Sample> samples;
    for (int wavelength = 300; wavelength <= 830; ++wavelength) {
        const auto planck = [](double x) {
            return 1 / (std::pow(x, 5) * std::expm1(1.435e7 / (2848 * x)));
        };
        samples.push_back(
            {static_cast<double>(wavelength), 100 * planck(wavelength) / planck(560)});
    }
    return Spectrum::piecewise_linear(std::move(samples));
}

// The CIE corrects the nominal temperature for a later value of the second radiation constant.
constexpr double d65_kelvin = 6500 * 1.4388 / 1.4380;
constexpr double d50_kelvin = 5000 * 1.4388 / 1.4380;

const Spectrum& d65() {
    static const Spectrum spectrum = make_daylight(d65_kelvin);
    return spectrum;
}

/// The matrix from the chromaticities of the primaries and the white of D65.
glm::dmat3 make_rgb_from_xyz() {
    const auto from_xy = [](double x, double y) { return glm::dvec3(x / y, 1, (1 - x - y) / y); };
    const glm::dmat3 primaries(from_xy(0.64, 0.33), from_xy(0.30, 0.60), from_xy(0.15, 0.06));
    const glm::dvec3 white = integrate(d65());
    const glm::dvec3 scale = glm::inverse(primaries) * (white / white.y);
    return glm::inverse(
        glm::dmat3(primaries[0] * scale[0], primaries[1] * scale[1], primaries[2] * scale[2]));
}

double piecewise(const std::vector<Spectrum::Sample>& samples, double wavelength) {
    if (wavelength < samples.front().wavelength || wavelength > samples.back().wavelength) return 0;
    const auto after = std::upper_bound(
        samples.begin(), samples.end(), wavelength,
        [](double x, const Spectrum::Sample& sample) { return x < sample.wavelength; });
    if (after == samples.end()) return samples.back().value;
    const Spectrum::Sample& a = *(after - 1);
    const Spectrum::Sample& b = *after;
    return glm::mix(a.value, b.value, (wavelength - a.wavelength) / (b.wavelength - a.wavelength));
}

/// Planck's law over its maximum, in u = h c / (lambda k T): u^5 / (e^u - 1).
double planck(double kelvin, double wavelength) {
    constexpr double radiation_constant = 1.438776877e7; // h c / k [nm K], exact SI values
    constexpr double u_peak = 4.965114231744276;         // maximum of u^5 / (e^u - 1)
    const double u = radiation_constant / (wavelength * kelvin);
    // Quotients first: u^5 overflows for cold bodies, where the exponential wins.
    const double ratio = u / u_peak;
    const double quotient = std::expm1(u_peak) / std::expm1(u);
    return quotient > 0 ? std::pow(ratio, 5) * quotient : 0;
}

} // namespace

Spectrum Spectrum::piecewise_linear(std::vector<Sample> samples) {
    Spectrum spectrum;
    spectrum.samples_ = std::move(samples);
    return spectrum;
}

Spectrum Spectrum::blackbody(double kelvin) {
    Spectrum spectrum;
    spectrum.kelvin_ = kelvin;
    return spectrum;
}

double Spectrum::operator()(double wavelength) const {
    return kelvin_ > 0 ? planck(kelvin_, wavelength) : piecewise(samples_, wavelength);
}

std::optional<Spectrum> named_spectrum(std::string_view name) {
    if (name == "stdillum-D65") return d65();
    if (name == "stdillum-D50") return make_daylight(d50_kelvin);
    if (name == "stdillum-A") return make_illuminant_a();
    return material_spectrum(name);
}

bool is_unsupported_spectrum(std::string_view name) {
    return name.starts_with("stdillum-F") || name == "illum-acesD60";
}

glm::dvec3 integrate_xyz(const Spectrum& s) {
    return integrate(s);
}

glm::dvec3 rgb_from_xyz(const glm::dvec3& xyz) {
    static const glm::dmat3 matrix = make_rgb_from_xyz();
    return matrix * xyz;
}

glm::dvec3 light_colour(const Spectrum& s) {
    const glm::dvec3 xyz = integrate(s);
    return xyz.y > 0 ? rgb_from_xyz(xyz / xyz.y) : glm::dvec3(0);
}

glm::dvec3 reflectance_colour(const Spectrum& s) {
    static const double white_y = integrate(d65()).y;
    const glm::dvec3 xyz = integrate([&](double x) { return s(x) * d65()(x); });
    return glm::clamp(rgb_from_xyz(xyz / white_y), 0.0, 1.0);
}

glm::dvec3 blackbody_emission(double kelvin) {
    return glm::max(rgb_from_xyz(integrate_xyz(Spectrum::blackbody(kelvin))), 0.0);
}

glm::dvec3 channel_values(const Spectrum& s) {
    return {s(channel_wavelengths.r), s(channel_wavelengths.g), s(channel_wavelengths.b)};
}

} // namespace tyndall

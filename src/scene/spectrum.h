/// Spectra, and the linear sRGB triples that the renderers work with.
///
/// Wavelengths are in nm. Colours follow the CIE 1931 2 degree observer over 360 to 830 nm; the
/// white of sRGB is illuminant D65 as tabulated by the CIE, so that D65 gives (1, 1, 1).
///
/// Sources: CIE 15:2004 (observer at 5 nm, daylight components, illuminant A); IEC 61966-2-1
/// (sRGB); pbrt-v4 for what a spectrum means as the value of a parameter.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>
#include <vector>

namespace tyndall {

/// Wavelengths at which R, G and B see coefficients that depend on the wavelength: the dominant
/// wavelengths of the primaries of sRGB.
inline constexpr glm::dvec3 channel_wavelengths{611.4, 549.1, 464.3};

/// A function of the wavelength.
class Spectrum {
  public:
    struct Sample {
        double wavelength;
        double value;
    };

    /// Linear between samples, 0 before the first and after the last (pbrt's rule).
    /// @param samples  at least one, wavelengths increasing.
    static Spectrum piecewise_linear(std::vector<Sample> samples);

    /// Planck's law, scaled to 1 at its maximum.
    /// @param kelvin  > 0.
    static Spectrum blackbody(double kelvin);

    double operator()(double wavelength) const;

  private:
    Spectrum() = default;

    std::vector<Sample> samples_; ///< Of a piecewise linear spectrum.
    double kelvin_ = 0;           ///< Of a blackbody; else 0.
};

/// A spectrum by its name in pbrt: "stdillum-A", "stdillum-D50", "stdillum-D65", and what
/// scene/material_spectra.h has.
std::optional<Spectrum> named_spectrum(std::string_view name);

/// Whether pbrt has a spectrum of that name that named_spectrum has not (fluorescent lamps, ACES
/// D60).
bool is_unsupported_spectrum(std::string_view name);

/// Integrals of s * x_bar, s * y_bar, s * z_bar [nm]. y_bar alone gives 106.857.
glm::dvec3 integrate_xyz(const Spectrum& s);

/// Linear sRGB of X, Y, Z; Y = 1 with the chromaticity of D65 gives (1, 1, 1). May be negative.
glm::dvec3 rgb_from_xyz(const glm::dvec3& xyz);

/// Colour of light at luminance 1, whatever the magnitude of the spectrum: pbrt divides light
/// sources by their photometric integral. May be negative outside the gamut; 0 for light that
/// nobody sees.
glm::dvec3 light_colour(const Spectrum& s);

/// Colour of a surface under D65: reflectance 1 gives (1, 1, 1). Clamped to [0, 1], which only
/// colours outside the gamut need.
glm::dvec3 reflectance_colour(const Spectrum& s);

/// Radiance of a black body, Planck's law scaled to a maximum of 1 over wavelengths (as pbrt emits
/// from temperature grids): integrated per nm and not divided by anything, so near 100 where the
/// maximum is visible. Clamped to 0 where outside the gamut.
/// @param kelvin  > 0.
glm::dvec3 blackbody_emission(double kelvin);

/// The spectrum at channel_wavelengths.
glm::dvec3 channel_values(const Spectrum& s);

} // namespace tyndall

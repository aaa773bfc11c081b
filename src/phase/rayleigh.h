/// Rayleigh scattering by the molecules of air.
#pragma once

namespace tyndall {

/// Scattering coefficient [1/m] of dry air at sea level: 288.15 K, 1013.25 hPa, 360 ppm of CO2.
///
/// sigma_s = 24 pi^3 (n^2 - 1)^2 / (lambda^4 N (n^2 + 2)^2) F_K: the refractive index n of Peck and
/// Reeder (1972), N = 2.546899e25 molecules per m^3 at the same conditions, and the King factor
/// F_K, about 1.05, for molecules that are not spheres (Bates 1984). Source: Bodhaine, Wood, Dutton
/// and Slusser (1999), "On Rayleigh Optical Depth Calculations", equations 2 to 23; within 0.1 % of
/// Bucholtz (1995). n and F_K vary with the wavelength, so that between 440 and 680 nm the
/// coefficient falls 1.7 % faster than 1/lambda^4 with each halving.
///
/// @param wavelength_um  in vacuum [um], in [0.2, 4].
double air_rayleigh_coefficient(double wavelength_um);

} // namespace tyndall

/// Refractive indices of glasses and metals by their names in pbrt.
#pragma once

#include "scene/spectrum.h"

#include <optional>
#include <string_view>

namespace tyndall {

/// "glass-BK7", -BAF10, -FK51A, -LASF9, -F5, -F10, -F11 (SF5, SF10 and SF11, by both names),
/// "metal-Cu-eta" and -k, and likewise Ag, Al, Au, CuZn, MgO, TiO2. At least over 459 to 620 nm,
/// which holds the wavelengths of the channels.
///
/// Sources: glasses by the Sellmeier formula with the coefficients of Schott's catalogues; Ag, Al,
/// Au, Cu from Palik, Handbook of Optical Constants of Solids (1985), CuZn from SOPRA; MgO after
/// Stephens and Malitson (1952), TiO2 (ordinary ray) after Devore (1951), both without absorption.
std::optional<Spectrum> material_spectrum(std::string_view name);

} // namespace tyndall

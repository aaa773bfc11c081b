#include "phase/rayleigh.h"

#include <cmath>
#include <gtest/gtest.h>

namespace tyndall {
namespace {

/// By the same equations in an independent program; Bodhaine's rational fit (his equation 29)
/// agrees to 7e-5.
TEST(AirRayleigh, CoefficientsMatchBodhaine) {
    constexpr double known[][2] = {{0.400, 4.26307e-5}, {0.440, 2.87119e-5}, {0.500, 1.69658e-5},
                                   {0.550, 1.14879e-5}, {0.600, 8.05848e-6}, {0.680, 4.84790e-6},
                                   {0.700, 4.31076e-6}};
    for (const auto& [wavelength, coefficient] : known) {
        EXPECT_NEAR(air_rayleigh_coefficient(wavelength) / coefficient, 1, 2e-6) << wavelength;
        EXPECT_GT(std::abs(air_rayleigh_coefficient(1.001 * wavelength) / coefficient - 1), 2e-3);
    }
}

/// Nearly: -2.3 % at 440 and +1.4 % at 680 nm, relative to 550.
TEST(AirRayleigh, FallsWithTheFourthPower) {
    const auto over_power = [](double w) {
        return air_rayleigh_coefficient(0.55) * std::pow(0.55 / w, 4) / air_rayleigh_coefficient(w);
    };
    EXPECT_NEAR(over_power(0.44), 1 - 0.023, 1e-3);
    EXPECT_NEAR(over_power(0.68), 1 + 0.014, 1e-3);
}

} // namespace
} // namespace tyndall

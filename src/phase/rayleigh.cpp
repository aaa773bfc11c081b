#include "phase/rayleigh.h"

#include <cmath>
#include <numbers>

namespace tyndall {

double air_rayleigh_coefficient(double wavelength_um) {
    constexpr double carbon_dioxide = 360e-6; // parts by volume
    constexpr double molecules_per_cubic_metre = 2.546899e25;
    const double w = 1 / (wavelength_um * wavelength_um); // 1/um^2
    // Refractivity at 300 ppm of CO2, then at what there is.
    const double refractivity_300 =
        1e-8 * (8060.51 + 2480990 / (132.274 - w) + 17455.7 / (39.32957 - w));
    const double refractivity = refractivity_300 * (1 + 0.54 * (carbon_dioxide - 300e-6));

    struct Gas {
        double percent, king_factor;
    };
    const Gas gases[] = {{78.084, 1.034 + 3.17e-4 * w},                     // N2
                         {20.946, 1.096 + 1.385e-3 * w + 1.448e-4 * w * w}, // O2
                         {0.934, 1},                                        // Ar
                         {100 * carbon_dioxide, 1.15}};
    double weighted = 0, total = 0;
    for (const Gas& gas : gases) {
        weighted += gas.percent * gas.king_factor;
        total += gas.percent;
    }
    const double index = 1 + refractivity;
    const double polarisability =
        refractivity * (index + 1) / (index * index + 2); // (n^2-1)/(n^2+2)
    const double wavelength_m = 1e-6 * wavelength_um;
    const double wavelength_4 = std::pow(wavelength_m, 4);
    return 24 * std::pow(std::numbers::pi, 3) * polarisability * polarisability /
           (wavelength_4 * molecules_per_cubic_metre) * (weighted / total);
}

} // namespace tyndall

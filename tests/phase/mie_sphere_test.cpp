// One sphere: Wiscombe's published efficiencies and amplitudes, and limits in closed form.
#include "phase/mie_sphere.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace tyndall {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

struct Known {
    double x;
    Complex index;
    double extinction, scattering, asymmetry;
};

/// Wiscombe, MIEV0, test cases 5 to 19 (MVTstNew.f), with the digits that another program of double
/// precision adds.
constexpr Known wiscombe[] = {
    {0.099, {0.75, 0}, 7.417859115e-06, 7.417859115e-06, 0.00144823},
    {0.101, {0.75, 0}, 8.033538149e-06, 8.033538149e-06, 0.00150743},
    {10, {0.75, 0}, 2.232264843, 2.232264843, 0.89647255},
    {1000, {0.75, 0}, 1.997908184, 1.997908184, 0.84494429},
    {1, {1.33, 1e-5}, 9.395198375e-02, 9.392330273e-02, 0.18451735},
    {100, {1.33, 1e-5}, 2.101320706, 2.096593506, 0.86895927},
    {10000, {1.33, 1e-5}, 2.004088934, 1.723857218, 0.90784037},
    {0.055, {1.5, 1}, 1.014910390e-01, 1.131687232e-05, 0.00049117},
    {0.056, {1.5, 1}, 1.033466917e-01, 1.216310942e-05, 0.00050918},
    {1, {1.5, 1}, 2.336320985, 6.634537615e-01, 0.19213640},
    {100, {1.5, 1}, 2.097501755, 1.283697049, 0.85025200},
    {10000, {1.5, 1}, 2.004367710, 1.236574312, 0.84630996},
    {1, {10, 10}, 2.532993078, 2.049405007, -0.11066436},
    {100, {10, 10}, 2.071124327, 1.836785404, 0.55621548},
    {10000, {10, 10}, 2.005914333, 1.795393030, 0.54819404},
    // Bohren and Huffman 1983, appendix A, with the digits of miepython's tests; water.
    {2 * pi * 0.525 / 0.6328, {1.55, 0.1}, 2.86165188243, 1.66424911991, 0.80128972639},
    {10, {1.5, 0.1}, 2.459790528, 1.235144209, 1.139235 / 1.235144209},
    {0.1, {1.333, 0}, 1.127474477e-05, 1.127474477e-05, 0.00183442},
    {1000, {1.333, 0}, 2.022811433, 2.022811433, 0.8800944987}};

/// Six digits: half a unit of the seventh in what is printed with most digits, and of the last one
/// in g.
bool agrees(const MieEfficiencies& e, const Known& k) {
    return std::abs(e.extinction / k.extinction - 1) < 5e-7 &&
           std::abs(e.scattering / k.scattering - 1) < 5e-7 &&
           std::abs(e.asymmetry - k.asymmetry) < 5e-7;
}

TEST(MieSphere, EfficienciesMatchWiscombe) {
    for (const Known& k : wiscombe) {
        const MieEfficiencies e = MieSphere(k.x, k.index).efficiencies();
        EXPECT_TRUE(agrees(e, k)) << k.x << ' ' << k.index << ": " << e.extinction << ' '
                                  << e.scattering << ' ' << e.asymmetry;
        // Teeth: an index, or for all but very large spheres a size, that is 0.1 % off.
        EXPECT_FALSE(agrees(MieSphere(k.x, k.index * 1.001).efficiencies(), k)) << k.x;
        EXPECT_TRUE(k.x > 1e3 || !agrees(MieSphere(k.x * 1.001, k.index).efficiencies(), k)) << k.x;
    }
}

/// Qsca -> 8/3 x^4 |L|^2, Qabs -> 4 x Im L, L = (m^2 - 1) / (m^2 + 2), each with a relative error
/// of order x^2.
TEST(MieSphere, SmallSpheresReachTheRayleighLimit) {
    for (const Complex index : {Complex(1.5, 0), Complex(1.33, 1e-9), Complex(0.75, 0.2),
                                Complex(1 + 1e-6, 0), Complex(1.5, 1)})
        for (const double x : {1e-6, 1e-4, 1e-3}) {
            const Complex square = index * index;
            const Complex factor = (index - 1.0) * (index + 1.0) / (square + 2.0);
            const MieEfficiencies e = MieSphere(x, index).efficiencies();
            const double scattering = 8.0 / 3 * std::pow(x, 4) * std::norm(factor);
            const double extinction = scattering + 4 * x * factor.imag();
            // Of order x^2; 1 - 1/m^2 has lost 6 digits for 1 + 1e-6.
            const double tolerance = 5 * x * x + 1e-9;
            EXPECT_NEAR(e.scattering / scattering, 1, tolerance) << index << ' ' << x;
            EXPECT_NEAR(e.extinction / extinction, 1, tolerance) << index << ' ' << x;
            EXPECT_GT(std::abs(e.scattering / (1.01 * scattering) - 1), tolerance);
            EXPECT_LT(std::abs(e.asymmetry), 2 * x * x);
        }
}

TEST(MieSphere, NothingIsLostWithoutAbsorption) {
    for (const double x : {1e-6, 0.3, 7.0, 123.0, 5000.0}) {
        const MieEfficiencies e = MieSphere(x, 1.4).efficiencies();
        EXPECT_EQ(e.extinction, e.scattering) << x;
        EXPECT_GT(MieSphere(x, Complex(1.4, 1e-4)).efficiencies().extinction, 0);
    }
}

/// S1, S2 at 0, 30, ..., 180 degrees of Wiscombe's case 15 (x = 100, m = 1.5 - i), as (|S1|^2 +
/// |S2|^2) / 2. The angles of add_intensity do not meet them: the trigonometric polynomial through
/// its values does. The trigonometric polynomial through what add_intensity gives, at any angle.
double intensity(const MieSphere& sphere, double theta) {
    std::vector<double> f(2 * sphere.term_count() + 2);
    sphere.add_intensity(1, f);
    const double n = static_cast<double>(f.size());
    double sum = 0;
    for (double j = 0; j < n; ++j) {
        double c = 0;
        for (std::size_t k = 0; k < f.size(); ++k)
            c += f[k] * std::cos(j * pi * (static_cast<double>(k) + 0.5) / n);
        sum += (j == 0 ? 1 : 2) * c / n * std::cos(j * theta);
    }
    return sum;
}

TEST(MieSphere, IntensitiesMatchWiscombe) {
    const double known[] = {2.75830534e7, 1.20864572e3, 6.06235751e2, 4.74502879e2,
                            4.38390831e2, 4.31439986e2, 4.31053613e2};
    for (int i = 0; i <= 6; ++i) {
        const auto found = [&](double x) { return intensity(MieSphere(x, {1.5, 1}), i * pi / 6); };
        EXPECT_NEAR(found(100) / known[i], 1, 1e-6) << 30 * i;
        EXPECT_GT(std::abs(found(100.1) / known[i] - 1), 1e-4) << "no teeth";
    }
}

} // namespace
} // namespace tyndall

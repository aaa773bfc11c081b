/// Lorenz-Mie theory: a plane wave scattered by one homogeneous sphere.
#pragma once

#include <complex>
#include <span>
#include <vector>

namespace tyndall {

/// Of one sphere, relative to its geometric cross section pi r^2.
struct MieEfficiencies {
    double extinction = 0;
    double scattering = 0; ///< The rest of the extinction is absorbed.
    double asymmetry = 0;  ///< Mean cosine of the scattering angle.
};

/// Expansion coefficients a_n, b_n of the scattered field (Bohren and Huffman 1983, chapter 4).
///
/// They are built from psi_n(x), chi_n(x) and the ratios s_n = psi_{n+1} / psi_n inside and
/// outside, by recurrences in their stable direction: s_n downward, chi_n upward, psi_n upward
/// while n < x and by s_n from there. With ratios in place of Bohren and Huffman's logarithmic
/// derivatives D_n = (n + 1) / z - s_n the leading terms of a small sphere cancel by themselves, so
/// that the Rayleigh limit needs no series of its own. The number of terms follows Wiscombe (1980),
/// "Improved Mie scattering algorithms".
class MieSphere {
  public:
    /// @param size_parameter  x = 2 pi r / wavelength, both in the surrounding medium; in [1e-6,
    /// 1e5].
    /// @param index           refractive index n + ik relative to the medium; n > 0, k >= 0
    /// absorbs. Not 1.
    MieSphere(double size_parameter, std::complex<double> index);

    MieEfficiencies efficiencies() const;

    /// The terms; the intensity is a polynomial of twice that degree in the cosine.
    std::size_t term_count() const { return a_.size(); }

    /// Adds weight * (|S1|^2 + |S2|^2) / 2, the intensity for unpolarised light, at the angles
    /// theta = pi (k + 1/2) / sum.size(), k = 0, 1, ...
    /// @param sum  of even length.
    void add_intensity(double weight, std::span<double> sum) const;

  private:
    double x_;
    std::vector<std::complex<double>> a_, b_; ///< [n - 1]
    double absorption_ = 0; ///< Sum of (2n + 1) (Re a_n - |a_n|^2 + Re b_n - |b_n|^2).
};

} // namespace tyndall

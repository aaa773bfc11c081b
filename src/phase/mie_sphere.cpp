#include "phase/mie_sphere.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace tyndall {
namespace {

using Complex = std::complex<double>;

/// Terms until |a_n|, |b_n| are below about 1e-8, by Wiscombe (1980), with two to spare.
std::size_t terms_of(double x) {
    return static_cast<std::size_t>(x + 4.05 * std::cbrt(x)) + 4;
}

/// s_n = psi_{n+1}(z) / psi_n(z) for n = 0 ... count, from psi_{n-1} + psi_{n+1} = (2n + 1) / z
/// psi_n downward. The start at 0 is forgotten where n exceeds |z|, across a range of some
/// cbrt(|z|).
template<typename Number>
std::vector<Number> ratios(Number z, std::size_t count) {
    const double size = std::abs(z);
    const std::size_t start = std::max(count, static_cast<std::size_t>(size)) +
                              static_cast<std::size_t>(8 * std::cbrt(size)) + 16;
    std::vector<Number> s(count + 1);
    Number ratio = 0;
    for (std::size_t n = start; n > 0; --n) {
        ratio = 1.0 / ((2 * static_cast<double>(n) + 1) / z - ratio);
        if (n - 1 <= count) s[n - 1] = ratio;
    }
    return s;
}

} // namespace

MieSphere::MieSphere(double size_parameter, Complex index) : x_(size_parameter) {
    TYNDALL_ASSERT(x_ > 0 && index.real() > 0 && index.imag() >= 0);
    const std::size_t count = terms_of(x_);
    const std::vector<Complex> inside = ratios(index * x_, count);
    const std::vector<double> outside = ratios(x_, count);
    const Complex index_squared_inverse = 1.0 / (index * index);
    double psi_before = std::cos(x_), psi = std::sin(x_); // orders -1 and 0
    double chi_before = -psi, chi = psi_before;
    for (std::size_t order = 0; order <= count; ++order) {
        const double n = static_cast<double>(order);
        const double psi_next =
            n + 1 < x_ ? (2 * n + 1) / x_ * psi - psi_before : outside[order] * psi;
        const double chi_next = (2 * n + 1) / x_ * chi - chi_before;
        if (order > 0) {
            const Complex xi(psi, -chi), xi_next(psi_next, -chi_next);
            const Complex for_a =
                (n + 1) / x_ * (index_squared_inverse - 1.0) - inside[order] / index;
            const Complex for_b = -index * inside[order];
            const Complex below_a = for_a * xi + xi_next, below_b = for_b * xi + xi_next;
            a_.push_back((for_a * psi + psi_next) / below_a);
            b_.push_back((for_b * psi + psi_next) / below_b);
            // The Wronskian psi_n chi_{n+1} - psi_{n+1} chi_n = 1 leaves this of Re a - |a|^2: no
            // difference of nearly equal numbers where little is absorbed.
            absorption_ -= (2 * n + 1) *
                           (for_a.imag() / std::norm(below_a) + for_b.imag() / std::norm(below_b));
        }
        psi_before = std::exchange(psi, psi_next);
        chi_before = std::exchange(chi, chi_next);
    }
}

MieEfficiencies MieSphere::efficiencies() const {
    double scattering = 0, asymmetry = 0;
    for (std::size_t i = 0; i < a_.size(); ++i) {
        const double n = static_cast<double>(i + 1);
        scattering += (2 * n + 1) * (std::norm(a_[i]) + std::norm(b_[i]));
        asymmetry += (2 * n + 1) / (n * (n + 1)) * (a_[i] * std::conj(b_[i])).real();
        if (i + 1 == a_.size()) break;
        const Complex neighbours = a_[i] * std::conj(a_[i + 1]) + b_[i] * std::conj(b_[i + 1]);
        asymmetry += n * (n + 2) / (n + 1) * neighbours.real();
    }
    const double scale = 2 / (x_ * x_);
    return {.extinction = scale * (scattering + absorption_),
            .scattering = scale * scattering,
            .asymmetry = 2 * asymmetry / scattering};
}

namespace {

/// Angles go through the series in blocks, which the compiler turns into vectors.
constexpr std::size_t block = 16;
using Lanes = std::array<double, block>;

/// Real and imaginary part of S1 + S2 and S1 - S2, at cosines and at the opposite cosines.
struct Amplitudes {
    Lanes plus_re{}, plus_im{}, minus_re{}, minus_im{};
    Lanes back_plus_re{}, back_plus_im{}, back_minus_re{}, back_minus_im{};
};

/// One term: f (a + b) and f (a - b), f = (2n + 1) / (n (n + 1)).
struct Term {
    double plus_re, plus_im, minus_re, minus_im;
};

// Where time goes for wide distributions of sizes: let it use wide vectors where there are some.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__) &&                        \
    !defined(__SANITIZE_ADDRESS__)
#define TYNDALL_WIDE_VECTORS __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define TYNDALL_WIDE_VECTORS
#endif

/// S1 + S2 = sum f (a + b) (pi_n + tau_n), S1 - S2 = sum f (a - b) (pi_n - tau_n). At the opposite
/// cosine pi_n + tau_n is (-1)^(n - 1) (pi_n - tau_n): one run of the recurrences serves both.
TYNDALL_WIDE_VECTORS Amplitudes sum_terms(std::span<const Term> terms, const Lanes mu) {
    Amplitudes s;
    Lanes pi_before{}, pi_now;
    pi_now.fill(1);
    double n = 0, sign = -1;
    for (const Term& term : terms) {
        n += 1;
        sign = -sign;
        const double up = (n + 1) / n;
        for (std::size_t l = 0; l < block; ++l) {
            const double along = mu[l] * pi_now[l];
            const double difference = along - pi_before[l];
            const double tau = n * difference - pi_before[l];
            const double p = pi_now[l] + tau, q = pi_now[l] - tau;
            const double back_p = sign * q, back_q = sign * p;
            s.plus_re[l] += term.plus_re * p;
            s.plus_im[l] += term.plus_im * p;
            s.minus_re[l] += term.minus_re * q;
            s.minus_im[l] += term.minus_im * q;
            s.back_plus_re[l] += term.plus_re * back_p;
            s.back_plus_im[l] += term.plus_im * back_p;
            s.back_minus_re[l] += term.minus_re * back_q;
            s.back_minus_im[l] += term.minus_im * back_q;
            pi_before[l] = pi_now[l];
            pi_now[l] = along + up * difference;
        }
    }
    return s;
}

double square(double x) {
    return x * x;
}

} // namespace

void MieSphere::add_intensity(double weight, std::span<double> sum) const {
    TYNDALL_ASSERT(sum.size() % 2 == 0);
    std::vector<Term> terms;
    for (std::size_t i = 0; i < a_.size(); ++i) {
        const double n = static_cast<double>(i + 1);
        const double f = (2 * n + 1) / (n * (n + 1));
        const Complex plus = f * (a_[i] + b_[i]), minus = f * (a_[i] - b_[i]);
        terms.push_back({plus.real(), plus.imag(), minus.real(), minus.imag()});
    }
    const std::size_t half = sum.size() / 2;
    for (std::size_t first = 0; first < half; first += block) {
        Lanes mu;
        for (std::size_t l = 0; l < block; ++l) {
            const double k = static_cast<double>(std::min(first + l, half - 1));
            mu[l] = std::cos(std::numbers::pi * (k + 0.5) / static_cast<double>(sum.size()));
        }
        const Amplitudes s = sum_terms(terms, mu);
        // (|S1|^2 + |S2|^2) / 2 = (|S1 + S2|^2 + |S1 - S2|^2) / 4
        for (std::size_t l = 0; l < block && first + l < half; ++l) {
            sum[first + l] += weight / 4 *
                              (square(s.plus_re[l]) + square(s.plus_im[l]) + square(s.minus_re[l]) +
                               square(s.minus_im[l]));
            sum[sum.size() - 1 - first - l] +=
                weight / 4 *
                (square(s.back_plus_re[l]) + square(s.back_plus_im[l]) +
                 square(s.back_minus_re[l]) + square(s.back_minus_im[l]));
        }
    }
}

} // namespace tyndall

#include "phase/mie.h"

#include "core/error.h"
#include "phase/mie_sphere.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <complex>
#include <numbers>
#include <thread>

namespace tyndall {
namespace {

using std::numbers::pi;

/// One wavelength in one kind of sphere.
struct Optics {
    double wavenumber;          ///< In the medium [1/um].
    std::complex<double> index; ///< Relative to the medium.
    bool operator==(const Optics&) const = default;
};

Optics optics_of(const MieParameters& p, std::size_t channel) {
    return {2 * pi * p.medium_eta / p.wavelength_um[channel],
            std::complex(p.eta[channel], p.k[channel]) / p.medium_eta};
}

/// A size of the distribution.
struct Member {
    double radius;
    double number; ///< Of its kind, up to a factor.
    MieEfficiencies efficiencies;
    double scattering() const { return number * pi * radius * radius * efficiencies.scattering; }
};

Member make_member(const Optics& optics, double radius, double number) {
    const double x = optics.wavenumber * radius;
    if (!(x >= 1e-6 && x <= 1e4))
        throw Error(ExitStatus::bad_input,
                    "a size parameter 2 pi r / wavelength is outside the range [1e-6, 1e4]");
    return {radius, number, MieSphere(x, optics.index).efficiencies()};
}

/// The variable in which sizes are spaced evenly: compute_mie says why.
struct SizeScale {
    double sigma, median; ///< Of ln(radius); size parameter.
    /// u = ln(radius / median)
    double operator()(double u) const {
        const double x = median * std::exp(u);
        return 4 * u / sigma + x + 250 * std::log1p(x / 30);
    }
    double slope(double u) const {
        const double x = median * std::exp(u);
        return 4 / sigma + x + 250 * x / (x + 30);
    }
    /// Newton's method: the scale is increasing and convex.
    double invert(double t, double guess) const {
        for (double change = 1; std::abs(change) > 1e-13; guess += change)
            change = (t - (*this)(guess)) / slope(guess);
        return guess;
    }
};

/// The sizes of a lognormal distribution that matter, from the median outward.
std::vector<Member> members(const MieParameters& p, const Optics& optics) {
    if (p.radius_sigma == 0) return {make_member(optics, p.radius_um, 1)};
    const SizeScale scale{p.radius_sigma, optics.wavenumber * p.radius_um};
    std::vector<Member> all;
    double most = 0;
    for (const double direction : {1.0, -1.0}) {
        double u = 0, t = direction > 0 ? scale(0) : scale(0) - 1;
        while (true) {
            u = scale.invert(t, u);
            const double z = u / p.radius_sigma;
            all.push_back(make_member(optics, p.radius_um * std::exp(u),
                                      std::exp(-z * z / 2) / scale.slope(u)));
            most = std::max(most, all.back().scattering());
            // Past the mode of r^6 times the distribution, where small spheres scatter most, it
            // only falls.
            const bool is_past_mode = direction < 0 || u > 6 * p.radius_sigma * p.radius_sigma;
            if (is_past_mode && std::abs(z) > 3 && all.back().scattering() < 1e-6 * most) break;
            t += direction;
        }
    }
    return all;
}

/// Sum of the members' intensities at equal steps of the angle, as many as determine it. The sum is
/// made in parts of fixed size, so that it does not depend on the number of threads.
std::vector<double> sum_intensities(std::vector<Member> all, const Optics& optics) {
    std::sort(all.begin(), all.end(),
              [](const Member& a, const Member& b) { return a.radius > b.radius; });
    // Spheres are made again, not kept: a wide distribution has thousands, of thousands of terms.
    const auto sphere = [&](const Member& m) {
        return MieSphere(optics.wavenumber * m.radius, optics.index);
    };
    const std::size_t angles = 2 * sphere(all.front()).term_count() + 2;
    constexpr std::size_t part_count = 32;
    std::array<std::vector<double>, part_count> parts;
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t part; (part = next++) < part_count;) {
            parts[part].assign(angles, 0);
            for (std::size_t i = part; i < all.size(); i += part_count)
                sphere(all[i]).add_intensity(all[i].number, parts[part]);
        }
    };
    std::vector<std::jthread> threads(
        all.size() == 1 ? 1 : std::max(1u, std::thread::hardware_concurrency()));
    for (std::jthread& thread : threads)
        thread = std::jthread(work);
    threads.clear(); // joins
    for (std::size_t part = 1; part < part_count; ++part)
        for (std::size_t k = 0; k < angles; ++k)
            parts[0][k] += parts[part][k];
    return parts[0];
}

/// Coefficients c_j of f(theta) = sum_j c_j cos(j theta) from f at theta_k = pi (k + 1/2) / n, k <
/// n.
std::vector<double> cosine_series(const std::vector<double>& f) {
    const std::size_t n = f.size();
    std::vector<double> cosine(4 * n); // at pi i / (2 n)
    for (std::size_t i = 0; i < 4 * n; ++i)
        cosine[i] = std::cos(pi * static_cast<double>(i) / static_cast<double>(2 * n));
    std::vector<double> c(n);
    for (std::size_t j = 0; j < n; ++j) {
        double sum = 0;
        for (std::size_t k = 0, i = j; k < n; ++k, i = (i + 2 * j) % (4 * n))
            sum += f[k] * cosine[i];
        c[j] = (j == 0 ? 1.0 : 2.0) / static_cast<double>(n) * sum;
    }
    return c;
}

/// The series at the nodes of a table.
std::vector<double> at_nodes(const std::vector<double>& c, std::size_t count) {
    constexpr std::size_t block = 8; // for vectors
    std::vector<double> values(count);
    for (std::size_t first = 0; first < count; first += block) {
        std::array<double, block> turn_re, turn_im, re, im{}, sum{};
        re.fill(1);
        for (std::size_t l = 0; l < block; ++l) {
            const double theta = phase_table_angle(std::min(first + l, count - 1), count);
            turn_re[l] = std::cos(theta);
            turn_im[l] = std::sin(theta);
        }
        for (const double coefficient : c)
            for (std::size_t l = 0; l < block; ++l) {
                sum[l] += coefficient * re[l];
                const double next = re[l] * turn_re[l] - im[l] * turn_im[l];
                im[l] = re[l] * turn_im[l] + im[l] * turn_re[l];
                re[l] = next;
            }
        // Rounding leaves an error of some 1e-12 of the peak; where there is less than that, it may
        // be negative.
        for (std::size_t l = 0; l < block && first + l < count; ++l)
            values[first + l] = std::max(0.0, sum[l]);
    }
    return values;
}

struct ChannelResult {
    MieChannel channel;
    std::vector<double> series; ///< Of the intensity in the angle.
    double mean_size_parameter; ///< By scattering.
};

ChannelResult compute_channel(const MieParameters& p, const Optics& optics) {
    const std::vector<Member> all = members(p, optics);
    double number = 0, area = 0, extinction = 0, scattering = 0, forward = 0, size = 0;
    for (const Member& m : all) {
        number += m.number;
        area += m.number * pi * m.radius * m.radius;
        extinction += m.number * pi * m.radius * m.radius * m.efficiencies.extinction;
        scattering += m.scattering();
        forward += m.scattering() * m.efficiencies.asymmetry;
        size += m.scattering() * optics.wavenumber * m.radius;
    }
    return {{.size_parameter = optics.wavenumber * p.radius_um,
             .qext = extinction / area,
             .qsca = scattering / area,
             .asymmetry = forward / scattering,
             .extinction_um2 = extinction / number,
             .scattering_um2 = scattering / number},
            cosine_series(sum_intensities(all, optics)),
            size / scattering};
}

} // namespace

MieResult compute_mie(const MieParameters& parameters) {
    std::array<Optics, 3> optics;
    std::array<ChannelResult, 3> results;
    double size = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        optics[c] = optics_of(parameters, c);
        if (optics[c].index == 1.0)
            throw Error(ExitStatus::bad_input,
                        "spheres with the refractive index of the medium do not scatter");
        const auto known =
            std::find(optics.begin(), optics.begin() + static_cast<std::ptrdiff_t>(c), optics[c]);
        results[c] = known == optics.begin() + static_cast<std::ptrdiff_t>(c)
                         ? compute_channel(parameters, optics[c])
                         : results[static_cast<std::size_t>(known - optics.begin())];
        size = std::max(size, results[c].mean_size_parameter);
    }
    const std::size_t count =
        std::min<std::size_t>(32768, 512 + static_cast<std::size_t>(20 * size));
    MieResult result;
    std::array<std::vector<double>, 3> values;
    for (std::size_t c = 0; c < 3; ++c) {
        values[c] = c > 0 && optics[c] == optics[c - 1] ? values[c - 1]
                                                        : at_nodes(results[c].series, count);
        result.channels[c] = results[c].channel;
    }
    result.table = make_phase_table(std::move(values));
    return result;
}

} // namespace tyndall

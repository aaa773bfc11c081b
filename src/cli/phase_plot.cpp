#include "cli/phase_report.h"
#include "core/atomic_file.h"
#include "reference/phase.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <vector>

namespace tyndall::cli {
namespace {

using reference::pi;
using Mixture = std::vector<PhaseFunction>;

constexpr int width = 720, height = 620; // of a panel
constexpr double radius = 250;           // of the largest value
constexpr glm::dvec2 centre{width / 2.0, height / 2.0 + 20};
constexpr std::size_t bin_count = 180; // one degree each
constexpr std::uint32_t sample_count = 1u << 20;

/// Values between powers of ten, laid out on a logarithmic radius.
struct Scale {
    int first, last; ///< Powers of ten at the centre and at the rim.
    double operator()(double value) const {
        if (!(value > 0)) return 0;
        return radius * std::clamp((std::log10(value) - first) / (last - first), 0.0, 1.0);
    }
};

/// Density per steradian of the angles that the sampler draws, by bin; the heroes take turns.
std::vector<double> histogram(const Mixture& mixture) {
    std::vector<double> bins(bin_count);
    for (std::uint32_t i = 0; i < sample_count; ++i) {
        const double xi = reference::unit(reference::RandomPath{{1, 0}, 0, i}.words(1, 0).y);
        const auto angle = reference::sample_angle(mixture, xi, static_cast<int>(i % 3));
        const double theta = std::atan2(angle.sine, angle.cosine);
        ++bins[std::min(bin_count - 1, static_cast<std::size_t>(theta / pi * bin_count))];
    }
    for (std::size_t i = 0; i < bin_count; ++i) {
        const double from = pi * static_cast<double>(i) / bin_count, to = from + pi / bin_count;
        bins[i] /= sample_count * 2 * pi * (std::cos(from) - std::cos(to));
    }
    return bins;
}

/// A point at an angle from forward, which is to the right; sign -1 is below.
std::string point(double theta, double r, double sign = 1) {
    return fmt::format("{:.2f},{:.2f} ", centre.x + r * std::cos(theta),
                       centre.y - sign * r * std::sin(theta));
}

/// Circles at powers of ten, and their labels.
std::string grid(const Scale& scale) {
    std::string svg;
    const int step = std::max(1, (scale.last - scale.first) / 6);
    for (int power = scale.first; power <= scale.last; power += step) {
        const double r = scale(std::pow(10, power));
        svg += fmt::format("<circle cx='{}' cy='{}' r='{:.2f}' fill='none' stroke='#ddd'/>\n",
                           centre.x, centre.y, r);
        if (r > 0)
            svg +=
                fmt::format("<text x='{:.2f}' y='{:.2f}' fill='#888' font-size='11'>1e{}</text>\n",
                            centre.x + 2, centre.y - r - 2, power);
    }
    for (int degrees = 0; degrees < 360; degrees += 30) {
        const double theta = degrees * pi / 180;
        svg += fmt::format("<polyline points='{}{}' stroke='#ddd'/>\n", point(theta, 0),
                           point(theta, radius));
        svg += fmt::format("<text x='{:.2f}' y='{:.2f}' fill='#888' font-size='11' "
                           "text-anchor='middle'>{}°</text>\n",
                           centre.x + (radius + 18) * std::cos(theta),
                           centre.y - (radius + 18) * std::sin(theta) + 4,
                           degrees <= 180 ? degrees : 360 - degrees);
    }
    return svg;
}

std::string sectors(const std::vector<double>& bins, const Scale& scale) {
    std::string outline;
    for (const double sign : {1.0, -1.0})
        for (std::size_t n = 0; n < bin_count; ++n) {
            const std::size_t i = sign > 0 ? n : bin_count - 1 - n; // once around
            double from = pi * static_cast<double>(i) / bin_count, to = from + pi / bin_count;
            if (sign < 0) std::swap(from, to);
            outline += point(from, scale(bins[i]), sign) + point(to, scale(bins[i]), sign);
        }
    return fmt::format("<polygon points='{}' fill='#c8d8e8' stroke='#9ab' stroke-width='0.5'/>\n",
                       outline);
}

/// The function of a channel. Angles crowd towards forward, as peaks do.
std::string curve(const Mixture& mixture, int channel, const char* colour, const Scale& scale) {
    constexpr int steps = 1500;
    std::string points;
    for (int i = -steps; i <= steps; ++i) {
        const double share = std::abs(i) / double(steps);
        const double theta = pi * share * share, half_sine = std::sin(theta / 2);
        const Rgb value =
            reference::evaluate_phase(mixture, std::min(2.0, 2 * half_sine * half_sine));
        points += point(theta, scale(value[channel]), i < 0 ? -1 : 1);
    }
    return fmt::format("<polyline points='{}' fill='none' stroke='{}'/>\n", points, colour);
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return result;
}

std::string panel(const Medium& medium) {
    const Mixture& mixture = medium.phases;
    const std::vector<double> bins = histogram(mixture);
    double least = 1e300, most = 0;
    for (const double value : bins) {
        if (value > 0) least = std::min(least, value);
        most = std::max(most, value);
    }
    if (!reference::is_delta(mixture)) {
        const Rgb peak =
            glm::max(reference::evaluate_phase(mixture, 0), reference::evaluate_phase(mixture, 2));
        most = std::max({most, peak.r, peak.g, peak.b});
    }
    const int last = static_cast<int>(std::ceil(std::log10(most) - 1e-9));
    const Scale scale{std::min(last - 2, static_cast<int>(std::floor(std::log10(least)))), last};
    std::string svg = grid(scale) + sectors(bins, scale);
    const bool is_chromatic = reference::is_chromatic(mixture);
    const std::array<const char*, 3> colours{"#d22", "#292", "#22d"};
    for (int c = 0; c < (is_chromatic ? 3 : 1) && !reference::is_delta(mixture); ++c)
        svg +=
            curve(mixture, c, is_chromatic ? colours[static_cast<std::size_t>(c)] : "#000", scale);
    const Rgb g = reference::mean_cosine(mixture);
    svg += fmt::format("<text x='12' y='24' font-size='16'>{}: mean cosine {:.5f}{}</text>\n",
                       escaped(medium.name), g.r,
                       is_chromatic ? fmt::format(", {:.5f}, {:.5f}", g.g, g.b) : "");
    svg += fmt::format(
        "<text x='12' y='44' font-size='12' fill='#666'>lines: phase function [1/sr]{}; "
        "filled: {} angles drawn by the reference sampler, by degree</text>\n",
        is_chromatic ? " by channel" : "", sample_count);
    return svg;
}

} // namespace

void plot_phases(const Scene& scene, const std::string& file) {
    std::string svg =
        fmt::format("<svg xmlns='http://www.w3.org/2000/svg' width='{}' height='{}' "
                    "font-family='sans-serif'>\n<rect width='100%' height='100%' fill='#fff'/>\n",
                    width, height * std::max<std::size_t>(1, scene.media.size()));
    for (std::size_t i = 0; i < scene.media.size(); ++i) {
        svg += fmt::format("<g transform='translate(0,{})'>\n{}</g>\n",
                           static_cast<std::size_t>(height) * i, panel(scene.media[i]));
    }
    svg += "</svg>\n";
    AtomicFile output(file);
    std::fwrite(svg.data(), 1, svg.size(), output.stream());
    output.commit();
}

} // namespace tyndall::cli

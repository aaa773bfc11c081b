#include "bench/gain.h"

#include <array>
#include <cmath>
#include <limits>

namespace tyndall::bench {
namespace {

struct Cost {
    double seconds = std::numeric_limits<double>::max();
    double error = 0; ///< Square.
};

/// Renders with two seeds: half the square of the difference is that of the error of each.
void add_round(Renderer& renderer, std::uint64_t seed, std::uint32_t samples, Cost& cost) {
    std::array<Image, 2> films;
    for (std::size_t i = 0; i < 2; ++i)
        films[i] = render_timed(renderer, seed + i, samples, cost.seconds);
    for (std::size_t i = 0; i < films[0].pixels.size(); i += 6)
        for (std::size_t c = i; c < i + 3; ++c)
            cost.error += std::pow(double{films[0].pixels[c]} - films[1].pixels[c], 2) / 2;
}

} // namespace

void report_gain(benchmark::State& state, Renderer& without, Renderer& with,
                 std::uint32_t samples) {
    without.render(0, 1);
    with.render(0, 1);
    Cost before, after;
    std::uint64_t seed = 0;
    for (auto _ : state) {
        add_round(without, seed, samples, before);
        add_round(with, seed, samples, after);
        seed += 2;
    }
    const double variance = before.error / after.error, time = after.seconds / before.seconds;
    state.counters["variance"] = variance;
    state.counters["time"] = time;
    state.counters["gain"] = variance / time;
}

} // namespace tyndall::bench

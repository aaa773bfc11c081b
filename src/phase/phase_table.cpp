#include "phase/phase_table.h"

#include "core/error.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace tyndall {

using std::numbers::pi;

double phase_table_angle(std::size_t i, std::size_t n) {
    const double share = static_cast<double>(i) / static_cast<double>(n - 1);
    return pi * share * share;
}

PhaseTable make_phase_table(std::array<std::vector<double>, 3> value) {
    const std::size_t n = value[0].size();
    TYNDALL_ASSERT(n >= 2 && value[1].size() == n && value[2].size() == n);
    PhaseTable table;
    for (std::size_t i = 0; i < n; ++i) {
        const double half_sine = std::sin(phase_table_angle(i, n) / 2);
        table.complement.push_back(2 * half_sine * half_sine);
    }
    table.complement.back() = 2;
    table.value = std::move(value);
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<double>& v = table.value[c];
        std::vector<double>& cdf = table.cdf[c];
        cdf.assign(n, 0);
        double moment = 0; // 2 pi times the integral of value * (1 - mu)
        for (std::size_t i = 0; i + 1 < n; ++i) {
            const double c0 = table.complement[i], c1 = table.complement[i + 1];
            cdf[i + 1] = cdf[i] + pi * (c1 - c0) * (v[i] + v[i + 1]);
            moment += pi / 3 * (c1 - c0) * (v[i] * (2 * c0 + c1) + v[i + 1] * (c0 + 2 * c1));
        }
        const double total = cdf.back();
        for (std::size_t i = 0; i < n; ++i) {
            v[i] /= total;
            cdf[i] /= total;
        }
        cdf.back() = 1;
        table.mean_cosine[c] = 1 - moment / total;
    }
    return table;
}

} // namespace tyndall

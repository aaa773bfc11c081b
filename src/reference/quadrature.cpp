#include "reference/quadrature.h"

#include <cmath>
#include <numbers>

namespace tyndall::reference {
namespace {

/// The nodes are the zeros of the Legendre polynomial, found by Newton's method.
GaussLegendre16 make_rule() {
    constexpr int n = 16;
    GaussLegendre16 rule{};
    for (int i = 0; i < n; ++i) {
        double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
        double slope = 0;
        for (int iteration = 0; iteration < 10; ++iteration) {
            double p0 = 1, p1 = x;
            for (int k = 2; k <= n; ++k) {
                const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
                p0 = p1;
                p1 = p2;
            }
            slope = n * (x * p1 - p0) / (x * x - 1);
            x -= p1 / slope;
        }
        rule.nodes[static_cast<std::size_t>(i)] = x;
        rule.weights[static_cast<std::size_t>(i)] = 2 / ((1 - x * x) * slope * slope);
    }
    return rule;
}

} // namespace

const GaussLegendre16& gauss_legendre16() {
    static const GaussLegendre16 rule = make_rule();
    return rule;
}

} // namespace tyndall::reference

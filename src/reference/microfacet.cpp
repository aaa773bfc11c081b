#include "reference/microfacet.h"

#include <algorithm>

namespace tyndall::reference {
namespace {

double squared_sine(const dvec3& w) {
    return w.x * w.x + w.y * w.y;
}

} // namespace

double Ggx::density(const dvec3& m) const {
    const double q = squared_sine(m) / alpha + alpha * m.z * m.z;
    return 1 / (pi * q * q);
}

double Ggx::lambda(const dvec3& w) const {
    const double slope = alpha * std::sqrt(squared_sine(w)) / std::abs(w.z);
    return (std::hypot(1.0, slope) - 1) / 2;
}

double Ggx::visible_share(const dvec3& wo, const dvec3& wi) const {
    return (1 + lambda(wo)) / (1 + lambda(wo) + lambda(wi));
}

double Ggx::visible_density(const dvec3& wo, const dvec3& m) const {
    return glm::dot(wo, m) * density(m) / (wo.z * (1 + lambda(wo)));
}

dvec3 Ggx::sample_visible(const dvec3& wo, double u1, double u2) const {
    // Stretched, facets are a hemisphere, and light from wo is reflected uniformly into the cap of
    // directions with z > -wo.z: the normal is halfway between.
    const dvec3 stretched = glm::normalize(dvec3(alpha * wo.x, alpha * wo.y, wo.z));
    const double z = 1 - u2 * (1 + stretched.z);
    const double sine = std::sqrt(std::max(0.0, (1 - z) * (1 + z)));
    const double phi = 2 * pi * u1;
    const dvec3 halfway = dvec3(sine * std::cos(phi), sine * std::sin(phi), z) + stretched;
    return glm::normalize(dvec3(alpha * halfway.x, alpha * halfway.y, halfway.z));
}

} // namespace tyndall::reference

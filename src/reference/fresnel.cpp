#include "reference/fresnel.h"

#include <complex>

namespace tyndall::reference {
namespace {

/// Square of the normal component of the wave vector beyond, in units of that on this side.
double squared_normal(double eta, double cosine) {
    return (eta - 1) * (eta + 1) + cosine * cosine;
}

} // namespace

double fresnel_dielectric(double eta, double cosine) {
    if (eta == 1) return 0;
    const double squared = squared_normal(eta, cosine);
    if (squared <= 0) return 1;
    const double beyond = std::sqrt(squared); // eta cos_t
    // (c - b) / (c + b) and (eta^2 c - b) / (eta^2 c + b), both differences as quotients.
    const double difference = (eta - 1) * (eta + 1);
    const double sum_s = cosine + beyond, sum_p = eta * eta * cosine + beyond;
    const double s = difference / (sum_s * sum_s);
    const double p = difference * ((eta * eta + 1) * cosine * cosine - 1) / (sum_p * sum_p);
    return (s * s + p * p) / 2;
}

double fresnel_pane(double eta, double cosine) {
    const double face = fresnel_dielectric(eta, cosine);
    return 2 * face / (1 + face);
}

Rgb fresnel_conductor(const Rgb& eta, const Rgb& k, double cosine) {
    Rgb reflected;
    for (int c = 0; c < 3; ++c) {
        const std::complex<double> index(eta[c], k[c]), squared = index * index;
        const std::complex<double> beyond = std::sqrt(squared - 1.0 + cosine * cosine);
        const std::complex<double> s = (cosine - beyond) / (cosine + beyond);
        const std::complex<double> p = (squared * cosine - beyond) / (squared * cosine + beyond);
        reflected[c] = (std::norm(s) + std::norm(p)) / 2;
    }
    return reflected;
}

dvec3 reflect(const dvec3& w, const dvec3& normal) {
    return glm::normalize(2 * glm::dot(w, normal) * normal - w);
}

dvec3 refract(double eta, const dvec3& w, const dvec3& normal) {
    const double cosine = glm::dot(w, normal);
    const double beyond = std::sqrt(std::max(0.0, squared_normal(eta, cosine)));
    return glm::normalize((cosine - beyond) * normal - w);
}

} // namespace tyndall::reference

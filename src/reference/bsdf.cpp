#include "reference/bsdf.h"

#include "reference/fresnel.h"
#include "reference/microfacet.h"

#include <algorithm>

namespace tyndall::reference {
namespace {

/// Smoother ones are taken for mirrors and windows (pbrt's rule).
constexpr double least_roughness = 1e-3;

const dvec3 up(0, 0, 1);

} // namespace

bool is_dispersive(const Material& material) {
    const Rgb& eta = material.eta;
    const bool refracts = material.kind == Material::Kind::dielectric ||
                          material.kind == Material::Kind::thin_dielectric;
    return refracts && !(eta.x == eta.y && eta.y == eta.z);
}

Bsdf::Bsdf(const Material& material, bool from_outside, int channel)
    : material_(material), eta_(material.eta[channel]) {
    if (!from_outside && material.kind == Material::Kind::dielectric) eta_ = 1 / eta_;
}

bool Bsdf::is_delta() const {
    switch (material_.kind) {
    case Material::Kind::diffuse:
        return false;
    case Material::Kind::dielectric:
        return material_.alpha < least_roughness || material_.eta == Rgb(1);
    default:
        return material_.alpha < least_roughness;
    }
}

Response Bsdf::respond(const dvec3& wo, const dvec3& wi) const {
    const bool reflects = wi.z > 0;
    if (material_.kind == Material::Kind::diffuse) {
        const double density = std::max(0.0, wi.z) / pi;
        return {material_.reflectance * density, density};
    }
    if (wi.z == 0 || (!reflects && material_.kind == Material::Kind::conductor)) return {};
    // Walter et al. 2007, equations 13 and 16.
    dvec3 m = wo + (reflects ? 1 : eta_) * wi;
    if (m == dvec3(0)) return {};
    m = glm::normalize(m.z < 0 ? -m : m);
    const bool is_seen = glm::dot(wo, m) > 0 && glm::dot(wi, m) * wi.z > 0; // from before
    return is_seen ? respond_facet(wo, wi, m) : Response{};
}

Response Bsdf::respond_facet(const dvec3& wo, const dvec3& wi, const dvec3& m) const {
    const Ggx ggx{material_.alpha};
    const bool reflects = wi.z > 0;
    const double cos_o = glm::dot(wo, m), cos_i = glm::dot(wi, m), cosine = std::min(cos_o, 1.0);
    // Solid angle of facets per solid angle of wi (Walter et al. 2007, equations 14 and 17).
    const double root = cos_i + cos_o / eta_;
    const double jacobian = reflects ? 1 / (4 * cos_o) : -cos_i / (root * root);
    double density = ggx.visible_density(wo, m) * jacobian;
    Rgb weight(ggx.visible_share(wo, wi));
    if (material_.kind == Material::Kind::conductor) {
        weight *= fresnel_conductor(material_.eta, material_.k, cosine);
    } else {
        const double f = fresnel_dielectric(eta_, cosine);
        density *= reflects ? f : 1 - f;
        // Behind a boundary the same power fills another solid angle: radiance goes with eta^2.
        if (!reflects) weight /= eta_ * eta_;
    }
    return {density * weight, density};
}

Scattering Bsdf::sample_diffuse(const SurfaceNumbers& numbers) const {
    // Proportional to the cosine: a point of the disc, raised to the hemisphere (Malley).
    const dvec2 disk = concentric_disk(numbers.u1, numbers.u2);
    const double cosine = std::sqrt(std::max(0.0, 1 - glm::dot(disk, disk)));
    return {dvec3(disk, cosine), material_.reflectance, cosine / pi};
}

std::optional<Scattering> Bsdf::sample(const dvec3& wo, const SurfaceNumbers& numbers) const {
    using Kind = Material::Kind;
    if (material_.kind == Kind::diffuse) return sample_diffuse(numbers);
    const dvec3 m =
        is_delta() ? up : Ggx{material_.alpha}.sample_visible(wo, numbers.u1, numbers.u2);
    const double cosine = std::min(glm::dot(wo, m), 1.0);
    if (material_.kind == Kind::thin_dielectric) {
        const bool reflects = numbers.lobe < fresnel_pane(eta_, cosine);
        return Scattering{reflects ? reflect(wo, m) : -wo, Rgb(1), {}};
    }
    const bool reflects =
        material_.kind == Kind::conductor || numbers.lobe < fresnel_dielectric(eta_, cosine);
    const dvec3 wi = reflects ? reflect(wo, m) : refract(eta_, wo, m);
    if (is_delta()) {
        if (material_.kind == Kind::conductor)
            return Scattering{wi, fresnel_conductor(material_.eta, material_.k, cosine), {}};
        return Scattering{wi, Rgb(reflects ? 1 : 1 / (eta_ * eta_)), {}};
    }
    if (reflects ? !(wi.z > 0) : !(wi.z < 0)) return std::nullopt;
    const Response response = respond_facet(wo, wi, m);
    return Scattering{wi, response.value / response.density, response.density};
}

} // namespace tyndall::reference

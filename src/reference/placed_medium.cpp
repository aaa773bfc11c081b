#include "reference/placed_medium.h"

namespace tyndall::reference {
namespace {

dmat4 outer_from_local(const Medium& medium) {
    const auto* grid = std::get_if<GridDensity>(&medium.density);
    return grid ? medium.world_from_medium * glm::inverse(grid->index_from_medium)
                : medium.world_from_medium;
}

} // namespace

PlacedMedium::PlacedMedium(const Medium& m)
    : medium(m), outer_from_local(reference::outer_from_local(m)) {}

bool MediumLine::is_tracked() const {
    const auto* exponential = std::get_if<ExponentialDensity>(&medium.density);
    return exponential ? exponential->is_spherical : !medium.is_homogeneous();
}

MediumLine::MediumLine(const PlacedMedium& placed, const Placement& space, const Ray& ray)
    : medium(placed.medium), local(placed.outer_from_local.inverse_ray(space.inverse_ray(ray))) {}

ExponentialLine MediumLine::exponential(const ExponentialDensity& density) const {
    return {glm::dot(density.up, local.origin - density.origin),
            glm::dot(density.up, local.direction), density.scale_height};
}

double MediumLine::column(double t) const {
    const auto* density = std::get_if<ExponentialDensity>(&medium.density);
    return density ? exponential(*density).column(t) : t;
}

double MediumLine::distance(double length) const {
    const auto* density = std::get_if<ExponentialDensity>(&medium.density);
    return density ? exponential(*density).distance(length) : length;
}

} // namespace tyndall::reference

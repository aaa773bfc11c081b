#include "reference/march.h"

#include "reference/tracking.h"
#include "scene/emitting_voxels.h"

#include <algorithm>

namespace tyndall::reference {
namespace {

/// Density of an atmosphere beyond so many scale heights counts for nothing.
constexpr double vacuum_heights = 20;
constexpr double most_steps = 4096; // as on the device

/// The part of a line within a ball around the origin.
std::pair<double, double> chord(const Ray& ray, double radius) {
    const double a = glm::dot(ray.direction, ray.direction);
    const double nearest = -glm::dot(ray.origin, ray.direction) / a;
    const double miss = glm::length(ray.origin + nearest * ray.direction);
    if (miss >= radius) return {0, 0};
    const double half = std::sqrt((radius - miss) * (radius + miss) / a);
    return {nearest - half, nearest + half};
}

/// Where a march ends that nothing ends.
double horizon(const MediumLine& line, const ExponentialDensity* air) {
    const Rgb sigma_t = line.medium.sigma_a + line.medium.sigma_s;
    double least = std::numeric_limits<double>::infinity();
    for (int c = 0; c < 3; ++c)
        if (sigma_t[c] > 0) least = std::min(least, sigma_t[c]);
    double t = line.distance(20 / least);
    const double rise = air ? glm::dot(air->up, line.local.direction) : 0;
    if (rise > 0) t = std::min(t, vacuum_heights * air->scale_height / rise);
    return std::isfinite(t) ? t : 0;
}

/// Density at distance t, but for that of grids.
double density_at(const MediumLine& line, double t) {
    const auto* air = std::get_if<ExponentialDensity>(&line.medium.density);
    if (!air) return 1;
    const dvec3 place = line.local.origin + t * line.local.direction - air->origin;
    const double height = air->is_spherical ? std::max(0.0, glm::length(place) - air->radius)
                                            : glm::dot(air->up, place);
    return std::exp(-height / air->scale_height);
}

/// Calls visit(voxel, trilinear weight) for the eight voxels around a point.
template<class Visit>
void each_corner(const dvec3& point, Visit&& visit) {
    const dvec3 base = glm::floor(point), share = point - base;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 upper(corner & 1, corner >> 1 & 1, corner >> 2);
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis)
            weight *= upper[axis] ? share[axis] : 1 - share[axis];
        visit(glm::ivec3(base) + upper, weight);
    }
}

Rgb extinction_at(const MediumLine& line, double t) {
    const Medium& medium = line.medium;
    const auto* grid = std::get_if<GridDensity>(&medium.density);
    if (!grid) return density_at(line, t) * (medium.sigma_a + medium.sigma_s);
    Rgb sum(0);
    each_corner(line.local.origin + t * line.local.direction,
                [&](const glm::ivec3& voxel, double share) {
                    sum += share * voxel_extinction(medium, *grid, voxel);
                });
    return sum;
}

} // namespace

int MarchSteps::over(double length) const {
    if (size == 0) return count;
    return static_cast<int>(std::clamp<double>(std::ceil(length / size), 1, most_steps));
}

Steps::Steps(double begin, double end, int count) : begin_(begin), end_(end), count_(count) {}

Steps::Steps(double begin, double end, int count, double nearest, double offset)
    : begin_(begin), end_(end), count_(count), nearest_(nearest),
      offset_(std::max(offset, 1e-3 * (end - begin))),
      angle0_(std::atan((begin - nearest) / offset_)),
      angle1_(std::atan((end - nearest) / offset_)) {}

double Steps::place(double x) const {
    const double share = x / count_;
    if (offset_ == 0) return begin_ + share * (end_ - begin_);
    return nearest_ + offset_ * std::tan(angle0_ + share * (angle1_ - angle0_));
}

double Steps::weight(double t) const {
    if (offset_ == 0) return (end_ - begin_) / count_;
    const double along = t - nearest_;
    return (angle1_ - angle0_) / count_ * (offset_ * offset_ + along * along) / offset_;
}

std::pair<double, double> march_range(const MediumLine& line, double t_end) {
    if (const auto* grid = std::get_if<GridDensity>(&line.medium.density))
        return clip_to_box(line.local, grid->lower, grid->upper, t_end);
    const auto* air = std::get_if<ExponentialDensity>(&line.medium.density);
    if (!air || !air->is_spherical) return {0, std::isfinite(t_end) ? t_end : horizon(line, air)};
    const Ray from_center{line.local.origin - air->origin, line.local.direction};
    const auto [enter, leave] =
        chord(from_center, air->radius + vacuum_heights * air->scale_height);
    return {std::max(0.0, enter), std::min(t_end, leave)};
}

Matter matter_at(const MediumLine& line, double t, const EmissionWeight& weight) {
    const Medium& medium = line.medium;
    const auto* grid = std::get_if<GridDensity>(&medium.density);
    if (!grid) {
        const double density = density_at(line, t);
        const Rgb sigma_a = density * medium.sigma_a;
        return {sigma_a, density * medium.sigma_s, sigma_a * medium.emission};
    }
    Matter sum;
    each_corner(line.local.origin + t * line.local.direction,
                [&](const glm::ivec3& voxel, double share) {
                    const Rgb extinction = voxel_extinction(medium, *grid, voxel);
                    const Rgb sigma_a = voxel_absorption(medium, *grid, voxel);
                    const Rgb emission = voxel_emission(medium, *grid, voxel);
                    sum.sigma_a += share * sigma_a;
                    sum.sigma_s += share * (extinction - sigma_a);
                    if (emission != Rgb(0))
                        sum.source += share * weight(emission, extinction) * emission;
                });
    return sum;
}

Rgb march_transmittance(const MediumLine& line, double t_end, const MarchSteps& steps) {
    const auto [begin, end] = march_range(line, t_end);
    if (!(begin < end)) return Rgb(1);
    const int count = steps.over(end - begin);
    const double dt = (end - begin) / count;
    Rgb depth(0);
    for (int i = 0; i < count; ++i)
        depth += dt * extinction_at(line, begin + (i + 0.5) * dt);
    return glm::exp(-depth);
}

} // namespace tyndall::reference

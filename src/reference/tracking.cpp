#include "reference/tracking.h"

#include "reference/medium.h"
#include "scene/blackbody.h"
#include "shared/health.h"
#include "shared/random.h"

#include <algorithm>

namespace tyndall::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Scale heights beyond which the density of an atmosphere is out of range.
constexpr double vacuum_height = 745;

double largest(const Rgb& v) {
    return std::max({v.x, v.y, v.z});
}

using ChannelGrids = std::array<std::shared_ptr<const Grid>, 3>;

/// The coefficient of the medium times what the grids have at the voxel, where there are any.
Rgb scaled(Rgb coefficient, const ChannelGrids& grids, const glm::ivec3& voxel) {
    for (int c = 0; c < 3; ++c)
        if (grids[static_cast<std::size_t>(c)])
            coefficient[c] *= grids[static_cast<std::size_t>(c)]->value(voxel);
    return coefficient;
}

Rgb emission_at(const GridDensity& grid, const Rgb& coefficient, const glm::ivec3& voxel) {
    Rgb emission = scaled(coefficient, grid.emission, voxel);
    if (emission == Rgb(0)) return emission;
    if (grid.emission_scale) emission *= grid.emission_scale->value(voxel);
    if (grid.temperature) emission *= blackbody_radiance(grid.temperature->value(voxel));
    return emission;
}

} // namespace

std::pair<double, double> clip_to_box(const Ray& ray, const dvec3& lower, const dvec3& upper,
                                      double t_end) {
    double enter = 0, leave = t_end;
    for (int axis = 0; axis < 3; ++axis) {
        const double origin = ray.origin[axis], direction = ray.direction[axis];
        if (direction == 0) {
            if (origin < lower[axis] || origin > upper[axis]) return {0, 0};
            continue;
        }
        const double a = (lower[axis] - origin) / direction, b = (upper[axis] - origin) / direction;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return {enter, leave};
}

glm::ivec3 choose_corner(const dvec3& index, double u) {
    const dvec3 base = glm::floor(index);
    glm::ivec3 corner(base);
    for (int axis = 0; axis < 3; ++axis) {
        const double share = index[axis] - base[axis]; // weight of the upper voxel
        if (u < share) {
            u /= share;
            ++corner[axis];
        } else {
            u = (u - share) / (1 - share);
        }
    }
    return corner;
}

GridFlight::GridFlight(const GridDensity& grid, const Medium& medium, const Ray& local,
                       double t_end)
    : grid_(grid), medium_(medium), ray_(local),
      sigma_max_(has_channel_grids(medium) ? 1 : largest(medium.sigma_a + medium.sigma_s)) {
    std::tie(t_, t_end_) = clip_to_box(local, grid.lower, grid.upper, t_end);
    if (!(t_ < t_end_)) return;
    const MajorantGrid& m = grid.majorants;
    const dvec3 at = (ray_.origin + t_ * ray_.direction - dvec3(m.lower)) / double(m.size);
    // The box lies in the cells, up to rounding.
    cell_ = glm::clamp(glm::ivec3(glm::floor(at)), glm::ivec3(0), m.count - 1);
}

/// Where the line leaves the cell along an axis. From the index of the cell, so that no error adds
/// up.
double GridFlight::cell_exit(int axis) const {
    const double direction = ray_.direction[axis];
    if (direction == 0) return infinity;
    const MajorantGrid& m = grid_.majorants;
    const double face = m.lower[axis] + m.size * (cell_[axis] + (direction > 0 ? 1 : 0));
    return (face - ray_.origin[axis]) / direction;
}

double GridFlight::advance(double tau) {
    const MajorantGrid& m = grid_.majorants;
    while (t_ < t_end_) {
        int axis = 0;
        for (int other : {1, 2})
            if (cell_exit(other) < cell_exit(axis)) axis = other;
        const auto index = cell_.x + m.count.x * (cell_.y + std::size_t(m.count.y) * cell_.z);
        const double majorant = sigma_max_ * m.bounds[index];
        const double exit = std::max(t_, std::min(cell_exit(axis), t_end_));
        const double depth = majorant * (exit - t_);
        if (depth > tau) {
            t_ += tau / majorant;
            return majorant;
        }
        tau -= depth;
        t_ = exit;
        cell_[axis] += ray_.direction[axis] > 0 ? 1 : -1;
        if (cell_[axis] < 0 || cell_[axis] >= m.count[axis]) t_ = t_end_;
    }
    return 0;
}

TentativeCollision GridFlight::collision(double majorant, double u) const {
    const glm::ivec3 voxel = choose_corner(ray_.origin + t_ * ray_.direction, u);
    const double density = grid_.density ? grid_.density->value(voxel) : 1;
    return {t_, density / majorant * scaled(medium_.sigma_a, grid_.sigma_a, voxel),
            density / majorant * scaled(medium_.sigma_s, grid_.sigma_s, voxel),
            emission_at(grid_, medium_.emission, voxel)};
}

AtmosphereFlight::AtmosphereFlight(const ExponentialDensity& density, const Medium& medium,
                                   const Ray& local, double t_end)
    : density_(density), medium_(medium), ray_{local.origin - density.origin, local.direction},
      t_end_(t_end), speed_(glm::length(local.direction)),
      t_nearest_(-glm::dot(ray_.origin, ray_.direction) / (speed_ * speed_)),
      sigma_max_(largest(medium.sigma_a + medium.sigma_s)) {}

double AtmosphereFlight::relative_height(double t) const {
    const double height = glm::length(ray_.origin + t * ray_.direction) - density_.radius;
    return std::max(0.0, height) / density_.scale_height;
}

double AtmosphereFlight::advance(double tau) {
    while (t_ < t_end_) {
        // A scale height, or a quarter of the height: far out there is little to miss.
        const double step = density_.scale_height * std::max(1.0, relative_height(t_) / 4) / speed_;
        const double exit = std::min(t_ + step, t_end_);
        // The density is greatest where the line is nearest to the centre. The bound leaves room
        // for what float32 makes of the height, so that the device can have the same.
        const double nearest =
            glm::length(ray_.origin + std::clamp(t_nearest_, t_, exit) * ray_.direction);
        const double slack = shared::HEIGHT_ERROR * (nearest + exit * speed_);
        const double least_height =
            std::max(0.0, nearest - slack - density_.radius) / density_.scale_height;
        const double majorant = sigma_max_ * std::exp(-least_height);
        const double depth = majorant * (exit - t_);
        if (depth > tau) {
            t_ += tau / majorant;
            return majorant;
        }
        tau -= depth;
        t_ = exit;
        if (least_height > vacuum_height && t_ >= t_nearest_) t_ = t_end_;
    }
    return 0;
}

TentativeCollision AtmosphereFlight::collision(double majorant, double) const {
    const double share = std::exp(-relative_height(t_)) / majorant;
    return {t_, share * medium_.sigma_a, share * medium_.sigma_s, medium_.emission};
}

Flight::Flight(const MediumLine& line, double t_end)
    : flight_([&]() -> std::variant<GridFlight, AtmosphereFlight> {
          if (const auto* grid = std::get_if<GridDensity>(&line.medium.density))
              return GridFlight(*grid, line.medium, line.local, t_end);
          return AtmosphereFlight(std::get<ExponentialDensity>(line.medium.density), line.medium,
                                  line.local, t_end);
      }()) {}

std::optional<TentativeCollision> Flight::next(double tau, double u) {
    return std::visit(
        [&](auto& flight) -> std::optional<TentativeCollision> {
            const double majorant = flight.advance(tau);
            if (majorant == 0) return std::nullopt;
            return flight.collision(majorant, u);
        },
        flight_);
}

Rgb play_shadow_roulette(const Rgb& transmittance, double u) {
    const double most = largest(transmittance), limit = shared::SHADOW_ROULETTE;
    if (most >= limit) return transmittance;
    return u * limit < most ? transmittance * (limit / most) : Rgb(0);
}

} // namespace tyndall::reference

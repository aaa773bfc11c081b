#include "reference/lights.h"

#include "scene/light_candidates.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::reference {
namespace {

double mean(const Rgb& v) {
    return (v.x + v.y + v.z) / 3;
}

/// A place nearer than this to the surface of a ball, in radii, counts as inside: a point of the
/// ball itself must not be taken for one outside of it, whose cone is the wrong half of the
/// directions.
constexpr double ball_margin = 1e-4;

/// The cone in which a ball is seen from outside.
struct Cone {
    dvec3 axis;
    double distance;             ///< To the centre.
    double one_minus_cosine_max; ///< In (0, 1).
};

std::optional<Cone> cone_of(const Surface::Ball& ball, const dvec3& place) {
    const dvec3 to_center = ball.center - place;
    const double distance = glm::length(to_center);
    if (distance <= ball.radius * (1 + ball_margin)) return std::nullopt;
    const double sine = ball.radius / distance;
    const double cosine = std::sqrt((1 - sine) * (1 + sine));
    return Cone{to_center / distance, distance, sine * sine / (1 + cosine)};
}

double cone_density(const Cone& cone) {
    return 1 / (2 * pi * cone.one_minus_cosine_max);
}

/// A point of the ball, uniform over the solid angle of the cone.
dvec3 sample_cone(const Surface::Ball& ball, const Cone& cone, const dvec3& place, double u1,
                  double u2) {
    const double one_minus_cosine = u1 * cone.one_minus_cosine_max;
    const double sine = std::sqrt(one_minus_cosine * (2 - one_minus_cosine));
    const dvec3 direction = direction_around(cone.axis, sine, 1 - one_minus_cosine, u2);
    const double miss = cone.distance * sine; // Of the centre.
    const double inside = std::max(0.0, (ball.radius - miss) * (ball.radius + miss));
    const double t = cone.distance * (1 - one_minus_cosine) - std::sqrt(inside);
    return ball.center + ball.radius * glm::normalize(place + t * direction - ball.center);
}

/// pbrt's spot: full inside the inner cone, smoothstep of the cosine to the outer one.
double spot_falloff(const SpotLight& light, double cosine) {
    if (cosine >= light.cos_falloff_start) return 1;
    if (cosine <= light.cos_total_width) return 0;
    const double x =
        (cosine - light.cos_total_width) / (light.cos_falloff_start - light.cos_total_width);
    return x * x * (3 - 2 * x);
}

/// The solid angle that would have as much light at full intensity.
double spot_angle(const SpotLight& light) {
    return 2 * pi *
           ((1 - light.cos_falloff_start) + (light.cos_falloff_start - light.cos_total_width) / 2);
}

/// The part of [0, end] of a line that is in the cone of a spot light, its mirror image left out.
/// `from` is its origin as seen from the light.
std::pair<double, double> part_in_cone(const SpotLight& light, const dvec3& from,
                                       const dvec3& direction, double end) {
    // (x . axis)^2 >= cos^2 |x|^2 with x = from + t direction: a t^2 + 2 b t + c <= 0
    const double cos2 = light.cos_total_width * light.cos_total_width;
    const double height = glm::dot(from, light.axis), rise = glm::dot(direction, light.axis);
    const double a = cos2 - rise * rise, b = cos2 * glm::dot(from, direction) - height * rise;
    const double c = cos2 * glm::dot(from, from) - height * height;
    const double root = std::sqrt(std::max(0.0, b * b - a * c));
    const double lower = (-b - root) / a, upper = (-b + root) / a;
    if (std::abs(a) < 1e-4 * cos2) return {0, end}; // as on the device
    if (a > 0) {
        if (height - rise * b / a < 0) return {0, 0};
        return {std::max(0.0, lower), std::min(end, upper)};
    }
    // A line this steep comes in once and stays, or was in and leaves.
    if (rise > 0) return {std::max(0.0, lower), end};
    return {0, std::min(end, upper)};
}

LightSample sample_point(const dvec3& position, const dvec3& place, const Rgb& intensity) {
    const dvec3 offset = position - place;
    const double squared = glm::dot(offset, offset);
    return {intensity / squared, offset / std::sqrt(squared), position, 1, true};
}

} // namespace

Lights::Lights(const Scene& scene, const Geometry& geometry, const dvec3& camera_position)
    : scene_(scene), geometry_(geometry), camera_position_(camera_position),
      grid_emitter_(scene.media.size(), -1), first_emitter_(scene.shapes.size(), -1),
      choice_({}, {}, 1) {
    add_lights(scene);
    add_grids(scene);
    for (std::uint32_t s = 0; s < scene.shapes.size(); ++s)
        add_surface(scene, s);
    choice_ = LightChoice(powers_, reaches_, light_candidates(scene));
}

void Lights::add(Emitter emitter, double power, LightReach reach) {
    emitters_.push_back(std::move(emitter));
    powers_.push_back(power);
    reaches_.push_back(std::move(reach));
}

void Lights::add_lights(const Scene& scene) {
    // A distant light shines on the ball around the bounds of all surfaces.
    const Bounds& box = geometry_.bounds();
    // Without any, on one of radius 1, in whatever medium there is.
    const double diagonal = box.empty() ? 0 : glm::length(box.upper - box.lower);
    const double radius = diagonal > 0 ? diagonal / 2 : 1;
    for (const Light& light : scene.lights) {
        if (const auto* infinite = std::get_if<InfiniteLight>(&light.emitter)) {
            background_ += infinite->radiance;
        } else if (const auto* distant = std::get_if<DistantLight>(&light.emitter)) {
            const double disk = pi * radius * radius;
            add(*distant, mean(distant->irradiance) * disk, {1 / disk});
        } else if (const auto* point = std::get_if<PointLight>(&light.emitter)) {
            add(*point, mean(point->intensity) * 4 * pi,
                {1 / (4 * pi), point->position - camera_position_});
        } else if (const auto* spot = std::get_if<SpotLight>(&light.emitter)) {
            const double angle = spot_angle(*spot);
            add(*spot, mean(spot->intensity) * angle,
                {1 / angle, spot->position - camera_position_, 0, [spot](const dvec3& direction) {
                     return spot_falloff(*spot, -glm::dot(direction, spot->axis));
                 }});
        }
    }
}

void Lights::add_grids(const Scene& scene) {
    for (int index : emitting_grids(scene)) {
        const Medium& medium = scene.media[static_cast<std::size_t>(index)];
        std::vector<EmittingVoxel> voxels = emitting_voxels(medium);
        if (voxels.empty()) continue;
        std::vector<double> weights;
        Bounds box;
        double sum = 0;
        for (const EmittingVoxel& v : voxels) {
            weights.push_back(v.power);
            sum += v.power;
            box.extend(dvec3(v.voxel) - 0.5);
            box.extend(dvec3(v.voxel) + 0.5);
        }
        const dmat4 render_from_index =
            glm::translate(dmat4(1), -camera_position_) * medium.world_from_medium *
            glm::inverse(std::get<GridDensity>(medium.density).index_from_medium);
        const double total = sum * std::abs(glm::determinant(glm::dmat3(render_from_index)));
        double size2 = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double edge =
                (box.upper - box.lower)[axis] * glm::length(dvec3(render_from_index[axis]));
            size2 += edge * edge / 12;
        }
        const dvec3 middle(render_from_index * glm::dvec4((box.lower + box.upper) / 2.0, 1));
        grid_emitter_[static_cast<std::size_t>(index)] =
            static_cast<std::int64_t>(emitters_.size());
        add(GridEmitter{index, std::move(voxels), AliasTable(weights), total, render_from_index},
            total * 4 * pi, {1 / (4 * pi), middle, size2});
    }
}

void Lights::add_surface(const Scene& scene, std::uint32_t index) {
    const Shape& shape = scene.shapes[index];
    const Material& material = scene.materials[static_cast<std::size_t>(shape.material)];
    if (shape.area_light < 0 || material.kind == Material::Kind::interface) return;
    const AreaLight& light = scene.area_lights[static_cast<std::size_t>(shape.area_light)];
    const Surface& surface = geometry_.surfaces()[index];
    first_emitter_[index] = static_cast<std::int64_t>(emitters_.size());
    for (std::uint32_t p = 0; p < surface.primitive_count(); ++p) {
        const double area = surface.area(p);
        // pbrt's rule: "power" is that of each primitive. One without an area gives no light.
        Rgb radiance = light.radiance;
        if (area > 0) radiance += light.power_radiance / area;
        const AreaEmitter emitter{{index, p}, radiance, light.two_sided};
        add(emitter, mean(radiance) * area * pi * (light.two_sided ? 2 : 1), reach_of(emitter));
    }
}

LightReach Lights::reach_of(const AreaEmitter& light) const {
    const Surface& surface = geometry_.surfaces()[light.id.surface];
    const double sides = light.two_sided ? 2 : 1;
    const double size2 = surface.area(light.id.primitive) / (4 * pi);
    const SurfacePoint middle = surface.middle(light.id.primitive);
    // A ball is seen as a disk, a quarter of its surface.
    if (surface.is_sphere()) return {1 / (4 * sides * pi), middle.position, size2};
    // A patch, which need not be flat, is not taken to be dark in any direction.
    const double least = surface.is_patch(light.id.primitive) ? 0.1 : 0;
    return {1 / (sides * pi), middle.position, size2,
            [normal = middle.normal, least, two_sided = light.two_sided](const dvec3& direction) {
                const double cosine = -glm::dot(normal, direction);
                return glm::mix(two_sided ? std::abs(cosine) : std::max(cosine, 0.0), 1.0, least);
            }};
}

std::uint32_t Lights::area_light_index(const PrimitiveId& id) const {
    return static_cast<std::uint32_t>(first_emitter_[id.surface]) + id.primitive;
}

std::optional<LightSample> Lights::sample(const dvec3& place, const glm::uvec4& words,
                                          const glm::uvec4& voxel_words) const {
    const std::optional<LightChoice::Choice> choice = choice_.choose(place, words);
    if (!choice) return std::nullopt;
    auto sample = sample_emitter(choice->light, place, words, voxel_words);
    if (!sample) return std::nullopt;
    sample->radiance *= choice->weight;
    sample->probability *= choice_.mis_probability(choice->light);
    return sample;
}

std::optional<LightSample> Lights::sample_drawn(std::uint32_t light, const dvec3& place,
                                                const glm::uvec4& words) const {
    auto sample = sample_emitter(light, place, words, words);
    if (sample) sample->probability *= choice_.draw_probability(light);
    return sample;
}

std::optional<LightSample> Lights::sample_emitter(std::uint32_t light, const dvec3& place,
                                                  const glm::uvec4& words,
                                                  const glm::uvec4& voxel_words) const {
    const Emitter& emitter = emitters_[light];
    std::optional<LightSample> sample;
    if (const auto* distant = std::get_if<DistantLight>(&emitter)) {
        sample = LightSample{distant->irradiance, -distant->direction, std::nullopt, 1, true};
    } else if (const auto* point = std::get_if<PointLight>(&emitter)) {
        sample = sample_point(point->position - camera_position_, place, point->intensity);
    } else if (const auto* spot = std::get_if<SpotLight>(&emitter)) {
        sample = sample_point(spot->position - camera_position_, place, spot->intensity);
        sample->radiance *= spot_falloff(*spot, -glm::dot(sample->direction, spot->axis));
    } else if (const auto* grid = std::get_if<GridEmitter>(&emitter)) {
        sample = sample_grid(*grid, place, voxel_words);
    } else {
        const AreaEmitter& area = std::get<AreaEmitter>(emitter);
        sample = sample_area(area, place, unit(words.y), unit(words.z));
    }
    if (!sample || sample->radiance == Rgb(0)) return std::nullopt;
    sample->light = light;
    return sample;
}

std::optional<Steps> Lights::lit_part(std::uint32_t light, const Ray& ray, double end) const {
    const auto* point = std::get_if<PointLight>(&emitters_[light]);
    const auto* spot = std::get_if<SpotLight>(&emitters_[light]);
    if (!point && !spot) return std::nullopt;
    const dvec3 from = ray.origin + camera_position_ - (point ? point->position : spot->position);
    std::pair<double, double> part{0, end};
    if (spot && spot->cos_total_width > 0.1) part = part_in_cone(*spot, from, ray.direction, end);
    if (!(part.first < part.second)) return std::nullopt;
    const double nearest = -glm::dot(from, ray.direction);
    const double offset = glm::length(from + nearest * ray.direction);
    return Steps(part.first, part.second, 1, nearest, offset);
}

std::optional<dvec3> Lights::place(const glm::uvec4& words) const {
    const Emitter& emitter = emitters_[choice_.draw(words.x)];
    if (const auto* point = std::get_if<PointLight>(&emitter))
        return point->position - camera_position_;
    if (const auto* spot = std::get_if<SpotLight>(&emitter))
        return spot->position - camera_position_;
    const auto* area = std::get_if<AreaEmitter>(&emitter);
    if (!area) return std::nullopt;
    const Surface& surface = geometry_.surfaces()[area->id.surface];
    return surface
        .point(area->id.primitive, surface.sample(area->id.primitive, unit(words.y), unit(words.z)))
        .position;
}

/// A voxel by its emission, a place around it by its tent: together, a point by the trilinear
/// emission.
std::optional<LightSample> Lights::sample_grid(const GridEmitter& light, const dvec3& place,
                                               const glm::uvec4& words) const {
    const auto tent = [](double u) {
        return u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
    };
    const std::uint32_t low = (words.y & 255) << 16 | (words.z & 255) << 8 | (words.w & 255);
    const glm::ivec3 voxel = light.voxels[light.choice.choose(words.x, low * 0x1p-24)].voxel;
    const dvec3 index =
        dvec3(voxel) + dvec3(tent(unit(words.y)), tent(unit(words.z)), tent(unit(words.w)));
    const Medium& medium = scene_.media[static_cast<std::size_t>(light.medium)];
    const auto& grid = std::get<GridDensity>(medium.density);
    if (glm::any(glm::lessThan(index, grid.lower)) || glm::any(glm::greaterThan(index, grid.upper)))
        return std::nullopt;
    const dvec3 end(light.render_from_index * glm::dvec4(index, 1));
    const dvec3 offset = end - place;
    const double squared = glm::dot(offset, offset);
    const Rgb emission = voxel_emission(medium, grid, voxel),
              extinction = voxel_extinction(medium, grid, voxel);
    const double most = std::max({extinction.x, extinction.y, extinction.z});
    // Over the probability of the choice, this is the intensity over the squared distance.
    return LightSample{emission / most,
                       offset / std::sqrt(squared),
                       end,
                       mean(emission) / most * squared / light.total,
                       false,
                       light.medium};
}

double Lights::density(int medium, const Rgb& emission, const Rgb& extinction,
                       double squared) const {
    const std::int64_t index = grid_emitter_[static_cast<std::size_t>(medium)];
    if (index < 0) return 0;
    const auto& light = std::get<GridEmitter>(emitters_[static_cast<std::size_t>(index)]);
    return choice_.mis_probability(static_cast<std::size_t>(index)) / light.total * mean(emission) *
           squared / std::max({extinction.x, extinction.y, extinction.z});
}

std::optional<LightSample> Lights::sample_area(const AreaEmitter& light, const dvec3& place,
                                               double u1, double u2) const {
    const Surface& surface = geometry_.surfaces()[light.id.surface];
    const std::optional<Surface::Ball>& ball = surface.ball();
    const std::optional<Cone> cone = ball ? cone_of(*ball, place) : std::nullopt;
    const Parameters parameters =
        cone ? surface.parameters_of_point(sample_cone(*ball, *cone, place, u1, u2))
             : surface.sample(light.id.primitive, u1, u2);
    const SurfacePoint point = surface.point(light.id.primitive, parameters);
    const dvec3 direction = glm::normalize(point.position - place);
    const double facing = -glm::dot(point.normal, direction);
    if (facing == 0 || (facing < 0 && !light.two_sided)) return std::nullopt;
    const double density = cone ? cone_density(*cone) : area_density(light, place, point);
    return LightSample{light.radiance, direction, leave(point, -direction), density, false};
}

double Lights::area_density(const AreaEmitter& light, const dvec3& place,
                            const SurfacePoint& point) const {
    const Surface& surface = geometry_.surfaces()[light.id.surface];
    if (const std::optional<Surface::Ball>& ball = surface.ball())
        if (const std::optional<Cone> cone = cone_of(*ball, place)) return cone_density(*cone);
    const dvec3 offset = point.position - place;
    const double squared = glm::dot(offset, offset);
    const double cosine = std::abs(glm::dot(point.normal, offset)) / std::sqrt(squared);
    return squared / (cosine * point.jacobian);
}

Rgb Lights::emitted(const SurfaceHit& hit, const dvec3& ray_direction) const {
    if (hit.space != &geometry_.world_space() || first_emitter_[hit.id.surface] < 0) return Rgb(0);
    const auto& light = std::get<AreaEmitter>(emitters_[area_light_index(hit.id)]);
    const bool faces = glm::dot(hit.point.normal, ray_direction) < 0;
    return faces || light.two_sided ? light.radiance : Rgb(0);
}

double Lights::density(const dvec3& place, const SurfaceHit& hit) const {
    const std::uint32_t index = area_light_index(hit.id);
    const auto& light = std::get<AreaEmitter>(emitters_[index]);
    return choice_.mis_probability(index) * area_density(light, place, hit.point);
}

} // namespace tyndall::reference

#include "reference/walk.h"

#include "reference/path_walk.h"
#include "scene/contacts.h"

#include <algorithm>

namespace tyndall::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace

PathTracer::PathTracer(const Scene& scene, const Geometry& geometry, const Lights& lights)
    : scene_(scene), geometry_(geometry), lights_(lights),
      samples_lights_(lights.can_sample() &&
                      (scene.integrator.samples_lights ||
                       scene.integrator.kind == Integrator::Kind::singlescatter)),
      marches_(scene.integrator.kind == Integrator::Kind::singlescatter),
      is_analog_(!marches_ && scene.integrator.absorption == Integrator::Absorption::analog),
      marches_shadows_(scene.integrator.transmittance == Integrator::Transmittance::marched),
      steps_{scene.integrator.steps, scene.integrator.step_size},
      is_grey_(std::all_of(scene.media.begin(), scene.media.end(), is_grey) &&
               std::none_of(scene.materials.begin(), scene.materials.end(), is_dispersive)) {
    has_contacts_ = find_contact(scene) != nullptr;
    if (scene.integrator.kind == Integrator::Kind::path) return;
    lit_ball_ = find_lit_ball(scene);
    if (lit_ball_) lit_ball_->center -= dvec3(scene.camera.world_from_camera[3]);
    for (const Medium& medium : scene.media)
        media_.emplace_back(medium);
}

std::optional<MediumLine> PathTracer::medium_line(const Start& start) const {
    if (start.in.medium < 0 || media_.empty()) return std::nullopt;
    return MediumLine(media_[static_cast<std::size_t>(start.in.medium)], *start.in.space,
                      start.ray);
}

double PathTracer::reach_of_light(const dvec3& place, const Medium& medium) const {
    if (!lit_ball_) return 1;
    const double distance = glm::length(place - lit_ball_->center);
    if (distance <= lit_ball_->radius) return 1;
    const double share = lit_ball_->radius / distance;
    const Rgb sigma_t = medium.sigma_a + medium.sigma_s;
    const double least = std::min({sigma_t.x, sigma_t.y, sigma_t.z});
    const double seen =
        medium.is_homogeneous() ? std::exp(-least * (distance - lit_ball_->radius)) : 1;
    return share * share * seen;
}

PathTracer::Surroundings PathTracer::beyond(const SurfaceHit& hit, const dvec3& direction,
                                            const Surroundings& before) {
    const MediumInterface& media = hit.shape->media;
    if (!media.is_transition()) return before;
    const bool outside = glm::dot(direction, hit.point.normal) > 0;
    return {outside ? media.outside : media.inside, hit.space};
}

PathTracer::Start PathTracer::leave_surface(const SurfaceHit& hit, const dvec3& direction,
                                            const Surroundings& before) {
    return {{leave(hit.point, direction), direction}, beyond(hit, direction, before)};
}

bool PathTracer::is_boundary(const SurfaceHit& hit) const {
    return scene_.materials[static_cast<std::size_t>(hit.shape->material)].kind ==
           Material::Kind::interface;
}

bool PathTracer::is_crossed_first(const SurfaceHit& a, const SurfaceHit& b, const Start& start) {
    const dvec3& direction = start.ray.direction;
    const Surroundings before_a = beyond(a, -direction, start.in);
    const Surroundings before_b = beyond(b, -direction, start.in);
    if (before_a == start.in && beyond(a, direction, start.in) == before_b) return true;
    if (before_b == start.in && beyond(b, direction, start.in) == before_a) return false;
    return glm::dot(direction, b.point.normal) < 0;
}

std::optional<SurfaceHit> PathTracer::intersect(const Start& start, double t_max) const {
    const Ray& ray = start.ray;
    const std::optional<SurfaceHit> hit = geometry_.intersect(ray, t_max);
    if (!has_contacts_ || !hit || !is_boundary(*hit)) return hit;
    const double reach = shared::CONTACT_ERRORS * hit->point.error /
                         std::max(std::abs(glm::dot(ray.direction, hit->point.normal)), 0.01);
    const double near = std::max(hit->t - reach, 0.0);
    std::optional<SurfaceHit> other =
        geometry_.intersect({ray.origin + near * ray.direction, ray.direction},
                            std::min(hit->t + reach, t_max) - near, &*hit);
    if (!other) return hit;
    other->t += near;
    return is_boundary(*other) && !is_crossed_first(*hit, *other, start) ? hit : other;
}

Rgb PathTracer::visibility(Start start, const LightSample& light, const RandomPath& random,
                           std::uint32_t event, PathReport& report) const {
    std::uint32_t step = 0;
    const auto draw = [&] {
        const glm::uvec4 words = random.words(event, shared::BLOCK_SHADOW + step++);
        return std::tuple(flight_optical_depth(words.x), unit(words.y), unit(words.z));
    };
    const auto note = [&](const Rgb& extinction) { report.note_majorant(extinction); };
    Rgb result(1);
    for (std::uint32_t crossings = 0; crossings < shared::SHADOW_CROSSINGS_MAX; ++crossings) {
        double distance = infinity;
        if (light.end) {
            const dvec3 offset = *light.end - start.ray.origin;
            distance = glm::length(offset);
            if (distance == 0) return result;
            start.ray.direction = offset / distance;
        }
        const std::optional<SurfaceHit> hit = intersect(start, distance);
        if (hit && !is_boundary(*hit)) return Rgb(0);
        const double end = hit ? hit->t : distance;
        if (const auto line = medium_line(start))
            result *= !line->is_tracked() ? transmittance(line->medium, line->column(end))
                      : marches_shadows_  ? march_transmittance(*line, end, steps_)
                                          : track_transmittance(*line, end, draw, note);
        const bool is_lit =
            light.medium < 0 || hit ||
            (start.in.medium == light.medium && start.in.space == &geometry_.world_space());
        if (!is_lit) return Rgb(0);
        if (!hit || result == Rgb(0)) return result;
        start = leave_surface(*hit, start.ray.direction, start.in);
    }
    report.note(shared::HEALTH_EVENT_LIMIT, true);
    return Rgb(0);
}

Rgb PathTracer::radiance(const Ray& camera_ray, const RandomPath& random,
                         PathReport& report) const {
    return Walk(*this, camera_ray, random, report).run();
}

} // namespace tyndall::reference

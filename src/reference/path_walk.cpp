#include "reference/path_walk.h"

#include <algorithm>

namespace tyndall::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double largest(const Rgb& v) {
    return std::max({v.x, v.y, v.z});
}

Response respond(const std::vector<PhaseFunction>& phases, const Throughput& throughput,
                 const dvec3& travel, const dvec3& to_light) {
    const Rgb value = evaluate_phase(phases, one_minus_cosine(travel, to_light));
    return {value, mean_density(value, throughput)};
}

} // namespace

bool PathTracer::Walk::can_go_on() {
    const dvec3& direction = at_.ray.direction;
    const bool is_unit = std::abs(glm::dot(direction, direction) - 1) < shared::LENGTH_ERROR_MAX;
    if (is_unit && !is_over()) return true;
    report_.note(shared::HEALTH_DIRECTION, !is_unit);
    report_.note(shared::HEALTH_EVENT_LIMIT, is_over());
    if (is_over()) report_.lost = throughput_.beta;
    return end(Kind::lost);
}

bool PathTracer::Walk::step() {
    const std::optional<SurfaceHit> hit = tracer_.intersect(at_, infinity);
    if (hit) add_expected_emission(*hit);
    if (const auto line = tracer_.medium_line(at_)) {
        const double end = hit ? hit->t : infinity;
        if (tracer_.marches_ && (line->is_tracked() || is_scattering(line->medium))) {
            march(*line, end);
            return is_left() && arrive(hit);
        }
        const std::optional<Passage> passed = passage(*line, end);
        const auto collision = line->is_tracked() ? track(*line, end) : fly(*line, end);
        if ((line->is_tracked() || tracer_.is_analog_) && !is_left()) return false;
        if (collision) return collide(line->medium, *collision, passed);
        if (passed) look_in_passing(*passed);
    }
    return arrive(hit);
}

bool PathTracer::Walk::arrive(const std::optional<SurfaceHit>& hit) {
    if (!hit) {
        contribute(throughput_.beta * tracer_.lights_.background());
        log(Kind::escape, at_.ray.origin);
        return false;
    }
    return meet(*hit);
}

bool PathTracer::Walk::collide(const Medium& medium, double distance,
                               const std::optional<Passage>& passage) {
    at_.ray.origin += distance * at_.ray.direction;
    log(Kind::collision, at_.ray.origin);
    if (!may_scatter()) return false;
    const std::vector<PhaseFunction>& phases = medium.phases;
    const dvec3 travel = at_.ray.direction;
    const ScatteringAngle angle = sample_angle(phases, unit(words_.y), throughput_.hero);
    note_cosine(angle.cosine);
    vertex_.reset();
    if (!is_delta(phases)) {
        sample_light(
            at_.ray.origin,
            [&](const dvec3& to_light) { return respond(phases, throughput_, travel, to_light); },
            [&](const dvec3& to_light) {
                return Start{{at_.ray.origin, to_light}, at_.in};
            },
            [&](std::uint32_t light) {
                return passage ? collision_weight(*passage, light, distance) : 1;
            });
        const Rgb value = evaluate_phase(phases, angle.one_minus_cosine);
        remember(at_.ray.origin, mean_density(value, throughput_));
        throughput_ = after_scattering(value, throughput_);
    }
    at_.ray.direction = direction_around(travel, angle.sine, angle.cosine, unit(words_.z));
    return survive(tracer_.reach_of_light(at_.ray.origin, medium));
}

Rgb PathTracer::Walk::weighted_emission(const SurfaceHit& hit) const {
    const Rgb emitted = tracer_.lights_.emitted(hit, at_.ray.direction);
    return emitted == Rgb(0) ? emitted : throughput_.beta * emitted * hit_weight(hit);
}

void PathTracer::Walk::add_expected_emission(const SurfaceHit& hit) {
    const auto line = tracer_.medium_line(at_);
    if (line && line->is_tracked()) return;
    const Rgb seen = line ? transmittance(line->medium, line->column(hit.t)) : Rgb(1);
    contribute(seen * weighted_emission(hit));
}

bool PathTracer::Walk::meet(const SurfaceHit& hit) {
    const auto line = tracer_.medium_line(at_);
    if (line && line->is_tracked()) contribute(weighted_emission(hit));
    const Material& material =
        tracer_.scene_.materials[static_cast<std::size_t>(hit.shape->material)];
    const bool is_interface = material.kind == Material::Kind::interface;
    log(is_interface ? Kind::interface : Kind::surface, hit.point.position, hit.shape);
    if (is_interface) {
        at_ = leave_surface(hit, at_.ray.direction, at_.in);
        return true;
    }
    return scatter(hit, material);
}

bool PathTracer::Walk::scatter(const SurfaceHit& hit, const Material& material) {
    if (!may_scatter()) return false;
    if (is_dispersive(material)) throughput_ = disperse(throughput_);
    dmat3 frame = frame_around(hit.point.shading_normal);
    const double side = -glm::dot(hit.point.shading_normal, at_.ray.direction);
    note_cosine(side);
    if (side == 0) return end(Kind::absorbed);
    if (side < 0) frame[2] = -frame[2];
    const dvec3 wo = glm::transpose(frame) * -at_.ray.direction;
    const Bsdf bsdf(material, side > 0, throughput_.hero);
    if (!bsdf.is_delta()) {
        sample_light(
            hit.point.position,
            [&](const dvec3& to_light) {
                return bsdf.respond(wo, glm::transpose(frame) * to_light);
            },
            [&](const dvec3& to_light) { return leave_surface(hit, to_light, at_.in); },
            [](std::uint32_t) { return 1; });
    }
    const double lobe = unit(random_.words(event_, shared::BLOCK_LIGHT).w);
    const auto scattering = bsdf.sample(wo, {unit(words_.y), unit(words_.z), lobe});
    if (!scattering) return end(Kind::absorbed);
    vertex_.reset();
    if (scattering->density) remember(hit.point.position, *scattering->density);
    throughput_.beta *= scattering->weight;
    at_ = leave_surface(hit, glm::normalize(frame * scattering->direction), at_.in);
    return survive(1);
}

double PathTracer::Walk::hit_weight(const SurfaceHit& hit) const {
    if (!vertex_) return 1;
    return mis_weight(vertex_->density, tracer_.lights_.density(vertex_->place, hit));
}

double PathTracer::Walk::emission_weight(double t, const Rgb& emission,
                                         const Rgb& extinction) const {
    if (!vertex_ || at_.in.space != &tracer_.geometry_.world_space()) return 1;
    const dvec3 offset = at_.ray.origin + t * at_.ray.direction - vertex_->place;
    const double density =
        tracer_.lights_.density(at_.in.medium, emission, extinction, glm::dot(offset, offset));
    return mis_weight(vertex_->density, density);
}

void PathTracer::Walk::log(PathEvent::Kind kind, const dvec3& place, const Shape* shape) {
    if (!report_.replay) return;
    report_.tell({kind, event_, tracer_.world_point(place), at_.ray.direction,
                  tracer_.medium_index(at_), throughput_.beta, radiance_, shape});
}

void PathTracer::Walk::log_light(const Start& shadow, const Rgb& added) {
    if (!report_.replay) return;
    report_.tell({Kind::light, event_, tracer_.world_point(shadow.ray.origin), shadow.ray.direction,
                  tracer_.medium_index(shadow), added, radiance_});
}

bool PathTracer::Walk::survive(double reach) {
    const double weight = largest(throughput_.beta);
    const double scale = tracer_.lights_.background() == Rgb(0)
                             ? shared::ROULETTE_SCALE
                             : shared::ROULETTE_SCALE_IN_ENVIRONMENT;
    const double chance = std::max(scale * weight * reach, 0.25);
    report_.note(shared::HEALTH_WEIGHT, weight * reach > shared::WEIGHT_MAX);
    if (weight == 0) return end(Kind::absorbed);
    if (chance >= 1) return true;
    if (unit(words_.w) >= chance) return end(Kind::roulette);
    throughput_.beta /= chance;
    return true;
}

} // namespace tyndall::reference

#include "reference/walk.h"

#include "reference/phase.h"

#include <algorithm>

namespace tyndall::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double roulette_threshold = 1.0 / 16;

double largest(const Rgb& v) {
    return std::max({v.x, v.y, v.z});
}

/// The power heuristic with exponent 2 (Veach 1997, section 9.2.4), without overflow.
double mis_weight(double density, double other_density) {
    const double ratio = other_density / density;
    return 1 / (1 + ratio * ratio);
}

/// What a scattering event does with light from one direction.
struct Response {
    Rgb value{0};       ///< Phase function, or BSDF times cosine.
    double density = 0; ///< With which the event itself draws that direction, per solid angle.
};

Response respond(const PhaseFunction& phase, const dvec3& travel, const dvec3& to_light) {
    const double density = evaluate_phase(phase, one_minus_cosine(travel, to_light));
    return {Rgb(density), density};
}

/// pbrt's DiffuseBxDF: reflects on the side of the shading normal that the path came from.
Response respond(const Material& material, const dvec3& normal, const dvec3& travel,
                 const dvec3& to_light) {
    const double cosine_out = -glm::dot(normal, travel);
    const double cosine_in = glm::dot(normal, to_light);
    if (!(cosine_out * cosine_in > 0)) return {};
    const double density = std::abs(cosine_in) / pi;
    return {material.reflectance * density, density};
}

} // namespace

PathTracer::PathTracer(const Scene& scene, const Geometry& geometry, const Lights& lights)
    : scene_(scene), geometry_(geometry), lights_(lights),
      has_media_(scene.integrator.kind == Integrator::Kind::volpath),
      is_grey_(std::all_of(scene.media.begin(), scene.media.end(), is_grey)) {}

const Medium* PathTracer::medium(int index) const {
    if (index < 0 || !has_media_) return nullptr;
    return &scene_.media[static_cast<std::size_t>(index)];
}

PathTracer::Start PathTracer::leave_surface(const SurfaceHit& hit, const dvec3& direction,
                                            int medium_before) const {
    const MediumInterface& media = hit.shape->media;
    const bool outside = glm::dot(direction, hit.point.normal) > 0;
    const int beyond = outside ? media.outside : media.inside;
    return {{leave(hit.point, direction), direction},
            media.is_transition() ? beyond : medium_before};
}

Rgb PathTracer::visibility(Start start, const LightSample& light) const {
    Rgb result(1);
    while (true) {
        double distance = infinity;
        if (light.end) {
            const dvec3 offset = *light.end - start.ray.origin;
            distance = glm::length(offset);
            if (distance == 0) return result;
            start.ray.direction = offset / distance;
        }
        const std::optional<SurfaceHit> hit = geometry_.intersect(start.ray, distance);
        if (const Medium* inside = medium(start.medium))
            result *= transmittance(*inside, hit ? hit->t : distance);
        if (!hit || result == Rgb(0)) return result;
        const Material& material = scene_.materials[static_cast<std::size_t>(hit->shape->material)];
        if (material.kind != Material::Kind::interface) return Rgb(0);
        start = leave_surface(*hit, start.ray.direction, start.medium);
    }
}

/// The state of one path.
class PathTracer::Walk {
  public:
    Walk(const PathTracer& tracer, const Ray& ray, const RandomPath& random)
        : tracer_(tracer), random_(random), at_{ray, tracer.scene_.camera.medium} {
        if (!tracer_.is_grey_)
            throughput_.hero = choose_hero(unit(random_.words(0, shared::BLOCK_LIGHT).x));
    }

    Rgb run() {
        do {
            ++event_;
            words_ = random_.words(event_, shared::BLOCK_PATH);
        } while (step());
        return radiance_;
    }

  private:
    /// One segment and what happens at its end. Returns whether the path goes on.
    bool step() {
        const std::optional<SurfaceHit> hit = tracer_.geometry_.intersect(at_.ray, infinity);
        const double surface_distance = hit ? hit->t : infinity;
        if (const Medium* medium = tracer_.medium(at_.medium)) {
            const double flight = flight_distance(*medium, throughput_.hero, words_.x);
            const bool collision = flight < surface_distance;
            const Segment segment{std::min(flight, surface_distance), collision};
            radiance_ += emitted_radiance(*medium, throughput_, segment);
            throughput_ = after_segment(*medium, throughput_, segment);
            if (collision) return collide(*medium, flight);
        }
        if (!hit) {
            radiance_ += throughput_.beta * tracer_.lights_.background();
            return false;
        }
        return meet(*hit);
    }

    bool collide(const Medium& medium, double distance) {
        if (depth_ == tracer_.scene_.integrator.max_depth) return false;
        ++depth_;
        at_.ray.origin += distance * at_.ray.direction;
        const PhaseFunction& phase = medium.phases.front();
        const dvec3 travel = at_.ray.direction;
        const ScatteringAngle angle = sample_angle(phase, unit(words_.y));
        vertex_.reset();
        if (!is_delta(phase)) {
            sample_light(
                at_.ray.origin,
                [&](const dvec3& to_light) { return respond(phase, travel, to_light); },
                [&](const dvec3& to_light) {
                    return Start{{at_.ray.origin, to_light}, at_.medium};
                });
            vertex_ = {at_.ray.origin, evaluate_phase(phase, angle.one_minus_cosine)};
        }
        at_.ray.direction = direction_around(travel, angle.sine, angle.cosine, unit(words_.z));
        return survive();
    }

    bool meet(const SurfaceHit& hit) {
        const Rgb emitted = tracer_.lights_.emitted(hit, at_.ray.direction);
        if (emitted != Rgb(0)) radiance_ += throughput_.beta * emitted * hit_weight(hit);
        const Material& material =
            tracer_.scene_.materials[static_cast<std::size_t>(hit.shape->material)];
        if (material.kind == Material::Kind::interface) {
            at_ = tracer_.leave_surface(hit, at_.ray.direction, at_.medium);
            return true;
        }
        return reflect(hit, material);
    }

    bool reflect(const SurfaceHit& hit, const Material& material) {
        if (depth_ == tracer_.scene_.integrator.max_depth) return false;
        ++depth_;
        const dvec3 travel = at_.ray.direction;
        const dvec3& normal = hit.point.shading_normal;
        const double side = -glm::dot(normal, travel);
        if (side == 0) return false;
        sample_light(
            hit.point.position,
            [&](const dvec3& to_light) { return respond(material, normal, travel, to_light); },
            [&](const dvec3& to_light) {
                return tracer_.leave_surface(hit, to_light, at_.medium);
            });
        // Proportional to the cosine: a point of the disc, raised to the hemisphere (Malley).
        const dvec2 disk = concentric_disk(unit(words_.y), unit(words_.z));
        const double cosine = std::sqrt(std::max(0.0, 1 - glm::dot(disk, disk)));
        const dvec3 local(disk, std::copysign(cosine, side));
        const dvec3 direction = glm::normalize(around(normal, local));
        vertex_ = {hit.point.position, cosine / pi};
        throughput_.beta *= material.reflectance;
        at_ = tracer_.leave_surface(hit, direction, at_.medium);
        return survive();
    }

    /// Direct light at a scattering event: respond(to_light) is its Response, start(to_light) the
    /// Start of the shadow ray.
    template<class Respond, class Leave>
    void sample_light(const dvec3& place, Respond&& respond_to, Leave&& start) {
        if (!tracer_.lights_.can_sample()) return;
        const auto light =
            tracer_.lights_.sample(place, random_.words(event_, shared::BLOCK_LIGHT));
        if (!light) return;
        const Response response = respond_to(light->direction);
        if (response.value == Rgb(0)) return;
        const double weight =
            light->is_delta ? 1 : mis_weight(light->probability, response.density);
        radiance_ += throughput_.beta * response.value * light->radiance *
                     tracer_.visibility(start(light->direction), *light) *
                     (weight / light->probability);
    }

    /// MIS weight of emission that the path ran into.
    double hit_weight(const SurfaceHit& hit) const {
        if (!vertex_ || !tracer_.lights_.can_sample()) return 1;
        return mis_weight(vertex_->density, tracer_.lights_.density(vertex_->place, hit));
    }

    /// Russian roulette, late and with the same odds for all paths.
    bool survive() {
        const double weight = largest(throughput_.beta);
        if (weight == 0) return false;
        if (weight >= roulette_threshold) return true;
        throughput_.beta *= 2.0;
        return unit(words_.w) >= 0.5;
    }

    /// The last scattering event, if lights were sampled there.
    struct Vertex {
        dvec3 place;
        double density; ///< Of the direction that was taken.
    };

    const PathTracer& tracer_;
    const RandomPath& random_;
    Start at_;
    Throughput throughput_;
    Rgb radiance_{0};
    std::optional<Vertex> vertex_;
    int depth_ = 0;
    std::uint32_t event_ = 0;
    glm::uvec4 words_{0};
};

Rgb PathTracer::radiance(const Ray& camera_ray, const RandomPath& random) const {
    return Walk(*this, camera_ray, random).run();
}

} // namespace tyndall::reference

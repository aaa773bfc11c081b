#include "reference/walk.h"

#include "reference/bsdf.h"
#include "reference/march.h"
#include "reference/phase.h"
#include "reference/tracking.h"

#include <algorithm>

namespace tyndall::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double largest(const Rgb& v) {
    return std::max({v.x, v.y, v.z});
}

/// The power heuristic with exponent 2 (Veach 1997, section 9.2.4), without overflow.
double mis_weight(double density, double other_density) {
    const double ratio = other_density / density;
    return 1 / (1 + ratio * ratio);
}

Response respond(const std::vector<PhaseFunction>& phases, const Throughput& throughput,
                 const dvec3& travel, const dvec3& to_light) {
    const Rgb value = evaluate_phase(phases, one_minus_cosine(travel, to_light));
    return {value, mean_density(value, throughput)};
}

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

PathTracer::Start PathTracer::leave_surface(const SurfaceHit& hit, const dvec3& direction,
                                            const Surroundings& before) {
    const MediumInterface& media = hit.shape->media;
    const bool outside = glm::dot(direction, hit.point.normal) > 0;
    const Surroundings beyond{outside ? media.outside : media.inside, hit.space};
    return {{leave(hit.point, direction), direction}, media.is_transition() ? beyond : before};
}

Rgb PathTracer::visibility(Start start, const LightSample& light, const RandomPath& random,
                           std::uint32_t event, PathReport& report) const {
    std::uint32_t step = 0;
    const auto draw = [&] {
        const glm::uvec4 words = random.words(event, shared::BLOCK_SHADOW + step++);
        return std::pair(flight_optical_depth(words.x), unit(words.y));
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
        const std::optional<SurfaceHit> hit = geometry_.intersect(start.ray, distance);
        const Material* material =
            hit ? &scene_.materials[static_cast<std::size_t>(hit->shape->material)] : nullptr;
        if (material && material->kind != Material::Kind::interface) return Rgb(0);
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

/// The state of one path.
class PathTracer::Walk {
  public:
    Walk(const PathTracer& tracer, const Ray& ray, const RandomPath& random, PathReport& report)
        : tracer_(tracer), random_(random),
          report_(report), at_{ray,
                               {tracer.scene_.camera.medium, &tracer.geometry_.world_space()}} {
        if (!tracer_.is_grey_)
            throughput_.hero = choose_hero(unit(random_.words(0, shared::BLOCK_LIGHT).x));
    }

    Rgb run() {
        log(Kind::camera, at_.ray.origin);
        do {
            next_event();
        } while (can_go_on() && step());
        return radiance_;
    }

  private:
    using Kind = PathEvent::Kind;

    void next_event() {
        ++event_;
        words_ = random_.words(event_, shared::BLOCK_PATH);
    }

    bool is_over() const { return event_ >= tracer_.scene_.integrator.event_limit; }

    /// The path has a direction, and events left.
    bool can_go_on() {
        const dvec3& direction = at_.ray.direction;
        const bool is_unit =
            std::abs(glm::dot(direction, direction) - 1) < shared::LENGTH_ERROR_MAX;
        if (is_unit && !is_over()) return true;
        report_.note(shared::HEALTH_DIRECTION, !is_unit);
        report_.note(shared::HEALTH_EVENT_LIMIT, is_over());
        if (is_over()) report_.lost = throughput_.beta;
        return end(Kind::lost);
    }

    /// After tracking: there is something left of the path.
    bool is_left() { return throughput_.beta == Rgb(0) ? end(Kind::absorbed) : can_go_on(); }

    /// Counts a scattering event; false if the path has had its share.
    bool may_scatter() {
        if (depth_ == tracer_.scene_.integrator.max_depth) return end(Kind::depth_limit);
        ++depth_;
        return true;
    }

    /// One segment and what happens at its end. Returns whether the path goes on.
    bool step() {
        const std::optional<SurfaceHit> hit = tracer_.geometry_.intersect(at_.ray, infinity);
        if (hit) add_expected_emission(*hit);
        if (const auto line = tracer_.medium_line(at_)) {
            const double end = hit ? hit->t : infinity;
            if (tracer_.marches_ && (line->is_tracked() || is_scattering(line->medium))) {
                march(*line, end);
                return is_left() && arrive(hit);
            }
            const auto collision = line->is_tracked() ? track(*line, end) : fly(*line, end);
            if ((line->is_tracked() || tracer_.is_analog_) && !is_left()) return false;
            if (collision) return collide(line->medium, *collision);
        }
        return arrive(hit);
    }

    bool arrive(const std::optional<SurfaceHit>& hit) {
        if (!hit) {
            contribute(throughput_.beta * tracer_.lights_.background());
            log(Kind::escape, at_.ray.origin);
            return false;
        }
        return meet(*hit);
    }

    /// All that the path contributes comes through here.
    void contribute(const Rgb& light) { radiance_ += light; }

    /// A flight in closed form, to the distance of a collision that scatters, if that is before the
    /// end.
    std::optional<double> fly(const MediumLine& line, double end) {
        if (tracer_.is_analog_) return fly_analog(line, end);
        const Medium& medium = line.medium;
        const double column = flight_distance(medium, throughput_.hero, words_.x);
        const double distance = line.distance(column);
        const bool collision = distance < end;
        const Segment segment{collision ? column : line.column(end), collision};
        contribute(emitted_radiance(medium, throughput_, segment));
        throughput_ = after_segment(medium, throughput_, segment);
        return collision ? std::optional(distance) : std::nullopt;
    }

    /// The same where absorption ends paths, and what is absorbed has met emission.
    std::optional<double> fly_analog(const MediumLine& line, double end) {
        const Medium& medium = line.medium;
        const int hero = throughput_.hero;
        const double column = analog_flight_distance(medium, hero, words_.x);
        const double distance = line.distance(column);
        if (!(distance < end)) {
            throughput_ =
                after_analog_flight(medium, throughput_, line.column(end), AnalogEnd::passed);
            return std::nullopt;
        }
        const double u = unit(random_.words(event_, shared::BLOCK_LIGHT).w);
        const bool is_scattered =
            u * (medium.sigma_s[hero] + medium.sigma_a[hero]) < medium.sigma_s[hero];
        throughput_ = after_analog_flight(
            medium, throughput_, column, is_scattered ? AnalogEnd::scattered : AnalogEnd::absorbed);
        if (is_scattered) return distance;
        end_by_absorption(medium.emission);
        return std::nullopt;
    }

    void end_by_absorption(const Rgb& emission) {
        contribute(throughput_.beta * emission);
        throughput_.beta = Rgb(0);
    }

    /// A flight by tracking. Each tentative collision is an event; a real one scatters in the next.
    std::optional<double> track(const MediumLine& line, double end) {
        Flight flight(line, end);
        while (const auto at = flight.next(flight_optical_depth(words_.x), unit(words_.y))) {
            report_.note_majorant(at->absorbed + at->scattered);
            const bool is_real = tracer_.is_analog_ ? meet_analog(*at) : meet(*at);
            next_event();
            if (is_real) return at->t;
            if (throughput_.beta == Rgb(0) || is_over()) break;
        }
        return std::nullopt;
    }

    /// A tentative collision; returns whether it scatters.
    bool meet(const TentativeCollision& at) {
        const Rgb emission = at.absorbed * at.emission;
        if (emission != Rgb(0))
            contribute(throughput_.beta * emission *
                       emission_weight(at.t, emission, at.absorbed + at.scattered));
        const bool is_real = unit(words_.z) < at.scattered[throughput_.hero];
        throughput_ = after_collision(at.absorbed, at.scattered, throughput_, is_real);
        if (!is_real) log(Kind::null_collision, at_.ray.origin + at.t * at_.ray.direction);
        return is_real;
    }

    bool meet_analog(const TentativeCollision& at) {
        const int hero = throughput_.hero;
        const double u = unit(words_.z);
        const bool is_real = u < at.scattered[hero];
        const bool is_absorbed = !is_real && u < at.scattered[hero] + at.absorbed[hero];
        const Rgb nothing = glm::max(1.0 - at.scattered - at.absorbed, 0.0);
        const double weight = is_absorbed ? emission_weight(at.t, at.absorbed * at.emission,
                                                            at.absorbed + at.scattered)
                                          : 0;
        throughput_ = after_event(is_real       ? at.scattered
                                  : is_absorbed ? at.absorbed
                                                : nothing,
                                  throughput_);
        if (is_absorbed)
            end_by_absorption(weight * at.emission);
        else if (!is_real)
            log(Kind::null_collision, at_.ray.origin + at.t * at_.ray.direction);
        return is_real;
    }

    /// Marching: emission and light that the medium scatters once, at one place in each step, which
    /// is an event. Transmittance is the product over the steps, or in closed form where flights
    /// are.
    void march(const MediumLine& line, double t_end) {
        const auto [begin, end] = march_range(line, t_end);
        const glm::uvec4 first_words = random_.words(event_, shared::BLOCK_LIGHT);
        const Steps steps = plan(begin, end, first_words);
        const bool scatters = depth_ < tracer_.scene_.integrator.max_depth;
        const bool is_incremental = line.is_tracked();
        Rgb depth(0);
        for (int i = 0; i < steps.count(); ++i, next_event()) {
            const double step_begin = steps.place(i);
            const double t = steps.place(
                i + (tracer_.placement() == Integrator::Placement::uniform ? 0.5 : unit(words_.x)));
            const Matter m = matter_at(line, t, [&](const Rgb& emission, const Rgb& extinction) {
                return emission_weight(t, emission, extinction);
            });
            const Rgb extinction = m.sigma_a + m.sigma_s;
            const Rgb reached = is_incremental ? glm::exp(-(depth + (t - step_begin) * extinction))
                                               : transmittance(line.medium, line.column(t));
            const Rgb weight = throughput_.beta * reached * steps.weight(t);
            contribute(weight * m.source);
            if (scatters && m.sigma_s != Rgb(0))
                scatter_once(line.medium, weight * m.sigma_s, t, first_words);
            depth += (steps.place(i + 1) - step_begin) * extinction;
        }
        throughput_.beta *=
            is_incremental ? glm::exp(-depth) : transmittance(line.medium, line.column(t_end));
    }

    bool asks_environment(const glm::uvec4& words) const {
        return tracer_.lights_.background() != Rgb(0) &&
               (!tracer_.samples_lights_ || unit(words.w) < 0.5);
    }

    Steps plan(double begin, double end, const glm::uvec4& words) const {
        const int count = begin < end ? tracer_.steps_.over(end - begin) : 0;
        if (tracer_.placement() == Integrator::Placement::equiangular && tracer_.samples_lights_ &&
            !asks_environment(words)) {
            if (const auto place = tracer_.lights_.place(words)) {
                const dvec3 to = *place - at_.ray.origin;
                const double nearest = glm::dot(to, at_.ray.direction);
                return {begin, end, count, nearest, glm::length(to - nearest * at_.ray.direction)};
            }
        }
        return {begin, end, count};
    }

    /// Light from one direction that is scattered at distance t.
    void scatter_once(const Medium& medium, const Rgb& weight, double t,
                      const glm::uvec4& first_words) {
        glm::uvec4 words = random_.words(event_, shared::BLOCK_LIGHT);
        if (tracer_.placement() == Integrator::Placement::equiangular)
            words.x = first_words.x, words.w = first_words.w;
        const dvec3 place = at_.ray.origin + t * at_.ray.direction;
        const Rgb background = tracer_.lights_.background();
        const double choices = background != Rgb(0) && tracer_.samples_lights_ ? 2 : 1;
        if (asks_environment(words)) {
            const ScatteringAngle angle =
                sample_angle(medium.phases, unit(words_.y), throughput_.hero);
            LightSample sky{
                background,
                direction_around(at_.ray.direction, angle.sine, angle.cosine, unit(words_.z)),
                std::nullopt, 1, true};
            if (!is_delta(medium.phases)) {
                const Rgb value = evaluate_phase(medium.phases, angle.one_minus_cosine);
                sky.radiance *= value / mean_density(value, throughput_);
            }
            add_scattered(sky, place, choices * weight);
        } else if (tracer_.samples_lights_ && !is_delta(medium.phases)) {
            const auto light =
                tracer_.lights_.sample(place, words, random_.words(event_, shared::BLOCK_EMISSION));
            if (!light) return;
            const Rgb value = evaluate_phase(medium.phases,
                                             one_minus_cosine(at_.ray.direction, light->direction));
            add_scattered(*light, place, choices / light->probability * weight * value);
        }
    }

    void add_scattered(const LightSample& light, const dvec3& place, const Rgb& weight) {
        const Rgb unoccluded = weight * light.radiance;
        if (unoccluded == Rgb(0)) return;
        const Start start{{place, light.direction}, at_.in};
        const Rgb added = unoccluded * tracer_.visibility(start, light, random_, event_, report_);
        contribute(added);
        log_light(start, added);
    }

    bool collide(const Medium& medium, double distance) {
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
                [&](const dvec3& to_light) {
                    return respond(phases, throughput_, travel, to_light);
                },
                [&](const dvec3& to_light) {
                    return Start{{at_.ray.origin, to_light}, at_.in};
                });
            const Rgb value = evaluate_phase(phases, angle.one_minus_cosine);
            remember(at_.ray.origin, mean_density(value, throughput_));
            throughput_ = after_scattering(value, throughput_);
        }
        at_.ray.direction = direction_around(travel, angle.sine, angle.cosine, unit(words_.z));
        return survive(tracer_.reach_of_light(at_.ray.origin, medium));
    }

    Rgb weighted_emission(const SurfaceHit& hit) const {
        const Rgb emitted = tracer_.lights_.emitted(hit, at_.ray.direction);
        return emitted == Rgb(0) ? emitted : throughput_.beta * emitted * hit_weight(hit);
    }

    /// Emission at the end of the segment, times the chance of getting there where that has a
    /// closed form; elsewhere the paths that get there count (meet).
    void add_expected_emission(const SurfaceHit& hit) {
        const auto line = tracer_.medium_line(at_);
        if (line && line->is_tracked()) return;
        const Rgb seen = line ? transmittance(line->medium, line->column(hit.t)) : Rgb(1);
        contribute(seen * weighted_emission(hit));
    }

    bool meet(const SurfaceHit& hit) {
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

    bool scatter(const SurfaceHit& hit, const Material& material) {
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
                [&](const dvec3& to_light) { return leave_surface(hit, to_light, at_.in); });
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

    /// Direct light at a scattering event: respond(to_light) is its Response, start(to_light) the
    /// Start of the shadow ray.
    template<class Respond, class Leave>
    void sample_light(const dvec3& place, Respond&& respond_to, Leave&& start) {
        if (!tracer_.samples_lights_) return;
        const auto light = tracer_.lights_.sample(place, random_.words(event_, shared::BLOCK_LIGHT),
                                                  random_.words(event_, shared::BLOCK_EMISSION));
        if (!light) return;
        const Response response = respond_to(light->direction);
        if (response.value == Rgb(0)) return;
        const double weight =
            light->is_delta ? 1 : mis_weight(light->probability, response.density);
        const Rgb unoccluded =
            throughput_.beta * response.value * light->radiance * (weight / light->probability);
        if (unoccluded == Rgb(0)) return;
        const Start shadow = start(light->direction);
        const Rgb added = unoccluded * tracer_.visibility(shadow, *light, random_, event_, report_);
        contribute(added);
        log_light(shadow, added);
    }

    /// MIS weight of emission that the path ran into.
    double hit_weight(const SurfaceHit& hit) const {
        if (!vertex_) return 1;
        return mis_weight(vertex_->density, tracer_.lights_.density(vertex_->place, hit));
    }

    /// MIS weight of emission that the path came upon at distance t; both in the same unit.
    double emission_weight(double t, const Rgb& emission, const Rgb& extinction) const {
        if (!vertex_ || at_.in.space != &tracer_.geometry_.world_space()) return 1;
        const dvec3 offset = at_.ray.origin + t * at_.ray.direction - vertex_->place;
        const double density =
            tracer_.lights_.density(at_.in.medium, emission, extinction, glm::dot(offset, offset));
        return mis_weight(vertex_->density, density);
    }

    /// Keeps the scattering event, if lights were sampled there.
    void remember(const dvec3& place, double density) {
        if (tracer_.samples_lights_) vertex_ = {place, density};
    }

    /// Tells of the path on arrival at a place (render space).
    void log(PathEvent::Kind kind, const dvec3& place, const Shape* shape = nullptr) {
        if (!report_.events) return;
        report_.events->push_back({kind, event_, tracer_.world_point(place), at_.ray.direction,
                                   tracer_.medium_index(at_), throughput_.beta, radiance_, shape});
    }
    void log_light(const Start& shadow, const Rgb& added) {
        if (!report_.events) return;
        report_.events->push_back({Kind::light, event_, tracer_.world_point(shadow.ray.origin),
                                   shadow.ray.direction, tracer_.medium_index(shadow), added,
                                   radiance_});
    }
    /// The path ends; false, as it does not go on.
    bool end(PathEvent::Kind kind) {
        log(kind, at_.ray.origin);
        return false;
    }

    void note_cosine(double cosine) {
        report_.note(shared::HEALTH_COSINE, std::abs(cosine) > shared::COSINE_MAX);
    }

    /// Russian roulette, late, on what the path carries times how much light is within its reach.
    bool survive(double reach) {
        const double weight = largest(throughput_.beta);
        const double chance = std::max(4 * weight * reach, 0.25);
        report_.note(shared::HEALTH_WEIGHT, weight * reach > shared::WEIGHT_MAX);
        if (weight == 0) return end(Kind::absorbed);
        if (chance >= 1) return true;
        if (unit(words_.w) >= chance) return end(Kind::roulette);
        throughput_.beta /= chance;
        return true;
    }

    /// The last scattering event, if lights were sampled there.
    struct Vertex {
        dvec3 place;
        double density; ///< Of the direction that was taken.
    };

    const PathTracer& tracer_;
    const RandomPath& random_;
    PathReport& report_;
    Start at_;
    Throughput throughput_;
    Rgb radiance_{0};
    std::optional<Vertex> vertex_;
    int depth_ = 0;
    std::uint32_t event_ = 0;
    glm::uvec4 words_{0};
};

Rgb PathTracer::radiance(const Ray& camera_ray, const RandomPath& random,
                         PathReport& report) const {
    return Walk(*this, camera_ray, random, report).run();
}

} // namespace tyndall::reference

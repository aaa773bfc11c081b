/// The state of one path, and what happens to it.
#pragma once

#include "reference/bsdf.h"
#include "reference/phase.h"
#include "reference/tracking.h"
#include "reference/walk.h"

namespace tyndall::reference {

/// The power heuristic with exponent 2 (Veach 1997, section 9.2.4), without overflow.
inline double mis_weight(double density, double other_density) {
    const double ratio = other_density / density;
    return 1 / (1 + ratio * ratio);
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
    bool can_go_on();

    /// After tracking: there is something left of the path.
    bool is_left() { return throughput_.beta == Rgb(0) ? end(Kind::absorbed) : can_go_on(); }

    /// Counts a scattering event; false if the path has had its share.
    bool may_scatter() {
        if (depth_ == tracer_.scene_.integrator.max_depth) return end(Kind::depth_limit);
        ++depth_;
        return true;
    }

    /// A segment on which light is looked for if the path passes it without a collision.
    struct Passage {
        const Medium& medium;
        Ray ray;
        double end;        ///< May be infinite.
        Throughput before; ///< At its start.
    };
    std::optional<Passage> passage(const MediumLine& line, double end) const;
    /// Density with which paths collide at distance t, averaged over the heroes.
    static double collision_density(const Passage& passage, double t);
    /// Likewise of choosing it in passing, given the light.
    double passing_density(const Passage& passage, std::uint32_t light, double t) const;
    /// MIS weight of light that a path gets from a collision.
    double collision_weight(const Passage& passage, std::uint32_t light, double t) const;
    /// Light from one place on a segment that the path passes, dense where a light is near.
    void look_in_passing(const Passage& passage);

    /// One segment and what happens at its end. Returns whether the path goes on.
    bool step();

    bool arrive(const std::optional<SurfaceHit>& hit);

    /// All that the path contributes comes through here.
    void contribute(const Rgb& light) { radiance_ += light; }

    /// A flight in closed form, to the distance of a collision that scatters, if that is before the
    /// end.
    std::optional<double> fly(const MediumLine& line, double end);

    /// The same where absorption ends paths, and what is absorbed has met emission.
    std::optional<double> fly_analog(const MediumLine& line, double end);

    void end_by_absorption(const Rgb& emission);

    /// A flight by tracking. Each tentative collision is an event; a real one scatters in the next.
    std::optional<double> track(const MediumLine& line, double end);

    /// A tentative collision; returns whether it scatters.
    bool meet(const TentativeCollision& at);

    bool meet_analog(const TentativeCollision& at);

    /// Marching: emission and light that the medium scatters once, at one place in each step, which
    /// is an event. Transmittance is the product over the steps, or in closed form where flights
    /// are.
    void march(const MediumLine& line, double t_end);

    bool asks_environment(const glm::uvec4& words) const;

    Steps plan(double begin, double end, const glm::uvec4& words) const;

    /// Light from one direction that is scattered at distance t.
    void scatter_once(const Medium& medium, const Rgb& weight, double t,
                      const glm::uvec4& first_words);

    void add_scattered(const LightSample& light, const dvec3& place, const Rgb& weight);

    /// @param passage  In which it happens, if it is weighed against light that is found in
    /// passing.
    bool collide(const Medium& medium, double distance, const std::optional<Passage>& passage);

    Rgb weighted_emission(const SurfaceHit& hit) const;

    /// Emission at the end of the segment, times the chance of getting there where that has a
    /// closed form; elsewhere the paths that get there count (meet).
    void add_expected_emission(const SurfaceHit& hit);

    bool meet(const SurfaceHit& hit);

    bool scatter(const SurfaceHit& hit, const Material& material);

    /// Direct light at a scattering event: respond(to_light) is its Response, start(to_light) the
    /// Start of the shadow ray, and delta_weight(index of light) the weight of lights that nothing
    /// runs into.
    template<class Respond, class Leave, class Weigh>
    void sample_light(const dvec3& place, Respond&& respond_to, Leave&& start,
                      Weigh&& delta_weight) {
        if (!tracer_.samples_lights_) return;
        const auto light = tracer_.lights_.sample(place, random_.words(event_, shared::BLOCK_LIGHT),
                                                  random_.words(event_, shared::BLOCK_EMISSION));
        if (!light) return;
        const Response response = respond_to(light->direction);
        if (response.value == Rgb(0)) return;
        const double weight = light->is_delta ? delta_weight(light->light)
                                              : mis_weight(light->probability, response.density);
        const Rgb unoccluded =
            throughput_.beta * response.value * light->radiance * (weight / light->probability);
        if (unoccluded == Rgb(0)) return;
        const Start shadow = start(light->direction);
        const Rgb added = unoccluded * tracer_.visibility(shadow, *light, random_, event_, report_);
        contribute(added);
        log_light(shadow, added);
    }

    /// MIS weight of emission that the path ran into.
    double hit_weight(const SurfaceHit& hit) const;

    /// MIS weight of emission that the path came upon at distance t; both in the same unit.
    double emission_weight(double t, const Rgb& emission, const Rgb& extinction) const;

    /// Keeps the scattering event, if lights were sampled there.
    void remember(const dvec3& place, double density) {
        if (tracer_.samples_lights_) vertex_ = {place, density};
    }

    /// Tells of the path on arrival at a place (render space).
    void log(PathEvent::Kind kind, const dvec3& place, const Shape* shape = nullptr);

    void log_light(const Start& shadow, const Rgb& added);

    /// The path ends; false, as it does not go on.
    bool end(PathEvent::Kind kind) {
        log(kind, at_.ray.origin);
        return false;
    }

    void note_cosine(double cosine) {
        report_.note(shared::HEALTH_COSINE, std::abs(cosine) > shared::COSINE_MAX);
    }

    /// Russian roulette, late, on what the path carries times how much light is within its reach.
    bool survive(double reach);

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

} // namespace tyndall::reference

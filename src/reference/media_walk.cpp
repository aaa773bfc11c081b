// What media do to a path: flights, collisions, marches.
#include "reference/march.h"
#include "reference/path_walk.h"

namespace tyndall::reference {

std::optional<double> PathTracer::Walk::fly(const MediumLine& line, double end) {
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

std::optional<double> PathTracer::Walk::fly_analog(const MediumLine& line, double end) {
    const Medium& medium = line.medium;
    const int hero = throughput_.hero;
    const double column = analog_flight_distance(medium, hero, words_.x);
    const double distance = line.distance(column);
    if (!(distance < end)) {
        throughput_ = after_analog_flight(medium, throughput_, line.column(end), AnalogEnd::passed);
        return std::nullopt;
    }
    const double u = unit(random_.words(event_, shared::BLOCK_LIGHT).w);
    const bool is_scattered =
        u * (medium.sigma_s[hero] + medium.sigma_a[hero]) < medium.sigma_s[hero];
    throughput_ = after_analog_flight(medium, throughput_, column,
                                      is_scattered ? AnalogEnd::scattered : AnalogEnd::absorbed);
    if (is_scattered) return distance;
    end_by_absorption(medium.emission);
    return std::nullopt;
}

void PathTracer::Walk::end_by_absorption(const Rgb& emission) {
    contribute(throughput_.beta * emission);
    throughput_.beta = Rgb(0);
}

std::optional<double> PathTracer::Walk::track(const MediumLine& line, double end) {
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

bool PathTracer::Walk::meet(const TentativeCollision& at) {
    const Rgb emission = at.absorbed * at.emission;
    if (emission != Rgb(0))
        contribute(throughput_.beta * emission *
                   emission_weight(at.t, emission, at.absorbed + at.scattered));
    const bool is_real = unit(words_.z) < at.scattered[throughput_.hero];
    throughput_ = after_collision(at.absorbed, at.scattered, throughput_, is_real);
    if (!is_real) log(Kind::null_collision, at_.ray.origin + at.t * at_.ray.direction);
    return is_real;
}

bool PathTracer::Walk::meet_analog(const TentativeCollision& at) {
    const int hero = throughput_.hero;
    const double u = unit(words_.z);
    const bool is_real = u < at.scattered[hero];
    const bool is_absorbed = !is_real && u < at.scattered[hero] + at.absorbed[hero];
    const Rgb nothing = glm::max(1.0 - at.scattered - at.absorbed, 0.0);
    const double weight =
        is_absorbed ? emission_weight(at.t, at.absorbed * at.emission, at.absorbed + at.scattered)
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

void PathTracer::Walk::march(const MediumLine& line, double t_end) {
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

bool PathTracer::Walk::asks_environment(const glm::uvec4& words) const {
    return tracer_.lights_.background() != Rgb(0) &&
           (!tracer_.samples_lights_ || unit(words.w) < 0.5);
}

Steps PathTracer::Walk::plan(double begin, double end, const glm::uvec4& words) const {
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

void PathTracer::Walk::scatter_once(const Medium& medium, const Rgb& weight, double t,
                                    const glm::uvec4& first_words) {
    glm::uvec4 words = random_.words(event_, shared::BLOCK_LIGHT);
    if (tracer_.placement() == Integrator::Placement::equiangular)
        words.x = first_words.x, words.w = first_words.w;
    const dvec3 place = at_.ray.origin + t * at_.ray.direction;
    const Rgb background = tracer_.lights_.background();
    const double choices = background != Rgb(0) && tracer_.samples_lights_ ? 2 : 1;
    if (asks_environment(words)) {
        const ScatteringAngle angle = sample_angle(medium.phases, unit(words_.y), throughput_.hero);
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
        const Rgb value =
            evaluate_phase(medium.phases, one_minus_cosine(at_.ray.direction, light->direction));
        add_scattered(*light, place, choices / light->probability * weight * value);
    }
}

void PathTracer::Walk::add_scattered(const LightSample& light, const dvec3& place,
                                     const Rgb& weight) {
    const Rgb unoccluded = weight * light.radiance;
    if (unoccluded == Rgb(0)) return;
    const Start start{{place, light.direction}, at_.in};
    const Rgb added = unoccluded * tracer_.visibility(start, light, random_, event_, report_);
    contribute(added);
    log_light(start, added);
}

} // namespace tyndall::reference

// Light of point and spot lights in thin media, looked for by paths that pass without a collision
// (Kulla and Fajardo 2012, "Importance Sampling Techniques for Path Tracing in Participating
// Media"), and weighed against that at collisions by the balance heuristic.
#include "reference/path_walk.h"

#include <algorithm>

namespace tyndall::reference {
namespace {

/// Averaged over the heroes that the path could have had.
double mean_over_heroes(const Throughput& before, const Rgb& density) {
    const Rgb weighted = before.ratio * density;
    return (weighted.x + weighted.y + weighted.z) / 3;
}

/// Densities of collisions along a line.
Rgb collisions(const Medium& medium, double t) {
    return medium.sigma_s * glm::exp(-medium.sigma_s * t);
}

/// The share of paths that look, of those that pass.
double lookout_share(const Medium& medium, double end, std::uint32_t event) {
    const Rgb& sigma_s = medium.sigma_s;
    const double depth = std::min({sigma_s.x, sigma_s.y, sigma_s.z}) * end;
    if (!(depth <= shared::LOOKOUT_DEPTH_MAX)) return 0;
    const double lookouts = std::clamp<double>(shared::LOOKOUTS_PER_DEPTH * depth,
                                               shared::LOOKOUTS_MIN, shared::LOOKOUTS_MAX);
    const double share = event > shared::LATE_EVENT ? shared::LATE_SHARE : 1;
    return std::floor(share * lookouts) / shared::LOOKOUTS_MAX;
}

} // namespace

std::optional<PathTracer::Walk::Passage> PathTracer::Walk::passage(const MediumLine& line,
                                                                   double end) const {
    const Medium& medium = line.medium;
    if (!tracer_.samples_lights_ || tracer_.is_analog_ || !medium.is_homogeneous() ||
        !is_scattering(medium))
        return std::nullopt;
    return Passage{medium, at_.ray, end, throughput_};
}

double PathTracer::Walk::collision_density(const Passage& passage, double t) {
    return mean_over_heroes(passage.before, collisions(passage.medium, t));
}

double PathTracer::Walk::passing_density(const Passage& passage, std::uint32_t light,
                                         double t) const {
    const double share = lookout_share(passage.medium, passage.end, event_);
    if (share == 0) return 0;
    const auto lit = tracer_.lights_.lit_part(light, passage.ray, passage.end);
    if (!lit || t < lit->place(0) || t > lit->place(1)) return 0;
    const Rgb passing = glm::exp(-passage.medium.sigma_s * passage.end);
    return share * mean_over_heroes(passage.before, passing) / lit->weight(t);
}

double PathTracer::Walk::collision_weight(const Passage& passage, std::uint32_t light,
                                          double t) const {
    const double collision = collision_density(passage, t);
    return collision / (collision + passing_density(passage, light, t));
}

void PathTracer::Walk::look_in_passing(const Passage& passage) {
    const Medium& medium = passage.medium;
    if ((words_.w & 255) >= lookout_share(medium, passage.end, event_) * shared::LOOKOUTS_MAX)
        return;
    if (depth_ == tracer_.scene_.integrator.max_depth) return;
    const std::uint32_t event = event_ | shared::EVENT_PASSING;
    const glm::uvec4 words = random_.words(event, shared::BLOCK_LIGHT);
    const std::uint32_t index = tracer_.lights_.draw(words.x);
    const auto lit = tracer_.lights_.lit_part(index, passage.ray, passage.end);
    if (!lit) return;
    const double t = lit->place(unit(words.y));
    const dvec3 place = passage.ray.origin + t * passage.ray.direction;
    const auto light = tracer_.lights_.sample_drawn(index, place, words);
    if (!light) return;
    const Rgb phase =
        evaluate_phase(medium.phases, one_minus_cosine(passage.ray.direction, light->direction));
    const double density = collision_density(passage, t) + passing_density(passage, index, t);
    const Rgb unoccluded = passage.before.beta * glm::exp(-medium.sigma_a * t) *
                           collisions(medium, t) * phase * light->radiance /
                           (density * light->probability);
    if (is_delta(medium.phases) || unoccluded == Rgb(0)) return;
    const Start shadow{{place, light->direction}, at_.in};
    const Rgb added = unoccluded * tracer_.visibility(shadow, *light, random_, event, report_);
    contribute(added);
    log_light(shadow, added);
}

} // namespace tyndall::reference

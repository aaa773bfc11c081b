#include "reference/light_choice.h"

#include <algorithm>
#include <limits>

namespace tyndall::reference {

double LightReach::importance(const dvec3& place) const {
    if (!middle) return reach;
    const dvec3 offset = *middle - place;
    const double squared =
        std::max(glm::dot(offset, offset) + size2, double{std::numeric_limits<float>::min()});
    return std::min(reach * (share ? share(offset / std::sqrt(squared)) : 1) / squared, 1e30);
}

LightChoice::LightChoice(const std::vector<double>& powers, std::vector<LightReach> reaches,
                         std::uint32_t candidates)
    : table_(powers), reaches_(std::move(reaches)), candidates_(candidates) {}

double LightChoice::mis_probability(std::size_t light) const {
    return std::min(1.0, candidates_ * table_.probability(light));
}

std::optional<LightChoice::Choice> LightChoice::choose(const dvec3& place,
                                                       const glm::uvec4& words) const {
    if (candidates_ == 1) return Choice{draw(words.x), 1};
    std::vector<std::uint32_t> lights;
    std::vector<double> importances;
    double sum = 0;
    for (std::uint32_t i = 0; i < candidates_; ++i) {
        lights.push_back(draw(words.x + i * (0xFFFFFFFFu / candidates_ + 1)));
        importances.push_back(reaches_[lights[i]].importance(place));
        sum += importances[i];
    }
    double target = sum * shared::unit_float_of_rest(words.y, words.z, words.w);
    std::optional<Choice> choice;
    for (std::uint32_t i = 0; i < candidates_ && target >= 0; ++i) {
        if (importances[i] > 0) {
            const double rarer = mis_probability(lights[i]) / table_.probability(lights[i]);
            choice = Choice{lights[i], rarer * sum / (candidates_ * importances[i])};
        }
        target -= importances[i];
    }
    return choice;
}

} // namespace tyndall::reference

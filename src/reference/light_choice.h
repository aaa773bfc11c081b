/// Which light is sampled at a place.
#pragma once

#include "reference/alias_table.h"
#include "reference/sampling.h"

#include <functional>
#include <optional>

namespace tyndall::reference {

/// What a light brings to places, about and if nothing is in between, over its power.
struct LightReach {
    double reach;                  ///< Times the squared distance, unless it is at infinity.
    std::optional<dvec3> middle{}; ///< None: at infinity.
    double size2 = 0;              ///< Added to the squared distance from the middle.
    /// Share of it that arrives along -direction, a vector of a length up to 1; none: 1.
    std::function<double(const dvec3& direction)> share{};

    double importance(const dvec3& place) const;
};

/// Candidates are drawn by their power, and one of them is taken by its importance at the place
/// (Talbot et al. 2005, "Importance Resampling for Global Illumination").
class LightChoice {
  public:
    /// @param candidates  1: power alone decides
    LightChoice(const std::vector<double>& powers, std::vector<LightReach> reaches,
                std::uint32_t candidates);

    struct Choice {
        std::uint32_t light;
        double weight; ///< Expected: of what is chosen, that over its mis_probability is unbiased.
    };
    /// words.x draws the candidates, the low bytes of the others choose. None if no candidate
    /// shines at the place.
    std::optional<Choice> choose(const dvec3& place, const glm::uvec4& words) const;

    /// By its power alone.
    std::uint32_t draw(std::uint32_t word) const { return table_.choose(word); }
    double draw_probability(std::size_t light) const { return table_.probability(light); }
    bool empty() const { return table_.empty(); }
    /// That a light is chosen where it is near, which is how multiple importance sampling takes it.
    double mis_probability(std::size_t light) const;

  private:
    AliasTable table_;
    std::vector<LightReach> reaches_;
    std::uint32_t candidates_;
};

} // namespace tyndall::reference

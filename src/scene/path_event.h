/// What happened to a path, event by event, as a replay tells it.
#pragma once

#include "scene/scene.h"

namespace tyndall {

struct PathEvent {
    enum class Kind {
        camera,
        null_collision, ///< A tentative collision that was none.
        collision,
        surface,
        interface,
        light,  ///< A light was sampled.
        escape, ///< The path ends, as with all that follow.
        roulette,
        depth_limit,
        absorbed, ///< It carries nothing any more.
        lost      ///< By the event limit, or without a direction (shared/health.h).
    };
    Kind kind;
    std::uint32_t event;          ///< Its number in the definition of random numbers.
    glm::dvec3 position;          ///< In the world.
    glm::dvec3 direction;         ///< Of travel, on arrival; light: towards it.
    int medium = -1;              ///< On arrival.
    Rgb throughput{0};            ///< On arrival; light: what it adds to the radiance.
    Rgb radiance{0};              ///< Of the path so far; of a light, with what it adds.
    const Shape* shape = nullptr; ///< surface, interface; null if the scene needs no hierarchy.
};

/// Events that a replay keeps, so that a path of millions can be told.
constexpr std::size_t kMostEvents = std::size_t{1} << 16;

/// One path, replayed.
struct Replay {
    glm::dvec3 camera{0}; ///< Its place in the world, about which float32 is finest.
    std::vector<PathEvent> events;
    std::uint64_t event_count = 0; ///< More than `events` holds if there was no room.
    glm::dvec4 sum{0}; ///< What the film gets: weight * radiance, weight of the pixel filter.
    std::uint32_t mishaps = 0; ///< Bits by kind (shared/health.h).
};

/// Index of the first event in which two renderers' replays of a path differ by more than rounding
/// and what it grows to along a path: another kind, place (1e-3 of the way so far), direction,
/// medium, throughput or radiance (1e-3 of it). Where both end alike, the length of both.
std::size_t first_difference(const Replay& a, const Replay& b);

/// Whether the events that are kept are the same, up to rounding, and as many happened.
bool are_same(const Replay& a, const Replay& b);

} // namespace tyndall

// What can go wrong with a path, and from where on it has: for the device, the reference renderer
// and the host. Each kind has a counter of paths; nothing is dropped or cut off that is not
// counted.
#ifndef TYNDALL_HEALTH_H
#define TYNDALL_HEALTH_H

#include "interop.h"

#ifdef __cplusplus
#include <array>
#endif

TYNDALL_SHARED_BEGIN

// Kinds. The names in kHealthNames are in this order.
TYNDALL_CONSTANT int HEALTH_NONFINITE = 0;   // radiance that is no number, or infinite: dropped
TYNDALL_CONSTANT int HEALTH_NEGATIVE = 1;    // radiance below 0: dropped
TYNDALL_CONSTANT int HEALTH_MAJORANT = 2;    // extinction above its bound: the estimate is biased
TYNDALL_CONSTANT int HEALTH_COSINE = 3;      // |cos| of an angle above 1, before any normalisation
TYNDALL_CONSTANT int HEALTH_DIRECTION = 4;   // a direction of no length, or not finite: dropped
TYNDALL_CONSTANT int HEALTH_EVENT_LIMIT = 5; // ended by the limit of events, not by physics
TYNDALL_CONSTANT int HEALTH_WEIGHT =
    6; // throughput beyond what exact sampling gives: see WEIGHT_MAX
TYNDALL_CONSTANT int HEALTH_COUNT = 7;
TYNDALL_CONSTANT int HEALTH_DROPPED = 7; // while a path is still to be told by the kinds above

// Bounds that rounding does not reach.
TYNDALL_CONSTANT float MAJORANT_RATIO_MAX = 1.0001f; // extinction over majorant
TYNDALL_CONSTANT float COSINE_MAX = 1.00001f;        // dot products of unit vectors err by 2e-7
TYNDALL_CONSTANT float LENGTH_ERROR_MAX = 1e-3f;     // | |direction|^2 - 1 |
// Of throughput times the light within reach (roulette): at most 3 by spectral MIS, times squares
// of relative indices of refraction.
TYNDALL_CONSTANT float WEIGHT_MAX = 1024.0f;

// Interfaces that a shadow ray may cross. Its loop stands in one dispatch, which must end, and
// after fewer steps than lavapipe allows (wavefront/volume.glsl). For paths, see
// Integrator::event_limit.
TYNDALL_CONSTANT uint SHADOW_CROSSINGS_MAX = 1024u;

// Rounding of distances from the centre of a planet, relative to these: half a metre on Earth, by
// which bounds on the density of its air have to go lower.
TYNDALL_CONSTANT float HEIGHT_ERROR = 2.4e-7f;

// How far apart surfaces still touch, in errors of the point that was hit: as far as the vertices
// of faces of different extent may be rounded.
TYNDALL_CONSTANT float CONTACT_ERRORS = 16.0f;

#ifdef __cplusplus
/// As --stats and the attributes of EXR files call the kinds.
inline constexpr std::array<const char*, HEALTH_COUNT> kHealthNames{
    "nonfinite",     "negative",    "majorant_exceeded", "cosine_exceeded",
    "bad_direction", "event_limit", "weight_exceeded"};
/// As people are told of them, after a number.
inline constexpr std::array<const char*, HEALTH_COUNT> kHealthTexts{
    "contributions dropped that are not finite",
    "contributions dropped that are negative",
    "paths or shadow rays met more extinction than its majorant says, which biases the image",
    "paths had a cosine beyond 1",
    "paths dropped for a direction of no length or not finite",
    "paths or shadow rays ended by the limit of events, not by physics",
    "paths had a weight beyond what exact sampling gives"};

/// Paths of one kind; of the first that was noticed, where it was.
struct Mishap {
    std::uint64_t count = 0;
    std::uint32_t x = 0, y = 0, sample = 0;
};

/// What went wrong in a render.
struct Health {
    std::array<Mishap, HEALTH_COUNT> kinds{};
    double worst_majorant_ratio = 0; ///< Extinction over majorant; 0 if none was exceeded.
    /// What paths that the event limit ended still carried: the sum of their throughputs, mean over
    /// channels. Times the radiance that they would have met, it is what the image lacks.
    double lost_throughput = 0;

    std::uint64_t operator[](std::size_t kind) const { return kinds[kind].count; }
    bool is_good() const {
        for (const Mishap& kind : kinds)
            if (kind.count > 0) return false;
        return true;
    }
};
#endif

TYNDALL_SHARED_END

#endif

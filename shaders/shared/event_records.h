// The log of a replay: what happened to one path, event by event (wavefront/event_log.glsl).
#ifndef TYNDALL_EVENT_RECORDS_H
#define TYNDALL_EVENT_RECORDS_H

#include "interop.h"

TYNDALL_SHARED_BEGIN

// Kinds, in the order of PathEvent::Kind.
TYNDALL_CONSTANT uint EVENT_CAMERA = 0u;
TYNDALL_CONSTANT uint EVENT_NULL_COLLISION = 1u;
TYNDALL_CONSTANT uint EVENT_COLLISION = 2u;
TYNDALL_CONSTANT uint EVENT_SURFACE = 3u;
TYNDALL_CONSTANT uint EVENT_INTERFACE = 4u;
TYNDALL_CONSTANT uint EVENT_LIGHT = 5u;       // a light was sampled
TYNDALL_CONSTANT uint EVENT_ESCAPE = 6u;      // ends, as do those that follow
TYNDALL_CONSTANT uint EVENT_ROULETTE = 7u;    // lost Russian roulette
TYNDALL_CONSTANT uint EVENT_DEPTH_LIMIT = 8u; // has had its scattering events
TYNDALL_CONSTANT uint EVENT_ABSORBED = 9u;    // carries nothing any more
TYNDALL_CONSTANT uint EVENT_LOST = 10u;       // event limit, or no direction: see health.h
TYNDALL_CONSTANT uint EVENT_KIND_COUNT = 11u;

/// The path on arrival at an event, before it is scattered. Of EVENT_LIGHT: the shadow ray, and
/// what the light adds for the throughput.
struct EventRecord {
    vec3 position;        ///< In render space.
    uint kind_and_medium; ///< EVENT_* << 16 | medium
    vec3 direction;
    uint event; ///< As in random.h.
    vec3 throughput;
    uint shape;    ///< That the path is at, or NONE.
    vec3 radiance; ///< Of the path so far.
    uint pad0;
};

TYNDALL_SHARED_END

#endif

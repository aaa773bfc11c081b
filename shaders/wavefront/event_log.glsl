// Tells the host what happens to a path, if it asks (log_capacity; 0 leaves nothing of it in a
// kernel).
#ifndef TYNDALL_EVENT_LOG_GLSL
#define TYNDALL_EVENT_LOG_GLSL

#include "shared/event_records.h"
#include "wavefront/buffers.glsl"

layout(binding = BINDING_LOG, std430) buffer Log {
    uint logged; ///< Events, those for which there was no room included.
    uint pad[3];
    EventRecord events[];
};

void log_event(uint kind, uint event, vec3 position, vec3 direction, uint medium, vec3 throughput,
               vec3 radiance, uint shape) {
    if (log_capacity == 0u) return;
    const uint at = atomicAdd(logged, 1u);
    if (at < log_capacity)
        events[at] = EventRecord(position, kind << 16 | medium, direction, event, throughput, shape,
                                 radiance, 0u);
}

#endif

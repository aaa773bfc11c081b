#version 460
#extension GL_GOOGLE_include_directive : require
#include "wavefront/buffers.glsl"

// One invocation, at the end of a round: empties the queues, and sees which pieces of batches are
// complete. Those are folded into the film next (update_film), up to where the host wants to look
// at it, and as many new ones may be started.

/// A dispatch of so many invocations; devices need not allow more than 65535 workgroups in one
/// dimension.
DispatchSize dispatch_size(uint invocations) {
    const uint groups = (invocations + workgroup_size - 1u) / workgroup_size;
    return DispatchSize(min(groups, 32768u), (groups + 32767u) / 32768u, 1u);
}

/// Pieces that update_film may fold at once, by how often it may go round its loops (volume.glsl).
uint most_folds() {
    const uint lanes = fold_lanes(push.pixel_count);
    const uint pixels = (push.pixel_count + lanes - 1u) / lanes;
    return clamp(30000u / pixels, 2u, push.window + 1u) - 1u;
}

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    for (uint queue = 0u; queue < QUEUE_COUNT; ++queue) {
        control.queue_total[queue] += control.queue_size[queue];
        control.queue_size[queue] = 0u;
        control.queue_dispatch[queue] = DispatchSize(0u, 1u, 1u);
    }

    uint folded = control.folded_pieces + control.fold_count;
    control.folded_pieces = folded;
    uint count = 0u;
    const uint limit = min(push.piece_count, control.fold_limit), most = most_folds();
    while (folded + count < limit && count < most &&
           control.finished[(folded + count) % push.window] == push.pixel_count)
        ++count;
    if (folded + count < limit && count < min(control.fold_least, most)) count = 0u;
    for (uint i = 0u; i < count; ++i)
        control.finished[(folded + i) % push.window] = 0u;
    control.fold_count = count;
    control.fold_dispatch = dispatch_size(count == 0u ? 0u : fold_lanes(push.pixel_count));
    control.ticket_limit = push.pixel_count * min(push.piece_count, folded + count + push.window);
    // A slot that waits holds a ticket that is not due, and tickets are handed out in order.
    const bool is_idle = control.next_ticket == control.ticket_limit + push.slot_count;
    control.slot_rounds += control.slot_dispatch.x == 0u ? 0u : 1u;
    // In one dimension: stages on slots know theirs by it.
    const uint groups = (push.slot_count + workgroup_size - 1u) / workgroup_size;
    control.slot_dispatch = DispatchSize(is_idle ? 0u : groups, 1u, 1u);
}

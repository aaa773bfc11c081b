// Where the state of a path is between stages, and how its slot gets from stage to stage.
//
// A stage loads before it stores: within a dispatch, what is loaded through texels need not be what
// was stored as words (seen on a GPU; a CPU has one cache for both).
#ifndef TYNDALL_SLOTS_GLSL
#define TYNDALL_SLOTS_GLSL

#include "wavefront/buffers.glsl"

uvec4 load_path(uint group, uint slot) {
    const uint texel = group * push.slot_count + slot;
    if (in_storage(BINDING_PATHS)) return path_words[texel];
    return imageLoad(path_texels, int(texel));
}
void store_path(uint group, uint slot, uvec4 value) {
    path_words[group * push.slot_count + slot] = value;
}
/// One word of a texel: a CPU driver stores word by word and lane by lane, which costs more than
/// all else about a path's state.
void store_path_word(uint group, uint component, uint slot, uint value) {
    path_words[group * push.slot_count + slot][component] = value;
}

void enqueue(uint queue, uint slot) {
    const uint at = atomicAdd(control.queue_size[queue], 1u);
    queues[queue * push.slot_count + at] = slot;
    if (at % workgroup_size == 0u) atomicAdd(control.queue_dispatch[queue].x, 1u);
}

/// The slot that this invocation works on; NONE if the queue has no more.
uint dequeue(uint queue) {
    const uint at = gl_GlobalInvocationID.x;
    return at < control.queue_size[queue] ? queues[queue * push.slot_count + at] : NONE;
}

#endif

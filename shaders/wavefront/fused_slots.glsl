// In place of wavefront/slots.glsl: the state of a path is in the registers of its invocation, and
// so is what it waits for.
#ifndef TYNDALL_SLOTS_GLSL
#define TYNDALL_SLOTS_GLSL

#include "wavefront/buffers.glsl"

uvec4 path_state[PATH_GROUPS]; // indices are constants, or it would not be in registers
uint waits_in = 0u;            // bits by queue

uvec4 load_path(uint group, uint slot) {
    return path_state[group];
}
void store_path(uint group, uint slot, uvec4 value) {
    path_state[group] = value;
}
void store_path_word(uint group, uint component, uint slot, uint value) {
    path_state[group][component] = value;
}

void enqueue(uint queue, uint slot) {
    waits_in |= 1u << queue;
}
uint dequeue(uint queue) {
    const bool is_waiting = (waits_in >> queue & 1u) != 0u;
    waits_in &= ~(1u << queue);
    return is_waiting ? gl_GlobalInvocationID.x : NONE;
}

// Between dispatches it lies where the wavefront has it, so that the renderer can do the rest.
#define EACH_GROUP(X) X(0) X(1) X(2) X(3) X(4) X(5) X(6) X(7) X(8) X(9) X(10) X(11) X(12)
void load_slot(uint slot) {
#define LOAD_WORDS(group) path_state[group] = path_words[group * push.slot_count + slot];
#define LOAD_TEXELS(group)                                                                         \
    path_state[group] = imageLoad(path_texels, int(group * push.slot_count + slot));
    if (in_storage(BINDING_PATHS)) {
        EACH_GROUP(LOAD_WORDS)
    } else {
        EACH_GROUP(LOAD_TEXELS)
    }
}
void store_slot(uint slot) {
#define STORE(group) path_words[group * push.slot_count + slot] = path_state[group];
    EACH_GROUP(STORE)
}

#endif

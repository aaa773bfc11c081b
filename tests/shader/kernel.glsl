// What every test kernel has: which function to run on what, and where its results go.
// The numbers of a Task (kernel.h) travel in push constants that no function under test reads.
#include "wavefront/scene.glsl"

bool is_idle() {
    return gl_GlobalInvocationID.x >= push.slot_count;
}
uint local_index() {
    return gl_GlobalInvocationID.x;
}
uint global_index() {
    return gl_GlobalInvocationID.x + push.first_sample;
}
uint wanted() {
    return push.first_piece;
}
uint variant() {
    return push.piece_count;
}
float number() {
    return uintBitsToFloat(push.full_width);
}

vec4 input_texel(uint texel) {
    return uintBitsToFloat(fetch_scene(texel));
}

void emit(uint texel, uvec4 value) {
    if (in_storage(BINDING_FILM))
        film_words[texel] = value;
    else
        imageStore(film_texels, int(texel), value);
}
void emit(uint texel, vec4 value) {
    emit(texel, floatBitsToUint(value));
}

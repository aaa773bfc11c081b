// Every buffer of the renderer, and how texels get in and out of them. Included once by each stage.
#ifndef TYNDALL_BUFFERS_GLSL
#define TYNDALL_BUFFERS_GLSL

#include "shared/bindings.h"
#include "shared/features.h"
#include "shared/random.h"
#include "shared/records.h"
#include "shared/schedule.h"
#include "shared/sobol.h"

layout(local_size_x_id = 0) in;

layout(push_constant, std430) uniform Push {
    PushConstants push;
};

layout(binding = BINDING_SCENE) uniform usamplerBuffer scene_texels;
layout(binding = BINDING_PATHS, rgba32ui) readonly uniform uimageBuffer path_texels;
layout(binding = BINDING_PIECES, rgba32ui) uniform uimageBuffer piece_texels;
layout(binding = BINDING_FILM, rgba32ui) uniform uimageBuffer film_texels;
layout(binding = BINDING_VOXELS) uniform samplerBuffer voxel_texels;
layout(binding = STORAGE_TWIN + BINDING_VOXELS, std430) readonly buffer Voxels {
    uint voxel_words[];
};
layout(binding = STORAGE_TWIN + BINDING_SCENE, std430) readonly buffer Scene {
    uvec4 scene_words[];
};
layout(binding = STORAGE_TWIN + BINDING_PATHS, std430) buffer Paths {
    uvec4 path_words[];
};
layout(binding = STORAGE_TWIN + BINDING_PIECES, std430) buffer Pieces {
    uvec4 piece_words[];
};
layout(binding = STORAGE_TWIN + BINDING_FILM, std430) buffer Film {
    uvec4 film_words[];
};
layout(binding = BINDING_CONTROL, std430) buffer ControlBlock {
    Control control;
};
layout(binding = BINDING_QUEUES, std430) buffer Queues {
    uint queues[];
};

/// Index of this invocation in a dispatch of any number of workgroups (fold_dispatch uses two
/// dimensions).
uint invocation() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * workgroup_size +
           gl_LocalInvocationIndex;
}

/// Whether a buffer is read through its storage twin, and whether it is written as texels.
bool in_storage(int binding) {
    return (storage_fallback >> binding & 1u) != 0u;
}
bool in_texels(int binding) {
    return (texel_stores >> binding & 1u) != 0u;
}

uvec4 fetch_scene(uint texel) {
    if (in_storage(BINDING_SCENE)) return scene_words[texel];
    return texelFetch(scene_texels, int(texel));
}

float fetch_voxel(uint at) {
    if (!in_storage(BINDING_VOXELS)) return texelFetch(voxel_texels, int(at >> 2))[at & 3u];
    if (voxels_are_half == 0u) return uintBitsToFloat(voxel_words[at]);
    return unpackHalf2x16(voxel_words[at >> 1])[at & 1u];
}

vec4 load_piece(uint texel) {
    if (in_storage(BINDING_PIECES)) return uintBitsToFloat(piece_words[texel]);
    return uintBitsToFloat(imageLoad(piece_texels, int(texel)));
}
void store_piece(uint texel, vec4 value) {
    if (in_texels(BINDING_PIECES))
        imageStore(piece_texels, int(texel), floatBitsToUint(value));
    else
        piece_words[texel] = floatBitsToUint(value);
}

vec4 load_film(uint texel) {
    if (in_storage(BINDING_FILM)) return uintBitsToFloat(film_words[texel]);
    return uintBitsToFloat(imageLoad(film_texels, int(texel)));
}
void store_film(uint texel, vec4 value) {
    if (in_texels(BINDING_FILM))
        imageStore(film_texels, int(texel), floatBitsToUint(value));
    else
        film_words[texel] = floatBitsToUint(value);
}

#endif

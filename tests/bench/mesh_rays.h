// Rays through the cube from -1 to 1 that have nothing in common, for the device and for Embree.
#ifndef TYNDALL_MESH_RAYS_H
#define TYNDALL_MESH_RAYS_H

#include "shared/random.h"

TYNDALL_SHARED_BEGIN

struct MeshRay {
    vec3 origin;
    vec3 direction; ///< Not of unit length.
};

TYNDALL_SHARED_INLINE vec3 mesh_ray_point(uvec2 seed, uint index, uint block) {
    const uvec4 words = random_block(seed, index, 0u, 0u, block);
    return vec3(unit_float(words.x), unit_float(words.y), unit_float(words.z)) * 2.0f - 1.0f;
}

/// From a point of the cube towards another.
TYNDALL_SHARED_INLINE MeshRay mesh_ray(uvec2 seed, uint index) {
    const vec3 origin = mesh_ray_point(seed, index, 0u);
    return MeshRay(origin, mesh_ray_point(seed, index, 1u) - origin);
}

TYNDALL_SHARED_END

#endif

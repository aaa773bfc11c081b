#version 460
#extension GL_GOOGLE_include_directive : require
#include "mesh_rays.h"
#include "wavefront/geometry.glsl"

// Rays of no order against a mesh: what the walk through the hierarchy costs, and nothing else.
// The distance of the nearest hit goes to the film.

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= push.pixel_count) return;
    const MeshRay ray = mesh_ray(push.seed, index);
    const Hit hit = trace(ray.origin, ray.direction, INFINITY, false, NO_SKIP);
    store_film(index, vec4(hit.t, 0, 0, 0));
}

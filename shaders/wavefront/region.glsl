// Scenes whose only geometry is one convex boundary of a medium in a vacuum need no hierarchy:
// where a ray enters and leaves is a formula, and a ray that has left does not come back.
#ifndef TYNDALL_REGION_GLSL
#define TYNDALL_REGION_GLSL

#include "lib/intersect.glsl"
#include "wavefront/scene.glsl"

RegionRecord region; // loaded once a kernel, by the stages that use it

/// Distances at which the line enters and leaves the region; false if it misses. (A line that runs
/// along an axis exactly within an upper face of a box misses it.)
bool intersect_region(vec3 origin, vec3 direction, out float near, out float far) {
    if (geometry == GEOMETRY_BOX) {
        const vec3 inverse = 1.0 / mix(direction, vec3(1e-30), equal(direction, vec3(0)));
        const vec3 a = (region.lower - origin) * inverse;
        const vec3 b = (region.upper - origin) * inverse;
        const vec3 entry = min(a, b), exit = max(a, b);
        near = max(entry.x, max(entry.y, entry.z));
        far = min(exit.x, min(exit.y, exit.z));
        return near < far;
    }
    return intersect_sphere(transform_point(region.unit_from_world, origin),
                            transform_vector(region.unit_from_world, direction), 1.0, near, far);
}

/// Distance to the boundary from inside (or, by rounding, from next to it).
float region_exit(vec3 origin, vec3 direction) {
    float near, far;
    if (!intersect_region(origin, direction, near, far)) return 0.0;
    return max(0.0, far);
}

/// Transmittance from inside the medium to a light.
vec3 region_transmittance(vec3 origin, vec3 direction, float distance, Medium medium) {
    const float exit = geometry == GEOMETRY_NONE ? INFINITY : region_exit(origin, direction);
    return transmittance(medium, min(distance, exit));
}

#endif

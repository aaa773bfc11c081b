// The camera and the pixel filter. Pure functions.
#ifndef TYNDALL_CAMERA_GLSL
#define TYNDALL_CAMERA_GLSL

#include "lib/sampling.glsl"
#include "shared/features.h"
#include "shared/records.h"

/// The ray through the film point, lens in the unit square. `direction` is of unit length.
void camera_ray(CameraRecord camera, vec2 film, vec2 lens, out vec3 origin, out vec3 direction) {
    const vec3 shift = film.x * camera.direction_x + film.y * camera.direction_y;
    origin = camera.origin_0 + (is_orthographic != 0u ? shift : vec3(0));
    direction = camera.direction_0 + (is_orthographic != 0u ? vec3(0) : shift);
    if (has_lens != 0u) {
        const vec2 p = sample_disk(lens.x, lens.y);
        const vec3 aperture = p.x * camera.lens_u + p.y * camera.lens_v;
        origin += aperture;
        direction -= aperture * camera.inverse_focal_distance;
    }
    direction *= inversesqrt(dot(direction, direction));
}

/// Offset from the pixel's centre of a triangle filter of radius r, drawn by inversion.
float sample_triangle_filter(float r, float u) {
    return u < 0.5 ? r * (sqrt(2.0 * u) - 1.0) : r * (1.0 - sqrt(2.0 - 2.0 * u));
}

#endif

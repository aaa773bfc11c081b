// Loads of scene records: the only place that knows how records.h lies in texels.
#ifndef TYNDALL_SCENE_GLSL
#define TYNDALL_SCENE_GLSL

#include "lib/medium.glsl"
#include "wavefront/buffers.glsl"

// Push constants that loops need, read once a kernel: in a loop, each time costs a CPU driver some
// 35 instructions.
uint primitive_table = push.primitives;
uint quadric_table = push.quadrics;

vec3 floats(uvec4 texel) {
    return uintBitsToFloat(texel.xyz);
}

/// A colour. In a grey scene all channels are the first, and the compiler keeps one.
vec3 colour(vec3 c) {
    return is_grey != 0u ? vec3(c.x) : c;
}

CameraRecord load_camera() { // the camera opens the scene buffer
    CameraRecord camera;
    uvec4 t = fetch_scene(0u);
    camera.origin_0 = floats(t);
    camera.medium = t.w;
    t = fetch_scene(1u);
    camera.direction_0 = floats(t);
    camera.inverse_focal_distance = uintBitsToFloat(t.w);
    t = fetch_scene(2u);
    camera.direction_x = floats(t);
    camera.clamp = uintBitsToFloat(t.w);
    t = fetch_scene(3u);
    camera.direction_y = floats(t);
    camera.exposure = uintBitsToFloat(t.w);
    t = fetch_scene(4u);
    camera.lens_u = floats(t);
    camera.filter_x_radius = uintBitsToFloat(t.w);
    t = fetch_scene(5u);
    camera.lens_v = floats(t);
    camera.filter_y_radius = uintBitsToFloat(t.w);
    t = fetch_scene(6u);
    camera.environment = colour(floats(t));
    camera.filter_cells = t.w;
    return camera;
}

Medium load_medium(uint index) {
    const uint texel = push.media + index * MEDIUM_TEXELS;
    const uvec4 a = fetch_scene(texel);
    Medium medium;
    medium.sigma_a = colour(floats(a));
    medium.phase_parameter = uintBitsToFloat(a.w);
    const uvec4 b = fetch_scene(texel + 1u);
    medium.sigma_s = colour(floats(b));
    medium.phase = b.w;
    medium.emission = has_emission != 0u ? colour(floats(fetch_scene(texel + 2u))) : vec3(0);
    medium.density_kind = medium.density_record = 0u;
    if (densities != 0u) {
        const uvec4 density = fetch_scene(texel + 3u);
        medium.density_kind = density.x;
        medium.density_record = density.y;
    }
    return medium;
}

ShapeRecord load_shape(uint index) {
    const uint texel = push.shapes + index * SHAPE_TEXELS;
    const uvec4 a = fetch_scene(texel);
    ShapeRecord shape;
    shape.flags = a.x;
    shape.medium_inside = a.y;
    shape.medium_outside = a.z;
    shape.queue = a.w;
    const uvec4 b = fetch_scene(texel + 1u);
    shape.reflectance = colour(floats(b));
    shape.alpha = uintBitsToFloat(b.w);
    shape.eta = colour(floats(fetch_scene(texel + 2u)));
    shape.k = colour(floats(fetch_scene(texel + 3u)));
    return shape;
}

PrimitiveRecord load_primitive(uint index) {
    const uint texel = primitive_table + index * PRIMITIVE_TEXELS;
    PrimitiveRecord p;
    uvec4 t = fetch_scene(texel);
    p.a = floats(t);
    p.kind_and_shape = t.w;
    t = fetch_scene(texel + 1u);
    p.b = floats(t);
    p.light = t.w;
    t = fetch_scene(texel + 2u);
    p.c = floats(t);
    p.extra = t.w;
    t = fetch_scene(texel + 3u);
    p.normal = floats(t);
    p.offset = uintBitsToFloat(t.w);
    return p;
}

AffineRecord load_affine(uint texel) {
    AffineRecord m;
    m.row0 = uintBitsToFloat(fetch_scene(texel));
    m.row1 = uintBitsToFloat(fetch_scene(texel + 1u));
    m.row2 = uintBitsToFloat(fetch_scene(texel + 2u));
    return m;
}
vec3 transform_point(AffineRecord m, vec3 p) {
    return vec3(dot(m.row0.xyz, p) + m.row0.w, dot(m.row1.xyz, p) + m.row1.w,
                dot(m.row2.xyz, p) + m.row2.w);
}
vec3 transform_vector(AffineRecord m, vec3 v) {
    return vec3(dot(m.row0.xyz, v), dot(m.row1.xyz, v), dot(m.row2.xyz, v));
}
/// A normal of the source space, given the inverse matrix (target to source): transpose(inverse) n.
vec3 transform_normal(AffineRecord inverse, vec3 n) {
    return n.x * inverse.row0.xyz + n.y * inverse.row1.xyz + n.z * inverse.row2.xyz;
}
/// Bound on the magnitude of what a point's transform adds up.
vec3 transform_magnitude(AffineRecord m, vec3 p) {
    return vec3(dot(abs(m.row0.xyz), abs(p)) + abs(m.row0.w),
                dot(abs(m.row1.xyz), abs(p)) + abs(m.row1.w),
                dot(abs(m.row2.xyz), abs(p)) + abs(m.row2.w));
}

QuadricRecord load_quadric(uint index) {
    const uint texel = quadric_table + index * QUADRIC_TEXELS;
    QuadricRecord q;
    q.object_from_world = load_affine(texel);
    q.world_from_object = load_affine(texel + 3u);
    const vec4 a = uintBitsToFloat(fetch_scene(texel + 6u));
    const uvec4 b = fetch_scene(texel + 7u);
    q.radius = a.x;
    q.inner_radius = a.y;
    q.z_min = a.z;
    q.z_max = a.w;
    q.phi_max = uintBitsToFloat(b.x);
    q.flags = b.y;
    q.determinant = uintBitsToFloat(b.z);
    return q;
}

LightRecord load_light(uint index) {
    const uint texel = push.lights + index * LIGHT_TEXELS;
    LightRecord light;
    uvec4 t = fetch_scene(texel);
    light.position = floats(t);
    light.kind = t.w;
    t = fetch_scene(texel + 1u);
    light.radiance = colour(floats(t));
    light.probability = uintBitsToFloat(t.w);
    t = fetch_scene(texel + 2u);
    light.axis = floats(t);
    light.primitive = t.w;
    t = fetch_scene(texel + 3u);
    light.complement_start = uintBitsToFloat(t.x);
    light.complement_width = uintBitsToFloat(t.y);
    light.reach = uintBitsToFloat(t.z);
    light.size2 = uintBitsToFloat(t.w);
    return light;
}

RegionRecord load_region() {
    RegionRecord region;
    region.unit_from_world = load_affine(push.region);
    uvec4 t = fetch_scene(push.region + 3u);
    region.lower = floats(t);
    region.medium = t.w;
    region.upper = floats(fetch_scene(push.region + 4u));
    return region;
}

/// Offset from the pixel's centre along one axis, drawn from |f|, and the sign of f there. The
/// table holds cells + 1 nodes at equal steps over [-radius, radius]: density |f|, its cumulative
/// integral, and the distance beyond which f is negative. See scene/filter.h.
float sample_filter_table(uint table, uint cells, float radius, float u, out float filter_sign) {
    uint low = 0u, high = cells; // cdf[low] <= u < cdf[high]
    while (high - low > 1u) {
        const uint middle = (low + high) / 2u;
        if (uintBitsToFloat(fetch_scene(table + middle)).y <= u)
            low = middle;
        else
            high = middle;
    }
    const vec4 left = uintBitsToFloat(fetch_scene(table + low));
    const vec4 right = uintBitsToFloat(fetch_scene(table + low + 1u));
    const float width = 2.0 * radius / float(cells);
    const float mass = u - left.y;
    const float root = sqrt(max(0.0, left.x * left.x + 2.0 * mass * (right.x - left.x) / width));
    const float t = mass > 0.0 ? min(2.0 * mass / (left.x + root), width) : 0.0;
    const float x = -radius + float(low) * width + t;
    filter_sign = abs(x) > left.z ? -1.0 : 1.0;
    return x;
}

#endif

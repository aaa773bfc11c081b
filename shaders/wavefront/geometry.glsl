// Rays against the scene: the walk through the hierarchy, and the point that a ray hit.
#ifndef TYNDALL_GEOMETRY_GLSL
#define TYNDALL_GEOMETRY_GLSL

#include "wavefront/hierarchy.glsl"

struct Hit {
    float t; ///< In units of the direction; INFINITY if nothing was hit.
    uint primitive;
    uint instance; ///< NONE for primitives of the world.
};

struct SurfacePoint {
    vec3 position;
    float error;  ///< Bound on how far `position` is off the surface, along the normal.
    vec3 normal;  ///< Unit geometric normal; the outside is on its side.
    vec3 shading; ///< Unit shading normal.
    uint shape;
    uint light;        ///< Light that the primitive is, or NONE.
    uint medium_shift; ///< Added to the media of the shape (InstanceRecord).
};

/// Three steps: the balance with one primitive that is cheapest in meshes.
void descend(Ray ray, float t_max, inout Walk w) {
    if ((primitives & PRIMITIVE_TREES) == 0u) return;
    for (int i = 0; i < 3; ++i) // (a loop: some compilers take long as it is)
        step_down(ray, t_max, w);
}

/// Hits of this primitive that do not count: those beyond a distance.
struct Skip {
    uint primitive;
    uint instance;
    float beyond;
};
const Skip NO_SKIP = Skip(NONE, NONE, 0.0);

bool is_skipped(Skip skip, uint primitive, uint instance, float t) {
    return ((lights & LIGHTS_AREA) != 0u || has_contacts != 0u) && primitive == skip.primitive &&
           instance == skip.instance && t > skip.beyond;
}

/// Takes the primitive for the hit if it is one.
void take_hit(bool is_hit, float t, uint primitive, uint instance, inout Hit hit) {
    hit.t = is_hit ? t : hit.t;
    hit.primitive = is_hit ? primitive : hit.primitive;
    hit.instance = is_hit ? instance : hit.instance;
}

void walk_triangles(Ray ray, uint root, uint instance, bool any, Skip skip, inout Hit hit) {
    Walk w = start_walk(root);
    do {
        descend(ray, hit.t, w);
        const bool is_primitive = w.leaf != NONE;
        const uint i = is_primitive ? w.leaf & LEAF_FIRST_MASK : 0u;
        const uint texel = primitive_table + i * PRIMITIVE_TEXELS;
        const vec4 plane = uintBitsToFloat(fetch_scene(texel + 3u));
        float t;
        const bool is_hit =
            intersect_triangle(ray, floats(fetch_scene(texel)), floats(fetch_scene(texel + 1u)),
                               floats(fetch_scene(texel + 2u)), plane.xyz, plane.w, hit.t, t) &&
            is_primitive && !is_skipped(skip, i, instance, t);
        take_hit(is_hit, t, i, instance, hit);
        leave_primitive(any && is_hit, w);
    } while (!is_over(w));
}

bool intersect_quadric(Ray ray, uint kind, uint index, float t_max, out float t) {
    const QuadricRecord q = load_quadric(index);
    const vec3 origin = transform_point(q.object_from_world, ray.origin);
    const vec3 direction = transform_vector(q.object_from_world, ray.direction);
    float sphere_t = t_max, disk_t = t_max;
    bool sphere = false, disk = false;
    if ((primitives & PRIMITIVE_SPHERES) != 0u)
        sphere = intersect_cut_sphere(origin, direction, q, t_max, sphere_t);
    if ((primitives & PRIMITIVE_DISKS) != 0u)
        disk = intersect_disk(origin, direction, q, t_max, disk_t);
    t = kind == KIND_SPHERE ? sphere_t : disk_t;
    return kind == KIND_SPHERE ? sphere : disk;
}

/// Patches, quadrics and boxes.
void walk_others(Ray ray, uint root, uint instance, bool any, Skip skip, inout Hit hit) {
    Walk w = start_walk(root);
    do {
        descend(ray, hit.t, w);
        const bool is_primitive = w.leaf != NONE;
        const uint i = is_primitive ? w.leaf & LEAF_FIRST_MASK : 0u;
        const PrimitiveRecord p = load_primitive(i);
        const uint kind = p.kind_and_shape >> KIND_SHIFT;
        float t = INFINITY;
        bool is_hit = false;
        vec2 uv;
        if ((primitives & PRIMITIVE_PATCHES) != 0u && kind == KIND_PATCH)
            is_hit = intersect_patch(ray, p.a, p.b, p.c, p.normal, hit.t, t, uv);
        if ((primitives & PRIMITIVE_QUADRICS) != 0u && (kind == KIND_SPHERE || kind == KIND_DISK))
            is_hit = intersect_quadric(ray, kind, p.extra, hit.t, t);
        if ((primitives & PRIMITIVE_BOXES) != 0u && kind == KIND_BOX)
            is_hit = intersect_box_surface(ray, p.a, p.b, hit.t, t);
        is_hit = is_hit && is_primitive && !is_skipped(skip, i, instance, t);
        take_hit(is_hit, t, i, instance, hit);
        leave_primitive(any && is_hit, w);
    } while (!is_over(w));
}

void walk_primitives(Ray ray, uint triangle_root, uint other_root, uint instance, bool any,
                     Skip skip, inout Hit hit) {
    if ((primitives & PRIMITIVE_TRIANGLES) != 0u)
        walk_triangles(ray, triangle_root, instance, any, skip, hit);
    if ((primitives & PRIMITIVE_OTHERS) != 0u) {
        const bool is_done = any && hit.primitive != NONE;
        walk_others(ray, is_done ? NONE : other_root, instance, any, skip, hit);
    }
}

/// What the world holds itself, then the instances that the ray may hit. Each is alone in its leaf;
/// its hierarchies are walked in its own space. (One call for both: drivers inline it.)
void walk_instances(Ray ray, bool any, Skip skip, inout Hit hit) {
    Walk w = start_walk(push.instance_root);
    uint instance = NONE;
    uvec2 roots = uvec2(push.triangle_root, push.other_root);
    Ray inner = ray;
    bool goes_on;
    do {
        walk_primitives(inner, roots.x, roots.y, instance, any, skip, hit);
        if (any && hit.primitive != NONE) leave_primitive(true, w);
        do { // all the way: what follows is costly
            if ((primitives & PRIMITIVE_TREES) != 0u) step_down(ray, hit.t, w);
        } while (w.leaf == NONE && w.node != NONE);
        goes_on = w.leaf != NONE;
        if (goes_on) {
            const uint texel = primitive_table + (w.leaf & LEAF_FIRST_MASK) * PRIMITIVE_TEXELS;
            instance = fetch_scene(texel + 2u).w;
            const uint record = push.instances + instance * INSTANCE_TEXELS;
            const AffineRecord object_from_world = load_affine(record);
            roots = fetch_scene(record + 6u).xy;
            inner = make_ray(transform_point(object_from_world, ray.origin),
                             transform_vector(object_from_world, ray.direction));
            leave_primitive(false, w);
        }
    } while (goes_on);
}

/// The nearest hit within (0, t_max), or with `any` some hit.
Hit trace(vec3 origin, vec3 direction, float t_max, bool any, Skip skip) {
    Hit hit = Hit(t_max, NONE, NONE);
    const Ray ray = make_ray(origin, direction);
    if ((primitives & PRIMITIVE_INSTANCES) != 0u)
        walk_instances(ray, any, skip, hit);
    else
        walk_primitives(ray, push.triangle_root, push.other_root, NONE, any, skip, hit);
    if (hit.primitive == NONE) hit.t = INFINITY;
    return hit;
}

/// Vertex normals blended at the point; the geometric normal where they vanish.
vec3 shading_normal(PrimitiveRecord p, vec3 position, vec2 uv, vec3 normal) {
    vec3 blended;
    if (p.kind_and_shape >> KIND_SHIFT == KIND_PATCH) {
        const uint at = push.vertex_normals + p.extra;
        blended = mix(mix(floats(fetch_scene(at)), floats(fetch_scene(at + 1u)), uv.x),
                      mix(floats(fetch_scene(at + 2u)), floats(fetch_scene(at + 3u)), uv.x), uv.y);
    } else {
        const uint at = push.vertex_normals + p.extra;
        const vec3 b = p.b - p.a, c = p.c - p.a, q = position - p.a;
        const vec3 n = cross(b, c);
        const float scale = 1.0 / dot(n, n);
        const float b1 = dot(cross(q, c), n) * scale;
        const float b2 = dot(cross(b, q), n) * scale;
        blended = (1.0 - b1 - b2) * floats(fetch_scene(at)) + b1 * floats(fetch_scene(at + 1u)) +
                  b2 * floats(fetch_scene(at + 2u));
    }
    const float squared = dot(blended, blended);
    return squared > 0.0 ? blended * inversesqrt(squared) : normal;
}

/// Bound on the error along the normal of an object-space point that goes to the world and, with
/// the next ray, back. `raw_normal` is the unit object-space normal transformed, of any length.
float round_trip_error(AffineRecord world_from_object, AffineRecord object_from_world, vec3 at,
                       vec3 raw_normal, vec3 position) {
    const float scale =
        1.0 / length(raw_normal); // world lengths per object length along the normal
    const vec3 there = transform_magnitude(world_from_object, at) + abs(position);
    const vec3 back = transform_magnitude(object_from_world, position) + abs(at);
    return 8.0 * EPSILON * scale * (dot(abs(raw_normal), there) + length(back));
}

/// The point on a sphere or a disk, in the world.
void quadric_point(PrimitiveRecord p, vec3 origin, vec3 direction, float t, out vec3 position,
                   out vec3 normal, out float error) {
    const QuadricRecord q = load_quadric(p.extra);
    vec3 o = transform_point(q.object_from_world, origin);
    const vec3 d = transform_vector(q.object_from_world, direction);
    vec3 at = o + t * d;
    const bool is_sphere = p.kind_and_shape >> KIND_SHIFT == KIND_SPHERE;
    if (is_sphere)
        at *= q.radius / length(at);
    else
        at.z = q.z_min;
    position = transform_point(q.world_from_object, at);
    normal =
        normalize(p.offset * transform_normal(q.object_from_world, is_sphere ? at : vec3(0, 0, 1)));
    const vec3 raw =
        transform_normal(q.object_from_world, normalize(is_sphere ? at : vec3(0, 0, 1)));
    error = round_trip_error(q.world_from_object, q.object_from_world, at, raw, position);
}

/// The face of a box that the point is nearest to, and the point on it.
void box_point(PrimitiveRecord p, inout vec3 position, out vec3 normal, out float error) {
    const vec3 to_lower = abs(position - p.a), to_upper = abs(position - p.b);
    const vec3 to_face = min(to_lower, to_upper);
    const uint axis = to_face.x <= to_face.y && to_face.x <= to_face.z ? 0u
                      : to_face.y <= to_face.z                         ? 1u
                                                                       : 2u;
    const bool is_lower = to_lower[axis] < to_upper[axis];
    position[axis] = is_lower ? p.a[axis] : p.b[axis];
    normal = vec3(0);
    normal[axis] = is_lower ? -p.offset : p.offset;
    error = 4.0 * EPSILON * abs(position[axis]);
}

uint shape_of(uint primitive) {
    return fetch_scene(primitive_table + primitive * PRIMITIVE_TEXELS).w & SHAPE_MASK;
}

/// Where the ray hit, exactly on the primitive as far as float32 goes. The error is that of the
/// surface at the point: distances and far-away vertices play no part in it.
SurfacePoint surface_point(vec3 origin, vec3 direction, Hit hit) {
    const PrimitiveRecord p = load_primitive(hit.primitive);
    const uint kind = p.kind_and_shape >> KIND_SHIFT;
    SurfacePoint s;
    s.shape = p.kind_and_shape & SHAPE_MASK;
    s.light = p.light;
    s.medium_shift = 0u;
    AffineRecord world_from_object, object_from_world;
    const bool instanced = (primitives & PRIMITIVE_INSTANCES) != 0u && hit.instance != NONE;
    if (instanced) {
        const uint record = push.instances + hit.instance * INSTANCE_TEXELS;
        object_from_world = load_affine(record);
        world_from_object = load_affine(record + 3u);
        s.medium_shift = fetch_scene(record + 6u).z;
        origin = transform_point(object_from_world, origin);
        direction = transform_vector(object_from_world, direction);
    }
    vec2 uv = vec2(0);
    if ((primitives & PRIMITIVE_QUADRICS) != 0u && (kind == KIND_SPHERE || kind == KIND_DISK)) {
        quadric_point(p, origin, direction, hit.t, s.position, s.normal, s.error);
    } else if ((primitives & PRIMITIVE_BOXES) != 0u && kind == KIND_BOX) {
        s.position = origin + hit.t * direction;
        box_point(p, s.position, s.normal, s.error);
    } else if ((primitives & PRIMITIVE_PATCHES) != 0u && kind == KIND_PATCH) {
        float t;
        intersect_patch(make_ray(origin, direction), p.a, p.b, p.c, p.normal, FLOAT_MAX, t, uv);
        s.position = mix(mix(p.a, p.b, uv.x), mix(p.c, p.normal, uv.x), uv.y);
        const vec3 du = mix(p.b - p.a, p.normal - p.c, uv.y);
        const vec3 dv = mix(p.c - p.a, p.normal - p.b, uv.x);
        s.normal = normalize(p.offset * cross(du, dv));
        const vec3 extent = max(max(abs(p.a), abs(p.b)), max(abs(p.c), abs(p.normal)));
        s.error = 32.0 * EPSILON * dot(abs(s.normal), extent);
    } else {
        s.normal = p.normal;
        s.position = origin + hit.t * direction;
        s.position -= p.normal * (dot(p.normal, s.position) - p.offset);
        s.error = 8.0 * EPSILON * (dot(abs(p.normal), abs(s.position)) + abs(p.offset));
    }
    s.shading = s.normal;
    if (has_shading_normals != 0u && p.extra != NONE &&
        (kind == KIND_TRIANGLE || kind == KIND_PATCH))
        s.shading = shading_normal(p, s.position, uv, s.normal);
    if (instanced) {
        const vec3 at = s.position;
        const vec3 raw = transform_normal(object_from_world, s.normal);
        s.position = transform_point(world_from_object, at);
        s.normal = normalize(raw);
        s.shading = normalize(transform_normal(object_from_world, s.shading));
        s.error = s.error / length(raw) +
                  round_trip_error(world_from_object, object_from_world, at, raw, s.position);
    }
    return s;
}

/// Origin of a ray that leaves the point to the side that `direction` goes to.
vec3 leave_surface(SurfacePoint s, vec3 direction) {
    const float side = dot(direction, s.normal) < 0.0 ? -1.0 : 1.0;
    return s.position + (side * s.error) * s.normal;
}

#endif

// Next-event estimation: a point on a light, and the chance of having chosen it.
#ifndef TYNDALL_LIGHT_SAMPLING_GLSL
#define TYNDALL_LIGHT_SAMPLING_GLSL

#include "lib/light.glsl"
#include "wavefront/geometry.glsl"
#include "wavefront/light_choice.glsl"
#include "wavefront/volume.glsl"

// In LightSample::target and beside primitives, which are fewer: the medium in which the light is.
#define TARGET_MEDIUM 0x40000000u

struct LightSample {
    vec3 direction; ///< Unit, towards the light.
    float distance; ///< To the light, INFINITY for distant ones.
    vec3 radiance; ///< What arrives if nothing is in between, divided by the density of the choice.
    float
        pdf; ///< Per steradian, choice of light included; 0: only light sampling finds this light.
    uint target; ///< Primitive that the light is, TARGET_MEDIUM | medium, or NONE.
};

/// A uniform point of an emitter's surface: position, outward normal, density per area. For
/// quadrics and patches the density follows from how the map from parameters stretches area.
void sample_emitter_area(PrimitiveRecord p, float u, float v, out vec3 position, out vec3 normal,
                         out float density) {
    const uint kind = p.kind_and_shape >> KIND_SHIFT;
    if ((emitters & PRIMITIVE_PATCHES) != 0u && kind == KIND_PATCH) {
        position = mix(mix(p.a, p.b, u), mix(p.c, p.normal, u), v);
        const vec3 n = cross(mix(p.b - p.a, p.normal - p.c, v), mix(p.c - p.a, p.normal - p.b, u));
        const float stretch = length(n);
        normal = p.offset / stretch * n;
        density = 1.0 / stretch;
    } else if ((emitters & PRIMITIVE_QUADRICS) != 0u &&
               (kind == KIND_SPHERE || kind == KIND_DISK)) {
        const QuadricRecord q = load_quadric(p.extra);
        vec3 at, n;
        const float phi_turns = v * q.phi_max / (2.0 * PI);
        float area;
        if (kind == KIND_SPHERE) {
            const float z = mix(q.z_min, q.z_max, u);
            const vec2 sc =
                sin_cos_turns(phi_turns) * sqrt(max(0.0, (q.radius - z) * (q.radius + z)));
            at = vec3(sc.y, sc.x, z);
            n = at / q.radius;
            area = q.phi_max * q.radius * (q.z_max - q.z_min);
        } else {
            const float inner2 = q.inner_radius * q.inner_radius;
            const float outer2 = q.radius * q.radius;
            const vec2 sc = sin_cos_turns(phi_turns) * sqrt(mix(inner2, outer2, u));
            at = vec3(sc.y, sc.x, q.z_min);
            n = vec3(0, 0, 1);
            area = 0.5 * q.phi_max * (outer2 - inner2);
        }
        position = transform_point(q.world_from_object, at);
        const vec3 raw = transform_normal(q.object_from_world, n);
        // World area per object area is |det M| |M^-T n|.
        const float stretch = q.determinant * length(raw);
        normal = normalize(p.offset * raw);
        density = 1.0 / (area * stretch);
    } else {
        const vec3 b = sample_triangle(u, v);
        position = b.x * p.a + b.y * p.b + b.z * p.c;
        normal = p.normal;
        density = 2.0 / length(cross(p.b - p.a, p.c - p.a));
    }
}

/// Density per area at a point of the emitter (the one that sample_emitter_area states).
float emitter_area_density(PrimitiveRecord p, vec3 position, vec3 normal) {
    const uint kind = p.kind_and_shape >> KIND_SHIFT;
    if ((emitters & PRIMITIVE_PATCHES) != 0u && kind == KIND_PATCH) {
        // The patch's parameters at the point: along the normal, where the ray is best conditioned.
        const float extent = length(p.b - p.a) + length(p.c - p.a) + length(p.normal - p.a);
        float t;
        vec2 uv = vec2(0.5);
        intersect_patch(make_ray(position - extent * normal, normal), p.a, p.b, p.c, p.normal,
                        FLOAT_MAX, t, uv);
        return 1.0 / length(cross(mix(p.b - p.a, p.normal - p.c, uv.y),
                                  mix(p.c - p.a, p.normal - p.b, uv.x)));
    }
    if ((emitters & PRIMITIVE_QUADRICS) != 0u && (kind == KIND_SPHERE || kind == KIND_DISK)) {
        const QuadricRecord q = load_quadric(p.extra);
        const float area = kind == KIND_SPHERE ? q.phi_max * q.radius * (q.z_max - q.z_min)
                                               : 0.5 * q.phi_max * (q.radius - q.inner_radius) *
                                                     (q.radius + q.inner_radius);
        // |M^-T n_object| = 1 / |M^T n_world|
        const vec3 n = vec3(dot(normal, vec3(q.world_from_object.row0.x, q.world_from_object.row1.x,
                                             q.world_from_object.row2.x)),
                            dot(normal, vec3(q.world_from_object.row0.y, q.world_from_object.row1.y,
                                             q.world_from_object.row2.y)),
                            dot(normal, vec3(q.world_from_object.row0.z, q.world_from_object.row1.z,
                                             q.world_from_object.row2.z)));
        return length(n) / (area * q.determinant);
    }
    return 2.0 / length(cross(p.b - p.a, p.c - p.a));
}

/// sin^2 of the half angle that a whole, undistorted sphere subtends at the point; 2 where cone
/// sampling does not apply (a point inside, a cut or distorted sphere, another shape).
float sphere_cone(PrimitiveRecord p, vec3 from, out vec3 to_center, out float radius) {
    to_center = vec3(0);
    radius = 0.0;
    if ((emitters & PRIMITIVE_QUADRICS) == 0u || p.kind_and_shape >> KIND_SHIFT != KIND_SPHERE)
        return 2.0;
    const QuadricRecord q = load_quadric(p.extra);
    if ((q.flags & QUADRIC_SIMILARITY) == 0u || (q.flags & QUADRIC_FULL) == 0u) return 2.0;
    to_center =
        vec3(q.world_from_object.row0.w, q.world_from_object.row1.w, q.world_from_object.row2.w) -
        from;
    radius = q.radius * length(q.world_from_object.row0.xyz);
    const float squared = dot(to_center, to_center);
    // A point on the sphere is not outside by rounding.
    return squared > radius * radius * 1.0002 ? radius * radius / squared : 2.0;
}

bool emits_towards(bool two_sided, vec3 normal, vec3 direction) {
    return two_sided || dot(normal, direction) > 0.0;
}

/// Density per steradian with which light sampling at `from` would have chosen the emitter's point.
float emitter_pdf(uint light_index, vec3 from, vec3 position, vec3 normal) {
    const LightRecord light = load_light(light_index);
    const PrimitiveRecord p = load_primitive(light.primitive);
    vec3 to_center;
    float radius;
    const float sin2 = sphere_cone(p, from, to_center, radius);
    if (sin2 <= 1.0) return mis_probability(light) / (2.0 * PI * cone_complement(sin2));
    const vec3 to = position - from;
    const float squared = dot(to, to);
    const float cosine = abs(dot(normal, to)) * inversesqrt(squared);
    return mis_probability(light) * emitter_area_density(p, position, normal) * squared / cosine;
}

void sample_area_light(LightRecord light, vec3 from, float u, float v, inout LightSample s) {
    const PrimitiveRecord p = load_primitive(light.primitive);
    vec3 to_center, normal;
    float radius;
    const float sin2 = sphere_cone(p, from, to_center, radius);
    if (sin2 <= 1.0) {
        // Uniform over the cone; the near point of the sphere along that direction.
        const float complement = cone_complement(sin2) * u;
        const float sin_theta2 = complement * (2.0 - complement);
        const float center_distance = length(to_center);
        s.direction = deflect(to_center / center_distance, 1.0 - complement, sqrt(sin_theta2), v);
        const float half_chord2 = radius * radius - center_distance * center_distance * sin_theta2;
        s.distance = center_distance * (1.0 - complement) - sqrt(max(0.0, half_chord2));
        normal = p.offset * (s.direction * s.distance - to_center);
        s.pdf = light.probability / (2.0 * PI * cone_complement(sin2));
    } else {
        vec3 position;
        float density;
        sample_emitter_area(p, u, v, position, normal, density);
        const vec3 to = position - from;
        const float squared = dot(to, to);
        s.distance = sqrt(squared);
        s.direction = to / s.distance;
        s.pdf = light.probability * density * squared / abs(dot(normal, s.direction));
    }
    if (s.pdf > 0.0 && s.pdf <= FLOAT_MAX &&
        emits_towards(light.kind == LIGHT_AREA_TWO_SIDED, normal, -s.direction))
        s.radiance = light.radiance / s.pdf;
    s.target = light.primitive;
}

VoxelLightRecord load_voxel_light(uint texel) {
    VoxelLightRecord v;
    v.render_from_index = load_affine(texel);
    uvec4 t = fetch_scene(texel + 3u);
    v.lower = ivec3(t.xyz);
    v.medium = t.w;
    t = fetch_scene(texel + 4u);
    v.voxels = t.x;
    v.count = t.y;
    v.total = uintBitsToFloat(t.z);
    return v;
}

/// Distributed as a tent over (-1, 1).
float sample_tent(float u) {
    return u < 0.5 ? sqrt(2.0 * u) - 1.0 : 1.0 - sqrt(2.0 - 2.0 * u);
}

/// Density per steradian and collision with which light sampling finds emission `squared` away
/// (squared distance), over that with which a path that goes there collides: emission and
/// extinction of the voxel that was read, in the same unit. The extinction stands for the density
/// of collisions along the way; MIS needs no more than that both techniques are weighed by the same
/// function of vertex and voxel.
float voxel_light_pdf(float light_density, vec3 emission, vec3 extinction, float squared) {
    return light_density * mean(emission) * squared /
           max(extinction.x, max(extinction.y, extinction.z));
}

/// MIS weight of emission that a path comes upon `distance` after its last vertex.
float emission_weight(Path p, Field f, vec3 emission, vec3 extinction, float distance) {
    if ((lights & LIGHTS_VOXELS) == 0u || p.pdf == 0.0 || is_black(emission)) return 1.0;
    return power_heuristic(
        p.pdf, voxel_light_pdf(f.grid.light_density, emission, extinction, distance * distance));
}

/// Emission between voxels is trilinear in theirs: a voxel chosen by its emission, with an offset
/// drawn from a tent on each axis, is a point chosen by the emission.
void sample_voxel_light(LightRecord light, vec3 from, uvec4 words, inout LightSample s) {
    const VoxelLightRecord v = load_voxel_light(light.primitive);
    uint index, fraction;
    umulExtended(words.x, v.count, index, fraction);
    uvec4 cell = fetch_scene(v.voxels + index);
    if (unit_float_of_rest(words.y, words.z, words.w) >= uintBitsToFloat(cell.z))
        cell = fetch_scene(v.voxels + cell.w);
    const ivec3 voxel = v.lower + ivec3(cell.x & 0xFFFFu, cell.x >> 16, cell.y);
    const vec3 at =
        vec3(voxel) + vec3(sample_tent(unit_float(words.y)), sample_tent(unit_float(words.z)),
                           sample_tent(unit_float(words.w)));
    const Medium medium = load_medium(v.medium);
    const GridRecord grid = load_grid(medium.density_record);
    if (any(lessThan(at, grid.lower)) || any(greaterThan(at, grid.upper))) return;
    const Tap tap =
        tap_grid(medium, grid, load_bricks(grid.density == NONE ? 0u : grid.density), voxel);
    const vec3 emission = tap.sigma_a * tap.emission;
    if (is_black(emission)) return; // rounded away
    const vec3 to = transform_point(v.render_from_index, at) - from;
    const float squared = dot(to, to);
    s.distance = sqrt(squared);
    s.direction = to / s.distance;
    s.radiance = emission * (v.total / (mean(emission) * light.probability * squared));
    s.pdf =
        voxel_light_pdf(light.probability / v.total, emission, tap.sigma_a + tap.sigma_s, squared);
    s.target = TARGET_MEDIUM | v.medium;
}

/// A point of a light, for steps about it; false if it is at infinity, or everywhere in a grid.
bool light_place(LightRecord light, float u, float v, out vec3 place) {
    if ((lights & LIGHTS_AREA) != 0u &&
        (light.kind == LIGHT_AREA || light.kind == LIGHT_AREA_TWO_SIDED)) {
        vec3 normal;
        float density;
        sample_emitter_area(load_primitive(light.primitive), u, v, place, normal, density);
        return true;
    }
    place = light.position;
    return light.kind == LIGHT_POINT || light.kind == LIGHT_SPOT;
}

/// Light from a point or spot light, which light sampling chose; none exactly where it is.
void look_at_light(LightRecord light, vec3 from, inout LightSample s) {
    const vec3 to = light.position - from;
    s.distance = length(to);
    if (s.distance == 0.0) return;
    s.direction = to / s.distance;
    s.radiance = light.radiance / (light.probability * s.distance * s.distance);
    if ((lights & LIGHTS_SPOT) != 0u && light.kind == LIGHT_SPOT)
        s.radiance *= falloff_towards(light, s.direction);
}

/// Draws a light and a direction to it from `from`; `words` are those of BLOCK_LIGHT of the path's
/// event. Radiance is 0 if it does not shine here.
LightSample sample_light(Path p, vec3 from, uvec4 words, out LightRecord light) {
    float weight;
    light = choose_light(from, words, weight);
    LightSample s = LightSample(vec3(0, 0, 1), INFINITY, vec3(0), 0.0, NONE);
    if ((lights & LIGHTS_VOXELS) != 0u && light.kind == LIGHT_VOXELS) {
        sample_voxel_light(light, from, draw_random(p, BLOCK_EMISSION), s);
    } else if (lights == LIGHTS_AREA ||
               ((lights & LIGHTS_AREA) != 0u && light.kind >= LIGHT_AREA)) {
        sample_area_light(light, from, unit_float(words.y), unit_float(words.z), s);
    } else if ((lights & LIGHTS_DISTANT) != 0u && light.kind == LIGHT_DISTANT) {
        s.direction = -light.position;
        s.radiance = light.radiance / light.probability;
    } else if ((lights & (LIGHTS_POINT | LIGHTS_SPOT)) != 0u) {
        look_at_light(light, from, s);
    }
    if (light_candidates != 1u) {
        s.radiance *= weight;
        s.pdf *= mis_probability(light) / light.probability;
    }
    return s;
}
LightSample sample_light(Path p, vec3 from, uvec4 words) {
    LightRecord light;
    return sample_light(p, from, words, light);
}

#endif

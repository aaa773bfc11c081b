#version 460
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "wavefront/geometry.glsl"

// Every field of every record, as the load functions of the program find it. Vectors take one texel
// with the word that follows them; the host knows the same order.

uint at = 0u;
void put(vec3 v, float w) {
    emit(at++, vec4(v, w));
}
void put(vec3 v, uint w) {
    emit(at++, uvec4(floatBitsToUint(v), w));
}
void put(vec4 v) {
    emit(at++, v);
}
void put(uvec4 v) {
    emit(at++, v);
}
void put(AffineRecord m) {
    put(m.row0);
    put(m.row1);
    put(m.row2);
}

void put_camera() {
    const CameraRecord c = load_camera();
    put(c.origin_0, c.medium);
    put(c.direction_0, c.inverse_focal_distance);
    put(c.direction_x, c.clamp);
    put(c.direction_y, c.exposure);
    put(c.lens_u, c.filter_x_radius);
    put(c.lens_v, c.filter_y_radius);
    put(c.environment, c.filter_cells);
}

void put_surfaces() {
    const Medium m = load_medium(1u);
    put(m.sigma_a, m.phase_parameter);
    put(m.sigma_s, m.phase);
    put(m.emission, 0u);
    const ShapeRecord s = load_shape(1u);
    put(uvec4(s.flags, s.medium_inside, s.medium_outside, s.queue));
    put(s.reflectance, s.alpha);
    put(s.eta, 0u);
    put(s.k, 0u);
    const PrimitiveRecord p = load_primitive(1u);
    put(p.a, p.kind_and_shape);
    put(p.b, p.light);
    put(p.c, p.extra);
    put(p.normal, p.offset);
    const QuadricRecord q = load_quadric(1u);
    put(q.object_from_world);
    put(q.world_from_object);
    put(vec4(q.radius, q.inner_radius, q.z_min, q.z_max));
    put(uvec4(floatBitsToUint(q.phi_max), q.flags, floatBitsToUint(q.determinant), 0u));
}

void put_instances() {
    const uint record = push.instances + INSTANCE_TEXELS; // as walk_instances and surface_point do
    put(load_affine(record));
    put(load_affine(record + 3u));
    put(uvec4(fetch_scene(record + 6u).xy, 0u, 0u));
}

void put_lights() {
    const LightRecord l = load_light(1u);
    put(l.position, l.kind);
    put(l.radiance, l.probability);
    put(l.axis, l.primitive);
    put(vec4(l.complement_start, l.complement_width, 0, 0));
    put(uvec4(fetch_scene(push.alias_table + 1u).xy, 0u, 0u)); // as sample_light does
    const RegionRecord r = load_region();
    put(r.unit_from_world);
    put(r.lower, r.medium);
    put(r.upper, 0u);
}

void put_push() {
    const PushConstants p = push;
    put(uvec4(p.seed, p.slot_count, p.run_length));
    put(uvec4(p.width, p.pixel_count, p.x0, p.y0));
    put(uvec4(p.full_width, p.max_depth, p.first_sample, p.end_sample));
    put(uvec4(p.first_piece, p.piece_count, p.window, p.filter_table));
    put(uvec4(p.media, p.shapes, p.primitives, p.nodes));
    put(uvec4(p.vertex_normals, p.quadrics, p.instances, p.lights));
    put(uvec4(p.light_count, p.region, p.triangle_root, p.other_root));
    put(uvec4(p.instance_root, p.alias_table, floatBitsToUint(p.roulette_scale), 0u));
}

uint count = 1u;
DispatchSize next_size() {
    const DispatchSize size = DispatchSize(count, count + 1u, count + 2u);
    count += 3u;
    return size;
}

void fill_control() {
    for (uint i = 0u; i < QUEUE_COUNT; ++i)
        control.queue_dispatch[i] = next_size();
    control.slot_dispatch = next_size();
    control.fold_dispatch = next_size();
    for (uint i = 0u; i < QUEUE_COUNT; ++i)
        control.queue_size[i] = count++;
    for (uint i = 0u; i < QUEUE_COUNT; ++i)
        control.queue_total[i] = count++;
    control.slot_rounds = count++;
    control.next_ticket = count++;
    control.ticket_limit = count++;
    control.folded_pieces = count++;
    control.fold_count = count++;
    control.fold_limit = count++;
    control.fold_least = count++;
    for (uint i = 0u; i < uint(PIECE_WINDOW_MAX); ++i)
        control.finished[i] = count++;
    for (uint i = 0u; i < uint(HEALTH_COUNT); ++i)
        control.health[i] = count++;
    for (uint i = 0u; i < uint(HEALTH_COUNT); ++i)
        control.health_pixel[i] = count++;
    for (uint i = 0u; i < uint(HEALTH_COUNT); ++i)
        control.health_sample[i] = count++;
    control.worst_majorant_ratio = count++;
    control.lost_throughput_low = count++;
    control.lost_throughput_high = count++;
    for (uint i = 0u; i < SAMPLE_BINS; ++i)
        control.sample_histogram[i] = count++;
}

/// From node 1, with a ray along +z from the point at push.media + i.
void walk_node(uint i) {
    const Ray ray = make_ray(input_texel(push.media + i).xyz, vec3(0, 0, 1));
    Walk w = start_walk(1u);
    step_down(ray, INFINITY, w);
    emit(i, uvec4(w.leaf, w.node, 0u, 0u));
}

void main() {
    if (is_idle()) return;
    if (wanted() == 0u) {
        put_camera();
        put_surfaces();
        put_instances();
        put_lights();
    } else if (wanted() == 1u) {
        put_push();
    } else if (wanted() == 2u) {
        fill_control();
    } else {
        walk_node(local_index());
    }
}

// The phase function of a medium: one in closed form, a table, or a mixture of such.
//
// Loops that look things up test at their head: SwiftShader computes what a loop's body computes
// for lanes that have left it, too, from lookups that give 0 for them; variables that the head has
// seen keep their values (tests: PhaseKinds; the slab on voxels of `tyndall selftest`).
//
// Where channels have functions of their own, the hero's is sampled. Values are by channel; each is
// the density with which that channel would have drawn the direction as a hero (lib/medium.glsl on
// r).
#ifndef TYNDALL_PHASES_GLSL
#define TYNDALL_PHASES_GLSL

#include "lib/phase.glsl"
#include "wavefront/health.glsl"
#include "wavefront/scene.glsl"

/// Whether the angle with these complements is at least that of a node (PhaseTableRecord: place).
bool is_past(float place, vec2 complements) {
    return place >= 0.0 ? complements.x >= place : complements.y <= -place;
}

/// From one node to the next, in mu.
float segment_width(float place0, float place1) {
    return place1 - place0 + (place0 >= 0.0 && place1 < 0.0 ? 2.0 : 0.0);
}

/// By channel, linear between nodes. Nodes are at known angles: the first guess is right or next to
/// it.
vec3 evaluate_table(uint table, vec2 complements) {
    const uint nodes = table + 1u;
    const uint last = fetch_scene(table).x - 2u;
    const float turn = atan(sqrt(complements.x), sqrt(complements.y)) * (2.0 / PI); // theta / pi
    uint i = min(uint(float(last + 1u) * sqrt(turn)), last);
    vec4 left, right;
    bool is_before = true, is_after = true;
    while (is_before || is_after) {
        left = uintBitsToFloat(fetch_scene(nodes + i));
        right = uintBitsToFloat(fetch_scene(nodes + i + 1u));
        is_before = i > 0u && !is_past(left.x, complements);
        is_after = i < last && is_past(right.x, complements);
        i = is_before ? i - 1u : is_after ? i + 1u : i;
    }
    const float along = left.x >= 0.0 ? complements.x - left.x : -left.x - complements.y;
    return mix(left.yzw, right.yzw, along / segment_width(left.x, right.x));
}

/// Inverts the CDF of the channel. The density is linear in a segment: the root of a quadratic.
vec2 sample_table(uint table, uint channel, float xi) {
    const uint nodes = table + 1u;
    const uint node_count = fetch_scene(table).x;
    const float target = 1.0 - xi;         // exact; the CDF runs from forward to backward
    uint low = 0u, high = node_count - 1u; // cdf[low] <= target < cdf[high]
    while (high - low > 1u) {
        const uint middle = (low + high) / 2u;
        const bool is_below =
            uintBitsToFloat(fetch_scene(nodes + node_count + middle)[channel]) <= target;
        low = is_below ? middle : low;
        high = is_below ? high : middle;
    }
    const vec4 left = uintBitsToFloat(fetch_scene(nodes + low));
    const vec4 right = uintBitsToFloat(fetch_scene(nodes + low + 1u));
    const float before = uintBitsToFloat(fetch_scene(nodes + node_count + low)[channel]);
    const float v0 = left[channel + 1u], v1 = right[channel + 1u];
    const float width = segment_width(left.x, right.x);
    const float mass = (target - before) * (0.5 / PI);
    const float root = sqrt(max(0.0, v0 * v0 + 2.0 * mass * (v1 - v0) / width));
    const float along = mass > 0.0 ? min(2.0 * mass / (v0 + root), width) : 0.0;
    return left.x >= 0.0 ? vec2(left.x + along, 2.0 - left.x - along)
                         : vec2(2.0 + left.x + along, max(0.0, -left.x - along));
}

vec3 evaluate_single_phase(uint phase, float parameter, vec3 from, vec3 to) {
    const uint kind = phase >> PHASE_KIND_SHIFT;
    if (is_phase(kind, PHASE_TABLE))
        return colour(evaluate_table(phase & PHASE_TEXEL_MASK, complements_between(from, to)));
    return vec3(evaluate_closed_phase(kind, parameter, from, to));
}

vec2 sample_single_phase(uint phase, float parameter, uint hero, float xi) {
    const uint kind = phase >> PHASE_KIND_SHIFT;
    if (is_phase(kind, PHASE_TABLE)) return sample_table(phase & PHASE_TEXEL_MASK, hero, xi);
    return sample_closed_phase(kind, parameter, xi);
}

bool is_mixture(Medium medium) {
    return has_mixtures != 0u && medium.phase >> PHASE_KIND_SHIFT == PHASE_MIXTURE;
}

PhaseComponentRecord load_phase_component(uint texel) {
    const uvec4 t = fetch_scene(texel);
    return PhaseComponentRecord(uintBitsToFloat(t.x), uintBitsToFloat(t.y), uintBitsToFloat(t.z),
                                t.w);
}

/// Density of scattering from direction of travel `from` to `to`, by channel; 0 for a delta.
vec3 evaluate_phase(Medium medium, vec3 from, vec3 to) {
    if (phases == 0u) return vec3(0.25 / PI);
    if (!is_mixture(medium))
        return evaluate_single_phase(medium.phase, medium.phase_parameter, from, to);
    vec3 sum = vec3(0);
    uint texel = medium.phase & PHASE_TEXEL_MASK;
    float share = 0.0;
    while (share < 1.0) {
        const PhaseComponentRecord c = load_phase_component(texel);
        sum += c.weight * evaluate_single_phase(c.phase, c.parameter, from, to);
        share = c.share;
        ++texel;
    }
    return sum;
}

/// Draws the direction after scattering. Its density, for the hero's channel, is evaluate_phase. In
/// a mixture the same number chooses the component and then, stretched, the angle.
vec3 sample_phase(Medium medium, uint hero, vec3 from, float xi, float azimuth) {
    if (phases == 0u) return deflect(from, 2.0 * xi - 1.0, 2.0 * sqrt(xi * (1.0 - xi)), azimuth);
    const uint channel = has_chromatic_phases != 0u ? hero : 0u;
    uint phase = medium.phase;
    float parameter = medium.phase_parameter;
    if (is_mixture(medium)) {
        uint texel = phase & PHASE_TEXEL_MASK;
        bool is_chosen = false;
        while (!is_chosen) {
            const PhaseComponentRecord c = load_phase_component(texel);
            is_chosen = xi < c.share || c.share >= 1.0;
            xi = is_chosen ? min(xi / c.share, 1.0) : (xi - c.share) / (1.0 - c.share);
            phase = c.phase;
            parameter = c.parameter;
            ++texel;
        }
    }
    if (is_delta_phase(phase >> PHASE_KIND_SHIFT, parameter)) return parameter > 0.0 ? from : -from;
    const vec2 complements = sample_single_phase(phase, parameter, channel, xi);
    if ((phases & PHASE_BIT_TABLE) != 0u) // of closed forms, such a cosine gives no direction
        note_mishap(HEALTH_COSINE, max(complements.x, complements.y) > 1.0 + COSINE_MAX);
    return deflect_by(from, complements, azimuth);
}

/// The density with which scattering draws a direction, whichever channel is the hero.
float phase_density(vec3 value, vec3 r) {
    return has_chromatic_phases != 0u ? mean(r * value) : value.x;
}

#endif

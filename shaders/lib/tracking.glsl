// Geometry of tracking through cells and height fields. Pure functions.
#ifndef TYNDALL_TRACKING_GLSL
#define TYNDALL_TRACKING_GLSL

#include "lib/sampling.glsl"

/// The part of a line within a box, cut to [0, t_max]; false if there is none. A component of the
/// direction that is 0 neither enters nor leaves: no 0 * inf.
bool clip_to_box(vec3 origin, vec3 direction, vec3 lower, vec3 upper, float t_max, out float t0,
                 out float t1) {
    const bvec3 is_parallel = equal(direction, vec3(0));
    const vec3 a = (lower - origin) / direction, b = (upper - origin) / direction;
    const vec3 entry = mix(min(a, b), vec3(0), is_parallel);
    const vec3 exit = mix(max(a, b), vec3(INFINITY), is_parallel);
    t0 = max(0.0, max(entry.x, max(entry.y, entry.z)));
    t1 = min(t_max, min(exit.x, min(exit.y, exit.z)));
    const vec3 outside = max(lower - origin, origin - upper);
    return t0 < t1 && !any(greaterThan(mix(vec3(0), outside, is_parallel), vec3(0)));
}

/// A walk over cubic cells of edge `size` that start at `lower`, along a line. Boundaries are
/// computed from cell indices and not added up, so that nothing drifts.
struct CellWalk {
    vec3 origin; ///< In cells: (index - lower) / size
    vec3 direction;
    vec3 inverse; ///< Of the direction.
    ivec3 step;
    ivec3 cell;
};

/// The walk before it has a cell.
CellWalk make_cells(vec3 origin, vec3 direction, vec3 lower, float size) {
    CellWalk walk;
    walk.origin = (origin - lower) / size;
    walk.direction = direction / size;
    walk.inverse = size / direction;
    walk.step = ivec3(sign(direction));
    return walk;
}

/// The cell at distance t; the point is in the cells up to rounding.
ivec3 cell_at(CellWalk walk, ivec3 count, float t) {
    return clamp(ivec3(floor(walk.origin + t * walk.direction)), ivec3(0), count - 1);
}

/// Distance at which the line leaves the present cell, and the step through that face.
float cell_exit(CellWalk walk, out ivec3 step) {
    const vec3 face = vec3(walk.cell + max(walk.step, ivec3(0)));
    const vec3 t =
        mix((face - walk.origin) * walk.inverse, vec3(INFINITY), equal(walk.step, ivec3(0)));
    const bool in_x = t.x <= t.y && t.x <= t.z, in_y = !in_x && t.y <= t.z;
    step = walk.step * ivec3(in_x, in_y, !in_x && !in_y);
    return min(t.x, min(t.y, t.z));
}

/// Whether a tap reads the upper voxel of two, by a uniform number whose rest serves the next axis.
bool choose_upper(float f, inout float u) {
    const bool upper = u < f;
    u = upper ? u / f : (u - f) / (1.0 - f);
    return upper;
}

/// The voxel that a stochastic trilinear tap at a point of index space reads, by one uniform
/// number.
ivec3 choose_corner(vec3 index, float u) {
    const vec3 base = floor(index);
    const vec3 f = index - base;
    bvec3 upper;
    upper.x = choose_upper(f.x, u);
    upper.y = choose_upper(f.y, u);
    upper.z = choose_upper(f.z, u);
    return ivec3(base) + ivec3(upper);
}

/// Integral of exp(-h / H) over [0, t] along a line that starts at height h0 and rises by m per
/// unit. Source: ORACLES 3.1; expm1 form, so that the horizon (m = 0) is no exception.
float exponential_column(float h0, float m, float scale_height, float t) {
    // Seen from the lower end, where the density is greatest, it only falls.
    const float fall = abs(m) / scale_height; // 1 / length of the fall-off along the line
    const float greatest = exp(-(m < 0.0 ? h0 + m * t : h0) / scale_height);
    const float x = fall > 0.0 ? fall * t : 0.0;
    if (!(greatest > 0.0)) return 0.0;
    if (x < 1e-3) return greatest * t * (1.0 - x * (0.5 - x * (1.0 / 6.0)));
    return greatest * one_minus_exp(x) / fall;
}

/// The distance at which the column is reached; INFINITY if it never is.
float exponential_column_inverse(float h0, float m, float scale_height, float column) {
    const float x = m / scale_height;
    const float density = exp(-h0 / scale_height);
    // Column in lengths of the fall-off, over the density at the start, which may be out of range:
    // a line may come down from far above.
    const float log_ratio = log(column) + h0 / scale_height;
    const bool is_in_range = density > 1e-30 && density < 1e30;
    const float ratio = is_in_range ? column / density : exp(log_ratio);
    const float q = ratio * x;
    if (x == 0.0) return ratio;
    if (abs(q) < 1e-3) return ratio * (1.0 + q * (0.5 + q * (1.0 / 3.0)));
    if (q >= 1.0) return INFINITY;
    // -log1p(-q) / x
    return q > -1e30 ? -log(1.0 - q) / x : (log_ratio + log(-x)) / -x;
}

#endif

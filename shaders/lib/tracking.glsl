// Geometry of tracking through cells and height fields. Pure functions.
#ifndef TYNDALL_TRACKING_GLSL
#define TYNDALL_TRACKING_GLSL

#include "lib/sampling.glsl"

/// The part of a line within a box, cut to [0, t_max]; false if there is none. A component of the
/// direction that is 0 neither enters nor leaves: no 0 * inf.
bool clip_to_box(vec3 origin, vec3 direction, vec3 lower, vec3 upper, float t_max, out float t0,
                 out float t1) {
    t0 = 0.0;
    t1 = t_max;
    bool meets = true;
    for (int axis = 0; axis < 3; ++axis) {
        const float a = (lower[axis] - origin[axis]) / direction[axis];
        const float b = (upper[axis] - origin[axis]) / direction[axis];
        const bool is_parallel = direction[axis] == 0.0;
        const bool is_inside = origin[axis] >= lower[axis] && origin[axis] <= upper[axis];
        t0 = is_parallel ? t0 : max(t0, min(a, b));
        t1 = is_parallel ? t1 : min(t1, max(a, b));
        meets = meets && (!is_parallel || is_inside);
    }
    return meets && t0 < t1;
}

/// A walk over cubic cells of edge `size` that start at `lower`, along a line. Boundaries are
/// computed from cell indices and not added up, so that nothing drifts.
struct CellWalk {
    vec3 origin; ///< In cells: (index - lower) / size
    vec3 direction;
    ivec3 cell;
    ivec3 step;
};

/// The walk at distance t; the point is in the cells up to rounding.
CellWalk begin_cells(vec3 origin, vec3 direction, vec3 lower, float size, ivec3 count, float t) {
    CellWalk walk;
    walk.origin = (origin - lower) / size;
    walk.direction = direction / size;
    walk.cell = clamp(ivec3(floor(walk.origin + t * walk.direction)), ivec3(0), count - 1);
    walk.step = ivec3(sign(direction));
    return walk;
}

/// Distance at which the line leaves the present cell, and the axis through whose face it does.
float cell_exit(CellWalk walk, out int axis) {
    const vec3 face = vec3(walk.cell + max(walk.step, ivec3(0)));
    const vec3 t =
        mix((face - walk.origin) / walk.direction, vec3(INFINITY), equal(walk.step, ivec3(0)));
    axis = t.x <= t.y && t.x <= t.z ? 0 : t.y <= t.z ? 1 : 2;
    return t[axis];
}

/// The voxel that a stochastic trilinear tap at a point of index space reads, chosen by one uniform
/// number whose rest serves the next axis.
ivec3 choose_corner(vec3 index, float u) {
    const vec3 base = floor(index);
    const vec3 f = index - base;
    ivec3 corner = ivec3(base);
    for (int axis = 0; axis < 3; ++axis) {
        const bool upper = u < f[axis];
        u = upper ? u / f[axis] : (u - f[axis]) / (1.0 - f[axis]);
        corner[axis] += upper ? 1 : 0;
    }
    return corner;
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

// The walk of a ray through a hierarchy of boxes (src/render/bvh.h).
//
// A CPU driver executes all that stands in a loop for every lane, taken or not, and stores to
// arrays lane by lane, which costs more than the rest of a step. So walks are straight-line code,
// and what waits is in registers, as far as they go. Where more has to wait, the walk forgets it,
// and finds it again from the root by a trail of what is done (Laine 2010, "Restart Trail for
// Stackless BVH Traversal").
#ifndef TYNDALL_HIERARCHY_GLSL
#define TYNDALL_HIERARCHY_GLSL

#include "lib/intersect.glsl"
#include "wavefront/scene.glsl"

struct Walk {
    uint table; ///< push.nodes: a load in a loop costs each time.
    uint root;
    uint node;     ///< Where it is, or NONE at its end. A leaf waits here until `leaf` is used up.
    uint leaf;     ///< Whose primitives come next, or NONE.
    uint level;    ///< The bit of the node's level: the highest is the root's.
    uint trail;    ///< Bits of the levels on which no sibling of the way to the node waits.
    uint turn;     ///< Bit of the level on which the way last turned to the sibling.
    uvec4 waiting; ///< Siblings that wait, the lowest first; NONE if unknown.
};

const uint ROOT_LEVEL = 1u << BVH_DEPTH_MAX;

Walk start_walk(uint root) {
    if ((primitives & PRIMITIVE_TREES) == 0u)
        return Walk(push.nodes, root, NONE, root, ROOT_LEVEL, 0u, 0u, uvec4(NONE));
    return Walk(push.nodes, root, root, NONE, ROOT_LEVEL, 0u, 0u, uvec4(NONE));
}

bool is_over(Walk w) {
    return w.node == NONE && w.leaf == NONE;
}

bool is_leaf(uint node) {
    return (node & LEAF) != 0u && node != NONE;
}

/// If `turns`: to the lowest sibling that waits, or to the end. If `waits`: the sibling waits.
void move_on(bool turns, bool waits, uint sibling, inout Walk w) {
    const uint trail = (w.trail & -w.level) + w.level;
    const uint lowest = trail & -trail;
    const bool is_end = (trail & ROOT_LEVEL) != 0u;
    const bool restarts = w.waiting.x == NONE;
    w.trail = turns ? trail : w.trail;
    w.turn = turns ? lowest : w.turn;
    w.level = !turns ? w.level : restarts ? ROOT_LEVEL : lowest;
    w.node = !turns ? w.node : is_end ? NONE : restarts ? w.root : w.waiting.x;
    w.waiting = waits   ? uvec4(sibling, w.waiting.xyz)
                : turns ? uvec4(w.waiting.yzw, NONE)
                        : w.waiting;
}

/// One step down: to the nearer child that the ray may hit, or to what waits. The first leaf
/// becomes that whose primitives come next.
void step_down(Ray ray, float t_max, inout Walk w) {
    const bool is_inner = (w.node & LEAF) == 0u;
    const uint texel = w.table + (is_inner ? w.node : 0u) * NODE_TEXELS;
    const uvec4 a = fetch_scene(texel);
    vec2 t;
    const bvec2 hits = intersect_node(ray, a, fetch_scene(texel + 1u), t_max, t);
    const bool any = is_inner && (hits.x || hits.y), both = is_inner && hits.x && hits.y;
    const bool swaps = hits.y && (!hits.x || t.y < t.x);
    const uint near = swaps ? a.y : a.x, far = swaps ? a.x : a.y;

    w.level = any ? w.level >> 1 : w.level;
    const bool near_is_done = (w.trail & w.level) != 0u;
    // Where the way turns there were two. If one is left, the ray has become shorter: the far one
    // is gone.
    const bool stays = both || (any && w.level != w.turn) || !is_inner;
    const uint next = !is_inner ? w.node : both && near_is_done ? far : near;
    const bool has_sibling = both && !near_is_done;
    const bool takes = stays && is_leaf(next) && w.leaf == NONE;
    const bool is_alone = (any && stays && !both) || (takes && has_sibling);
    w.leaf = takes ? next : w.leaf;
    w.trail |= is_alone ? w.level : 0u;
    const bool turns = w.node != NONE && (takes ? !has_sibling : !stays);
    w.node = takes ? far : next;
    move_on(turns, has_sibling && !takes, far, w);
}

/// To the next primitive of the leaf, or to the end.
void leave_primitive(bool ends, inout Walk w) {
    const bool is_last = (w.leaf & ~LEAF) >> LEAF_COUNT_SHIFT == 0u;
    const uint rest = w.leaf - (1u << LEAF_COUNT_SHIFT) + 1u;
    w.leaf = w.leaf == NONE || is_last || ends ? NONE : rest;
    w.node = ends ? NONE : w.node;
}

#endif

// The definition of Tyndall's random numbers, shared by the device and the reference renderer, so
// that with the same seed both trace the same paths.
//
// A random number is a pure function of (seed, pixel, sample, event, block, word). Nothing is
// stored; any path can be replayed; no result depends on how the work was scheduled.
//
// Where a scene calls for Sobol' points, BLOCK_PATH and BLOCK_LIGHT have theirs (sobol.h), by the
// same key; but event 0 takes its words in another order.
//
// An event is one segment of a path together with what happens at its end (a collision, a surface,
// an interface, an escape). Event 0 is the camera; the first segment is event 1. Each event has two
// blocks of four words:
//
//   event 0   BLOCK_PATH   0, 1: position in the pixel filter   2, 3: position on the lens
//             BLOCK_LIGHT  0: hero channel (chromatic media only)
//   event n   BLOCK_PATH   0: free flight (full 32 bits)        1, 2: direction (phase or BSDF)
//                          3: Russian roulette
//             BLOCK_LIGHT  0: choice of light                   1, 2: position on the light
//                          3: reflection or transmission; absorption or scattering (analog)
//
// Where a light is chosen among n candidates, word 0 draws the first of them, and the same word
// i / n of its range further on draws another; the low eight bits of words 1, 2 and 3 choose.
//
// Light that is looked for on a segment that a path passes without a collision
// (wavefront/passing.glsl) has an event of its own, n | EVENT_PASSING for the segment of event n:
// BLOCK_LIGHT 0: choice of light, 1: place on the segment. The low eight bits of word 3 of
// BLOCK_PATH of event n, which roulette leaves, say whether the path looks for any.
//
// In a march each step is an event: BLOCK_PATH 0: place in the step; 1, 2: direction of scattering
// towards the environment; BLOCK_LIGHT as above, with 3: whether the environment is asked.
//
// In a medium that is tracked (voxels, spherical atmosphere) each tentative collision is an event
// of its own: BLOCK_PATH 0: optical distance, 1: corner of the trilinear tap, 2: real or null. A
// real one is scattered in the next event, whose word 0 is not used.
//
// A voxel that shines, chosen as a light, uses block BLOCK_EMISSION: 0: choice of voxel, its
// fraction being the low eight bits of words 1, 2, 3, whose upper 24 bits are the place around the
// voxel on each axis.
//
// Flight i of a shadow ray through such media, counted over the whole ray, uses block BLOCK_SHADOW
// + i of the event that cast it: 0: optical distance, 1: corner, 2: roulette. A flight that leaves
// its medium without a collision counts, too: what it has told of its optical distance must not
// decide about the next.
#ifndef TYNDALL_RANDOM_H
#define TYNDALL_RANDOM_H

#include "interop.h"

TYNDALL_SHARED_BEGIN

// Of Russian roulette: a path survives with this times its throughput. The environment is found by
// paths that leave, and where that is all, they have no noise but what roulette adds. Other light
// is found bit by bit on the way, and little of it so late.
TYNDALL_CONSTANT float ROULETTE_SCALE_IN_ENVIRONMENT = 8.0f;
TYNDALL_CONSTANT float ROULETTE_SCALE = 2.0f;
/// Transmittance of a medium below which ratio tracking goes on for some of the shadow rays alone,
/// with this: what is left is little light, and most of the way.
TYNDALL_CONSTANT float SHADOW_ROULETTE = 0.1f;

// Of 256 paths that pass a segment without a collision, how many look for light there: this many
// per optical depth of scattering, but some at least, as a light may be near; fewer late on a path,
// as where paths are long, media are dense or light is everywhere; and none where there is so much
// of the medium that hardly any path passes.
TYNDALL_CONSTANT float LOOKOUTS_PER_DEPTH = 1024.0f;
TYNDALL_CONSTANT float LOOKOUTS_MIN = 32.0f;
TYNDALL_CONSTANT float LOOKOUTS_MAX = 256.0f;
TYNDALL_CONSTANT float LOOKOUT_DEPTH_MAX = 4.0f;
TYNDALL_CONSTANT uint LATE_EVENT = 8u; // from the next on,
TYNDALL_CONSTANT float LATE_SHARE = 0.5f;

TYNDALL_CONSTANT uint EVENT_PASSING = 0x40000000u; // above all limits of events

TYNDALL_CONSTANT uint BLOCK_PATH = 0u;
TYNDALL_CONSTANT uint BLOCK_LIGHT = 1u;
TYNDALL_CONSTANT uint BLOCK_SHADOW = 2u;
TYNDALL_CONSTANT uint BLOCK_EMISSION = 0x80000000u;

// Seven rounds is the fewest that pass BigCrush with no failure (Salmon et al. 2011, "Parallel
// Random Numbers: As Easy as 1, 2, 3", table 2); the known answers of the paper are for ten.
TYNDALL_CONSTANT int PHILOX_ROUNDS = 7;

/// Philox4x32: four random words from a 128-bit counter and a 64-bit key (Salmon et al. 2011).
TYNDALL_SHARED_INLINE uvec4 philox(uvec4 counter, uvec2 key, int rounds) {
    for (int i = 0; i < rounds; ++i) {
        uint high0, low0, high1, low1;
        umulExtended(0xD2511F53u, counter.x, high0, low0);
        umulExtended(0xCD9E8D57u, counter.z, high1, low1);
        counter = uvec4(high1 ^ counter.y ^ key.x, low1, high0 ^ counter.w ^ key.y, low0);
        key = uvec2(key.x + 0x9E3779B9u, key.y + 0xBB67AE85u);
    }
    return counter;
}

/// The four random words of one block of one event of one path.
TYNDALL_SHARED_INLINE uvec4 random_block(uvec2 seed, uint pixel, uint path_sample, uint event,
                                         uint block) {
    return philox(uvec4(event, block, path_sample, pixel), seed, PHILOX_ROUNDS);
}

/// A word as a number in [0, 1): its upper 24 bits, exact in float32.
TYNDALL_SHARED_INLINE float unit_float(uint word) {
    return float(word >> 8) * (1.0f / 16777216.0f);
}

/// A number in [0, 1) from the bits of three words that unit_float leaves.
TYNDALL_SHARED_INLINE float unit_float_of_rest(uint a, uint b, uint c) {
    return float((a & 255u) << 16 | (b & 255u) << 8 | (c & 255u)) * (1.0f / 16777216.0f);
}

TYNDALL_SHARED_END

#endif

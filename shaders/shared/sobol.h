// Sobol' points with Owen's scrambling, by hashes alone (Burley 2020, "Practical Hash-based Owen
// Scrambling"): the random words of a sampler that spreads the samples of a pixel evenly.
//
// The words of a block are two pairs, (0, 3) and (1, 2). Over the samples of a pixel, each pair is
// the first two dimensions of Sobol's sequence: any 2^m samples that begin at a multiple of 2^m
// have one point in each rectangle of area 2^-m that halving makes. Each pair and each block has an
// order and a scrambling of its own, by which it is independent of all others ("padding"): so paths
// of any length have as many dimensions as they need, and none is worse than another.
#ifndef TYNDALL_SOBOL_H
#define TYNDALL_SOBOL_H

#include "interop.h"

TYNDALL_SHARED_BEGIN

/// Four words by hashing four (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering").
TYNDALL_SHARED_INLINE uvec4 pcg4d(uvec4 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v = v ^ (v >> 16u);
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

/// Owen's nested uniform scrambling of a fraction whose bits are in reverse, the first being the
/// lowest: each is flipped as those before it say (Laine and Karras 2011; these steps by Vegdahl
/// 2021, "Building a Better LK Hash").
TYNDALL_SHARED_INLINE uint scramble_reversed(uint x, uint seed) {
    x ^= x * 0x3D20ADEAu;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526C56u;
    x ^= x * 0x53A22864u;
    return x;
}

/// The second dimension of Sobol's sequence at an index, its bits in reverse; the first is the
/// index itself. Bit j is the parity of all bits k of which k choose j is odd, which are those
/// where k has the bits of j.
TYNDALL_SHARED_INLINE uint reversed_sobol(uint index) {
    index ^= index >> 16;
    index ^= (index & 0xFF00FF00u) >> 8;
    index ^= (index & 0xF0F0F0F0u) >> 4;
    index ^= (index & 0xCCCCCCCCu) >> 2;
    index ^= (index & 0xAAAAAAAAu) >> 1;
    return index;
}

/// The four words of block 0 or 1 of an event (below 2^31) of one path, as random_block (random.h).
TYNDALL_SHARED_INLINE uvec4 sobol_block(uvec2 seed, uint pixel, uint path_sample, uint event,
                                        uint block) {
    const uvec4 s = pcg4d(uvec4(seed.x, seed.y, pixel, event << 1u | block));
    const uint order = bitfieldReverse(path_sample);
    const uint a = bitfieldReverse(scramble_reversed(order, s.y ^ s.z));
    const uint b = bitfieldReverse(scramble_reversed(order, s.x ^ s.w));
    return uvec4(bitfieldReverse(scramble_reversed(a, s.x)),
                 bitfieldReverse(scramble_reversed(b, s.y)),
                 bitfieldReverse(scramble_reversed(reversed_sobol(b), s.z)),
                 bitfieldReverse(scramble_reversed(reversed_sobol(a), s.w)));
}

/// The bits of x and y (below 2^16) in turns, those of x being the lower ones.
TYNDALL_SHARED_INLINE uint morton_code(uint x, uint y) {
    uvec2 v = uvec2(x, y);
    v = (v | v << 8u) & 0x00FF00FFu;
    v = (v | v << 4u) & 0x0F0F0F0Fu;
    v = (v | v << 2u) & 0x33333333u;
    v = (v | v << 1u) & 0x55555555u;
    return v.x | v.y << 1u;
}

/// As sobol_block, on one sequence for all pixels in the order of their Morton codes, of which each
/// has 2^bits (0 to 31) points (Ahmed and Wonka 2020, "Screen-Space Blue-Noise Diffusion of Monte
/// Carlo Sampling Error via Hierarchical Ordering of Pixels"): then squares of pixels together have
/// points that are spread evenly, too, and their errors cancel. A pixel that takes more samples has
/// them from other sequences, as have squares of 2^(32 - bits) pixels.
TYNDALL_SHARED_INLINE uvec4 zsobol_block(uvec2 seed, uint morton, uint path_sample, uint event,
                                         uint block, uint bits) {
    const uint round = path_sample >> bits << bits;
    return sobol_block(seed, morton >> 1u >> (31u - bits) | round,
                       morton << bits | (path_sample - round), event, block);
}

/// The words of event 0 in another order, so that (0, 1) and (2, 3) are the pairs.
TYNDALL_SHARED_INLINE uvec4 pairs_in_order(uvec4 words) {
    return uvec4(words.y, words.z, words.x, words.w);
}

TYNDALL_SHARED_END

#endif

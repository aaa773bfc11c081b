// What shaders/selftest/evaluate.comp can evaluate, for both compilers: a function of the texel of
// arguments a.
#ifndef TYNDALL_SELFTEST_FUNCTIONS_H
#define TYNDALL_SELFTEST_FUNCTIONS_H

#include "interop.h"

TYNDALL_SHARED_BEGIN

TYNDALL_CONSTANT uint FUNCTION_PHILOX = 0u;      // counter a: four words, of ten rounds with key 0
TYNDALL_CONSTANT uint FUNCTION_EXPONENTIAL = 1u; // word: upper half a.x, lower a.y
TYNDALL_CONSTANT uint FUNCTION_SINES = 2u;       // sin and cos of a.x turns
TYNDALL_CONSTANT uint FUNCTION_ONE_MINUS_EXP = 3u; // of a.x
TYNDALL_CONSTANT uint FUNCTION_ATTENUATION = 4u;   // coefficient a.x, distance a.y
TYNDALL_CONSTANT uint FUNCTION_HG_DRAW = 5u;       // g = a.x, xi = a.y: 1 - mu, 1 + mu
TYNDALL_CONSTANT uint FUNCTION_SCHLICK_DRAW = 6u;  // likewise, with k
TYNDALL_CONSTANT uint FUNCTION_RAYLEIGH_DRAW = 7u; // xi = a.y
TYNDALL_CONSTANT uint FUNCTION_HG_VALUE = 8u;      // from +z to a.xyz, g = a.w
TYNDALL_CONSTANT uint FUNCTION_SCHLICK_VALUE = 9u; // likewise, with k
TYNDALL_CONSTANT uint FUNCTION_FRESNEL = 10u;      // eta = a.x, cosine = a.y, entering if a.z != 0
TYNDALL_CONSTANT uint FUNCTION_HEURISTIC = 11u;    // pdfs a.x and a.y
TYNDALL_CONSTANT uint FUNCTION_COLUMN = 12u;       // height, rise, scale height, distance

TYNDALL_SHARED_END

#endif

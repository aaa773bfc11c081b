#version 460
#extension GL_GOOGLE_include_directive : require
#define IS_WATCHED true
#include "bare_region.glsl"

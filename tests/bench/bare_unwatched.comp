#version 460
#extension GL_GOOGLE_include_directive : require
#define IS_WATCHED false
#include "bare_region.glsl"

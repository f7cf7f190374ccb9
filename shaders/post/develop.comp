#version 460
#extension GL_GOOGLE_include_directive : require
#include "post/rendered_pixels.glsl"
#include "post/develop.glsl"

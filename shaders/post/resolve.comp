#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "post/resolve.glsl"

layout(binding = 0) uniform texture2D rendered;

vec4 renderedSample(ivec2 pixel, int) { return texelFetch(rendered, pixel, 0); }

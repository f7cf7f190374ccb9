#version 460
#extension GL_GOOGLE_include_directive : require
#include "post/rendered_samples.glsl"
#include "post/develop.glsl"

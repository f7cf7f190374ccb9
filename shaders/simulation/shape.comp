#version 460
// Computes a substep of the `shape` solver, on devices without 64-bit integers.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"

#include "simulation/shape.glsl"

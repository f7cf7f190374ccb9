#version 460
// Computes a substep of the `rod` solver, on devices with 64-bit integers.
#extension GL_GOOGLE_include_directive : require
#include "common/packed_vectors.glsl"

#include "simulation/rod.glsl"

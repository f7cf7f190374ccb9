#version 460
// Computes a substep of the `stable_cosserat` solver, on devices with 64-bit integers.
#extension GL_GOOGLE_include_directive : require
#include "common/packed_vectors.glsl"

#include "simulation/stable_cosserat.glsl"

#version 460
// Computes a substep of the `augmented_mass_spring` solver, on devices with 64-bit integers.
#extension GL_GOOGLE_include_directive : require
#include "common/packed_vectors.glsl"

#include "simulation/augmented_mass_spring.glsl"

#version 460
// A substep of the `shape` solver whose local constraint has an energy, on devices with 64-bit
// integers.
#extension GL_GOOGLE_include_directive : require
#define HAIRBENCH_SHAPE_ENERGY
#include "common/packed_vectors.glsl"

#include "simulation/shape.glsl"

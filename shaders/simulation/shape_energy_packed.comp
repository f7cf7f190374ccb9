#version 460
// Computes a substep of the `shape` solver with an energy for the local constraint, on devices with
// 64-bit integers.
#extension GL_GOOGLE_include_directive : require
#define HAIRBENCH_SHAPE_ENERGY
#include "common/packed_vectors.glsl"

#include "simulation/shape.glsl"

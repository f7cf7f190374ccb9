#version 460
// Computes a substep of the `shape` solver with an energy for the local constraint, one invocation
// per strand.
#extension GL_GOOGLE_include_directive : require
#define HAIRBENCH_SHAPE_ENERGY
#include "simulation/shape_serial.glsl"

#version 460
// A substep of the `shape` solver whose local constraint has an energy, one invocation per strand.
#extension GL_GOOGLE_include_directive : require
#define HAIRBENCH_SHAPE_ENERGY
#include "simulation/shape_serial.glsl"

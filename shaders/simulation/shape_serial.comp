#version 460
// Computes a substep of the `shape` solver, one invocation per strand.
#extension GL_GOOGLE_include_directive : require
#include "simulation/shape_serial.glsl"

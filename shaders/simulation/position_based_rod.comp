#version 460
// Computes a substep of the `position_based_rod` solver, on devices without 64-bit integers.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"

#include "simulation/position_based_rod.glsl"

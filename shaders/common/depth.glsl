// The direction of depth. engine/pipeline.h defines and explains it. Shaders compare depths only
// with these functions.
#ifndef HAIRBENCH_DEPTH_GLSL
#define HAIRBENCH_DEPTH_GLSL

#extension GL_GOOGLE_include_directive : require

#include "shared/options.h"

bool isNearer(float depth, float than) { return depth > than; }

bool isNearerOrEqual(float depth, float than) { return depth >= than; }

// A clip-space position beyond the far plane, which no picture shows.
const vec4 kClippedPosition = vec4(0.0, 0.0, 2.0 * float(kFarDepth) - float(kNearDepth), 1.0);

// Moves a depth towards the near plane by a positive amount.
float nearer(float depth, float by) { return depth + by; }

// Clamps a depth to the range of depth images: nothing is drawn beyond the far plane.
float notBeyondFar(float depth) { return max(depth, float(kFarDepth)); }

// Maps a depth to an integer that is smaller the nearer the depth is; depthOf() is the inverse.
// Non-negative floats have the same order as their bits.
uint nearness(float depth) { return ~floatBitsToUint(max(depth, float(kFarDepth))); }

float depthOf(uint nearness) { return uintBitsToFloat(~nearness); }

// Distance of a clip-space position from the near plane: 0 on it, positive beyond it, linear in the
// coordinates.
float pastNearPlane(vec4 clip) { return clip.w - clip.z; }

#endif

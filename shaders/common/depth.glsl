// Which way depth goes: engine/pipeline.h says it, and why. Shaders compare depths by these alone.
#ifndef HAIRBENCH_DEPTH_GLSL
#define HAIRBENCH_DEPTH_GLSL

#extension GL_GOOGLE_include_directive : require

#include "shared/options.h"

bool isNearer(float depth, float than) { return depth > than; }

bool isNearerOrEqual(float depth, float than) { return depth >= than; }

// A place that no picture shows, beyond the far plane.
const vec4 kNowhere = vec4(0.0, 0.0, 2.0 * float(kFarDepth) - float(kNearDepth), 1.0);

// A depth moved towards the near plane, by a positive amount.
float nearer(float depth, float by) { return depth + by; }

// A depth moved into what images of depth can hold: nothing is drawn beyond the far plane.
float notBeyondFar(float depth) { return max(depth, float(kFarDepth)); }

// A number that is smaller the nearer a depth is, and back. Floats that are not negative are ordered
// as their bits.
uint nearness(float depth) { return ~floatBitsToUint(max(depth, float(kFarDepth))); }

float depthOf(uint nearness) { return uintBitsToFloat(~nearness); }

// Of clip space: 0 on the near plane, positive beyond; linear in the coordinates.
float beyondNear(vec4 clip) { return clip.w - clip.z; }

#endif

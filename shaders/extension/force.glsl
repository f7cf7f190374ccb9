// The interface for a file that /simulation/force names: docs/extending.md. This header and
// that file are compiled as one unit, so this header includes nothing.
#ifndef HAIRBENCH_EXTENSION_FORCE_GLSL
#define HAIRBENCH_EXTENSION_FORCE_GLSL

// A vertex of a guide at the start of a time step.
struct GuidePoint {
    vec3 position;  // m, world
    vec3 velocity;  // m/s
    float along;  // 0 at the root, 1 at the tip
    uint guide;  // from 0
    float time;  // s, simulated
};

// ---- Defined by the file ----

// The acceleration of the vertex besides gravity and wind, m/s^2, until the end of the time step.
vec3 accelerateGuide(GuidePoint point);

// ---- Defined by the program ----

// A random number in [0, 1) for the guide; every `which` gives a different one.
float guideRandom(GuidePoint point, uint which);

#endif

// What a file that /simulation/force names sees, and what it defines: docs/extending.md. A
// unit of its own is compiled of this and that file, so this includes nothing.
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

// What the vertex is accelerated by beside gravity and wind, m/s^2, until the end of the time step.
vec3 accelerateGuide(GuidePoint point);

// ---- Defined by the program ----

// A random number in [0, 1) of the guide, for each `which` another.
float guideRandom(GuidePoint point, uint which);

#endif

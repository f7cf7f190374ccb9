// The interface for a file that /simulation/solver names: docs/extending.md. This header and
// that file are compiled as one unit, so this header includes nothing.
#ifndef HAIRBENCH_EXTENSION_SOLVER_GLSL
#define HAIRBENCH_EXTENSION_SOLVER_GLSL

// A rigid motion from the groom to the world: x -> rotation x + translation.
struct GuideFrame {
    vec4 rotation;  // unit quaternion, w the scalar part
    vec3 translation;  // m
};

// A guide in a substep.
struct Guide {
    uint number;  // from 0
    uint vertices;  // from the root, which is vertex 0, to the tip
    float seconds;  // length of the substep
    float kept;  // share of a velocity that friction leaves in the substep: /simulation/friction
    GuideFrame head;  // motion of the head since rest, or of the root's triangle, at the end
    GuideFrame head_before;  // at the start
};

// /simulation/material
struct GuideMaterial {
    float density;  // kg/m^3
    float radius;  // m
    float ellipticity;
    float youngs_modulus;  // Pa
    float shear_modulus;  // Pa
    float damping;  // s
};

// ---- Defined by the file ----

// Moves the guide's vertices to the end of the substep with setGuidePosition(). Then the program
// pushes them out of bodies. A vertex's velocity is its whole displacement over the substep.
void solveGuide(Guide guide);

// ---- Defined by the program: m, world; 0 for a vertex past the tip ----

// The vertex now: at first its place at the start of the substep. Held vertices are already where
// they are at the end; the root, vertex 0, is one.
vec3 guidePosition(uint vertex);
// Does nothing for a held vertex or one past the tip.
void setGuidePosition(uint vertex, vec3 position);
bool guideHeld(uint vertex);

// At the start of the substep.
vec3 guideBefore(uint vertex);
vec3 guideVelocity(uint vertex);  // m/s
// Gravity, wind of mode thesis, hair, force and hands, m/s^2.
vec3 guideAcceleration(uint vertex);
// The displacement in the substep if nothing holds the hair together: from a velocity, m/s, by
// friction, acceleration and the air's drag. 0 for a held vertex.
vec3 guideDrift(uint vertex, vec3 velocity);
// The vertex at the end of the substep, without forces that hold the hair together: guideBefore()
// plus guideDrift() by guideVelocity(). For a held vertex, guidePosition().
vec3 guidePredicted(uint vertex);
// The factor on a displacement across the hair by forces that guideDrift() does not have: the drag
// of air on it, in (0, 1]. 1 without drag.
float guideYield(uint vertex);

// At rest, where the head takes it until the end.
vec3 guideRest(uint vertex);
float guideRestLength(uint vertex);  // m, of the segment from the vertex before; 0 for the root
// Half of the mass of each segment that ends there, kg.
float guideMass(uint vertex);
GuideMaterial guideMaterial();

// `position` pushed out of bodies, with friction on the way there from guideBefore().
vec3 outOfBodies(uint vertex, vec3 position);

// Numbers of the file's own, for each vertex and place below 4. They last from one substep to the
// next, and are 0 at the start and after others moved the guide.
vec4 guideMemory(uint vertex, uint place);
void setGuideMemory(uint vertex, uint place, vec4 value);

// A random number in [0, 1) for the guide; every `which` gives a different one.
float guideRandom(Guide guide, uint which);

#endif

#version 460
// One substep of a solver that the scene defines: extension/solver.glsl. One invocation per guide.
// It does not run without one.
#extension GL_GOOGLE_include_directive : require

#include "common/random.glsl"
#include "common/rigid_frame.glsl"
#include "extension/solver.glsl"
#include "extension/turns.glsl"
#include "simulation/air_drag.glsl"
#include "simulation/contacts.glsl"
#include "simulation/guides.glsl"
#include "simulation/root_frame.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { SubstepPush push; };

layout(buffer_reference, scalar) readonly buffer ExtendedReference {
    ExtendedParameters parameters;
};

#ifdef HAIRBENCH_EXTENDED_SOLVER

uint solved_guide;

GuideParameters solvedGuides() { return GuideReference(push.guides).parameters; }
ExtendedParameters solvedParameters() { return ExtendedReference(push.solver).parameters; }
bool isOnGuide(uint vertex) { return vertex < solvedGuides().vertices_per_strand; }
uint solvedVertex(uint vertex) {
    return solved_guide * solvedGuides().vertices_per_strand + vertex;
}
vec4 solvedPoint(Address points, uint vertex) {
    return isOnGuide(vertex) ? State(points).at[solvedVertex(vertex)] : vec4(0.0);
}

vec3 guidePosition(uint vertex) { return solvedPoint(solvedGuides().positions, vertex).xyz; }

bool guideHeld(uint vertex) {
    return !isOnGuide(vertex) ||
           Factors(solvedGuides().positions).at[4u * solvedVertex(vertex) + 3u] == 0.0;
}

void setGuidePosition(uint vertex, vec3 position) {
    if (!guideHeld(vertex)) State(solvedGuides().positions).at[solvedVertex(vertex)].xyz = position;
}

vec3 guideBefore(uint vertex) { return solvedPoint(solvedGuides().previous, vertex).xyz; }

vec3 guideVelocity(uint vertex) {
    vec3 earlier = solvedPoint(solvedParameters().earlier, vertex).xyz;
    return (guideBefore(vertex) - earlier) / solvedGuides().step.sub;
}

vec3 guideAcceleration(uint vertex) {
    if (!isOnGuide(vertex)) return vec3(0.0);
    vec3 acceleration = solvedGuides().gravity;
    if (push.accelerations != kNoAddress)
        acceleration += Vectors(push.accelerations).at[solvedVertex(vertex)].xyz;
    return acceleration;
}

// The tangent at the start of the substep, and h k of simulation/air_drag.glsl.
float solvedDrag(uint vertex, vec3 velocity, out vec3 tangent) {
    tangent = vec3(0.0);
    if (push.air == kNoAddress || vertex == 0u || !isOnGuide(vertex)) return 0.0;
    vec3 before = guideBefore(vertex);
    vec3 below = vec3(0.0);
    if (isOnGuide(vertex + 1u)) below = directionOf(guideBefore(vertex + 1u) - before);
    tangent = tangentBetween(directionOf(before - guideBefore(vertex - 1u)), below);
    vec3 u = Vectors(push.air).at[solvedVertex(vertex)].xyz - velocity;
    return dragFactor(push.drag, tangent, u, solvedGuides().step.sub);
}

vec3 guideDrift(uint vertex, vec3 velocity) {
    if (guideHeld(vertex)) return vec3(0.0);
    GuideParameters guides = solvedGuides();
    float substep = guides.step.sub;
    vec3 moved = integrate(
        vec3(0.0), -substep * velocity, guideAcceleration(vertex), guides.velocity_kept,
        substep * substep);
    vec3 tangent;
    float drag = solvedDrag(vertex, velocity, tangent);
    if (drag == 0.0) return moved;
    vec3 air = Vectors(push.air).at[solvedVertex(vertex)].xyz;
    return withDrag(moved, substep * air, tangent, drag);
}

vec3 guidePredicted(uint vertex) {
    if (guideHeld(vertex)) return guidePosition(vertex);
    return guideBefore(vertex) + guideDrift(vertex, guideVelocity(vertex));
}

float guideYield(uint vertex) {
    vec3 tangent;
    return 1.0 / (1.0 + solvedDrag(vertex, guideVelocity(vertex), tangent));
}

vec3 guideRest(uint vertex) {
    if (!isOnGuide(vertex)) return vec3(0.0);
    vec3 rest = solvedPoint(solvedGuides().rest_positions, vertex).xyz;
    return toWorld(rootFrame(push.frame, push.roots, solved_guide), rest);
}

float guideRestLength(uint vertex) {
    if (vertex == 0u || !isOnGuide(vertex)) return 0.0;
    Address rest = solvedGuides().rest_positions;
    return distance(solvedPoint(rest, vertex).xyz, solvedPoint(rest, vertex - 1u).xyz);
}

GuideMaterial guideMaterial() {
    ExtendedParameters params = solvedParameters();
    return GuideMaterial(
        params.density, params.radius, params.ellipticity, params.youngs_modulus,
        params.shear_modulus, params.damping);
}

float guideMass(uint vertex) {
    ExtendedParameters params = solvedParameters();
    float line_density = params.density * 3.14159265 * params.radius * params.radius;
    return 0.5 * line_density * (guideRestLength(vertex) + guideRestLength(vertex + 1u));
}

vec3 outOfBodies(uint vertex, vec3 position) {
    if (guideHeld(vertex)) return position;
    GuideParameters guides = solvedGuides();
    uint place = solvedVertex(vertex);
    VertexContact met;
    vec3 outside = pushOutOfBodies(
        position, guideBefore(vertex), bodiesAt(guides, place), push.frame, push.frame_before, met);
    if (met.held != kTouchesNone) State(guides.previous).at[place].w = 1.0;
    return outside;
}

bool hasMemory(uint vertex, uint place) {
    return isOnGuide(vertex) && place < kExtendedMemory;
}

vec4 guideMemory(uint vertex, uint place) {
    if (!hasMemory(vertex, place)) return vec4(0.0);
    return State(solvedParameters().memory).at[kExtendedMemory * solvedVertex(vertex) + place];
}

void setGuideMemory(uint vertex, uint place, vec4 value) {
    if (hasMemory(vertex, place))
        State(solvedParameters().memory).at[kExtendedMemory * solvedVertex(vertex) + place] = value;
}

float guideRandom(Guide guide, uint which) {
    return random01(hash(solvedGuides().seed, guide.number, kForcePurpose), which, kForcePurpose);
}

GuideFrame guideFrame(RigidFrame frame) { return GuideFrame(frame.rotation, frame.translation); }

#endif

void main() {
#ifdef HAIRBENCH_EXTENDED_SOLVER
    GuideParameters guides = GuideReference(push.guides).parameters;
    GuideParameters from = GuideReference(push.from).parameters;
    solved_guide = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (solved_guide >= guides.strand_count) return;  // no barrier follows

    RigidFrame head = rootFrame(push.frame, push.roots, solved_guide);
    for (uint i = 0; i < guides.vertices_per_strand; ++i) {
        uint vertex = solvedVertex(i);
        vec4 point = State(from.positions).at[vertex];
        State(solvedParameters().earlier).at[vertex] = State(from.previous).at[vertex];
        State(guides.previous).at[vertex] = vec4(point.xyz, 0.0);
        if (i == 0u) point.xyz = toWorld(head, Vectors(guides.rest_positions).at[vertex].xyz);
        State(guides.positions).at[vertex] = point;
    }
    beginTurns();
    solveGuide(Guide(
        solved_guide, guides.vertices_per_strand, guides.step.sub, guides.velocity_kept,
        guideFrame(head),
        guideFrame(rootFrame(push.frame_before, push.roots_before, solved_guide))));
    float contact = 0.0;  // 1 from the first vertex that touches a body
    for (uint i = 0; i < guides.vertices_per_strand; ++i) {
        uint vertex = solvedVertex(i);
        contact = max(contact, Factors(guides.previous).at[4u * vertex + 3u]);
        collide(guides, push.frame, push.frame_before, vertex, contact);
    }
#endif
}

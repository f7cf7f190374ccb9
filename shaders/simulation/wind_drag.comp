#version 460
// The drag of air on every guide vertex; one invocation per vertex.
//
// On a cylinder of diameter d with the air's velocity u across it, per length,
//   f = 1/2 rho_air C_D d |u| u,  C_D = 1 + 10 Re^(-2/3),  Re = rho_air |u| d / mu:
// White 1974, Viscous Fluid Flow. Over the hair's mass per length that is the acceleration k u with
//   k = inertial |u| + viscous |u|^(1/3),
// which vanishes with u though C_D does not stay finite.
//
// At 5 m/s k is about 90/s: an explicit step of 1/60 s would turn u round, a longer one make it
// grow. Hence the velocity at the end of the step is in the drag, and only k is of its start; with
// what gravity g has across the hair
//   v' = v + dt (k (U - v') + g),  so the acceleration is  k (u - dt g) / (1 + k dt).
// Without gravity the step leaves u' = u / (1 + k dt), which neither grows nor turns round at any
// dt. That is the exact solution where C_D is 1; where the viscous part rules it brakes too little,
// by an error of first order in dt. Two states are exact at any dt: hair that falls ends at
// k v = g, and hair that is held still feels k U and g in their true proportion. Against a
// constraint of finite stiffness both are too small there by 1 + k dt.
#extension GL_GOOGLE_include_directive : require

#include "simulation/guides.glsl"
#include "simulation/turbulence.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { DragPush push; };

// Sum of two unit tangents below which the two segments at a vertex lie on each other and have no
// direction together.
const float kFolded = 1.0e-3;

vec3 directionOf(vec3 edge) {
    float len = length(edge);
    return len < kShortestSegment ? vec3(0.0) : edge / len;
}

// The tangent at a vertex: halfway between those of the segments above and below, of second order
// on a curved strand; that of the one above where they are folded. Zero where neither has one.
vec3 tangentBetween(vec3 above, vec3 below) {
    vec3 sum = directionOf(above) + directionOf(below);
    float len = length(sum);
    return len < kFolded ? directionOf(above) : sum / len;
}

vec3 across(vec3 tangent, vec3 v) { return v - dot(tangent, v) * tangent; }

void main() {
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= guides.strand_count * guides.vertices_per_strand) return;  // no barrier follows

    uint vertex = index % guides.vertices_per_strand;
    vec3 acceleration = vec3(0.0);
    State positions = State(guides.positions);
    vec3 position = positions.at[index].xyz;
    vec3 above = vec3(0.0);
    vec3 below = vec3(0.0);
    if (vertex > 0) above = position - positions.at[index - 1].xyz;
    if (vertex + 1 < guides.vertices_per_strand) below = positions.at[index + 1].xyz - position;
    vec3 tangent = tangentBetween(above, below);
    if (vertex > 0 && tangent != vec3(0.0)) {
        vec3 air = push.mean_wind;
        if (push.fluctuation > 0.0)
            air += push.fluctuation *
                   turbulence(
                       push.cell, push.cells_per_metre * position + push.fraction, push.octaves,
                       guides.seed);
        vec3 velocity = (position - State(guides.previous).at[index].xyz) / guides.step.sub;
        vec3 u = across(tangent, air - velocity);
        float speed = length(u);
        float k = push.inertial_drag * speed + push.viscous_drag * pow(speed, 1.0 / 3.0);
        vec3 fallen = guides.step.whole * across(tangent, guides.gravity);
        acceleration = k / (1.0 + k * guides.step.whole) * (u - fallen);
    }
    State(push.accelerations).at[index] = vec4(acceleration, 0.0);
}

// The drag of air on a guide vertex in a substep.
//
// A cylinder of diameter d, with air of velocity u across it, has a drag per length of
//   f = 1/2 rho_air C_D d |u| u,  C_D = 1 + 10 Re^(-2/3),  Re = rho_air |u| d / mu:
// White 1974, Viscous Fluid Flow. Divided by the hair's mass per length, this is an acceleration k
// u with
//   k = inertial |u| + viscous |u|^(1/3).
// It vanishes with u, although C_D diverges.
//
// At 5 m/s k is about 90/s. An explicit step of 1/60 s would reverse u, and a longer one would
// amplify it. The drag therefore uses the velocity at the end of the substep h; only k and the
// tangent t are taken at its start. With P = 1 - t t^T, the air's velocity U and the acceleration a
// by all other forces
//   v' = v + h (a + k P (U - v')), which is  (1 + h k P) (v' - w) = h f,
//   w = v_p + h k / (1 + h k) P (U - v_p),
// where v_p is v with the accelerations known before the substep, and f are the forces that hold
// the hair together. For a solver, air therefore means two changes: w replaces v_p, and the mass
// across the hair is multiplied by 1 + h k. With both, hair at rest feels k U for any h. Hair in
// still air loses energy for any h and f, since P is positive semidefinite. Free hair has u' = u /
// (1 + h k), which neither grows nor reverses. That is the exact solution if C_D is 1. If the
// viscous part dominates, the drag is too weak, by an error of first order in h.
#ifndef HAIRBENCH_SIMULATION_AIR_DRAG_GLSL
#define HAIRBENCH_SIMULATION_AIR_DRAG_GLSL

#include "simulation/guides.glsl"

// If the sum of two unit tangents is shorter than this, the segments at a vertex are folded onto
// each other and have no common direction.
const float kFolded = 1.0e-3;

vec3 directionOf(vec3 edge) {
    float len = length(edge);
    return len < kShortestSegment ? vec3(0.0) : edge / len;
}

// The tangent at a vertex between two segments. Each input is a unit vector, or zero for a segment
// without a direction. The result is halfway between them, which is second-order accurate on a
// curved strand. If they are folded, it is that of the segment above. It is zero if neither has
// one.
vec3 tangentBetween(vec3 above, vec3 below) {
    vec3 sum = above + below;
    float len = length(sum);
    return len < kFolded ? above : sum / len;
}

// The tangent at a guide vertex, `index` in [strand][vertex]; zero at the root.
vec3 tangentAt(GuideParameters guides, uint index) {
    uint vertex = index % guides.vertices_per_strand;
    if (vertex == 0) return vec3(0.0);
    Vectors positions = Vectors(guides.positions);
    vec3 position = positions.at[index].xyz;
    vec3 below = vec3(0.0);
    if (vertex + 1 < guides.vertices_per_strand)
        below = directionOf(positions.at[index + 1].xyz - position);
    return tangentBetween(directionOf(position - positions.at[index - 1].xyz), below);
}

// h k of a hair with this tangent, in air of relative velocity u, m/s.
float dragFactor(AirDrag drag, vec3 tangent, vec3 u, float substep) {
    if (tangent == vec3(0.0)) return 0.0;
    float speed = length(u - dot(tangent, u) * tangent);
    return substep * (drag.inertial * speed + drag.viscous * pow(speed, 1.0 / 3.0));
}

// w as defined above, in the unit of the other two velocities.
vec3 withDrag(vec3 velocity, vec3 air, vec3 tangent, float drag) {
    vec3 u = air - velocity;
    return velocity + drag / (1.0 + drag) * (u - dot(tangent, u) * tangent);
}

// The remainder of an implicit pull c / (1 + c) when air makes the vertex 1 + drag times as heavy;
// c is a spring's stiffness over the mass. Hair then comes to rest where the spring balances the
// drag.
float pullOn(float stiffness, float drag) {
    return stiffness / (1.0 + drag * (1.0 - stiffness));
}

#endif

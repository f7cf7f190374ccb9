// The drag of air on a guide vertex in a substep.
//
// On a cylinder of diameter d with the air's velocity u across it, per length,
//   f = 1/2 rho_air C_D d |u| u,  C_D = 1 + 10 Re^(-2/3),  Re = rho_air |u| d / mu:
// White 1974, Viscous Fluid Flow. Over the hair's mass per length that is the acceleration k u with
//   k = inertial |u| + viscous |u|^(1/3),
// which vanishes with u though C_D does not stay finite.
//
// At 5 m/s k is about 90/s: an explicit step of 1/60 s would turn u round, a longer one make it
// grow. Hence the velocity at the end of the substep h is in the drag, and only k and the tangent t
// are of its start. With P = 1 - t t^T, the air's velocity U and the acceleration a by all else
//   v' = v + h (a + k P (U - v')), which is  (1 + h k P) (v' - w) = h f,
//   w = v_p + h k / (1 + h k) P (U - v_p),
// where v_p is v with the accelerations that are known before the substep and f are those that hold
// the hair together. So air is two things to a solver: w in place of v_p, and a mass that is
// 1 + h k times as great across the hair. With both, hair at rest feels k U whatever h is, and
// hair in still air loses energy whatever h and f are, since P is no less than 0. Without anything
// that holds it u' = u / (1 + h k), which neither grows nor turns round. That is the exact solution
// where C_D is 1; where the viscous part rules it brakes too little, by an error of first order in
// h.
#ifndef HAIRBENCH_SIMULATION_AIR_DRAG_GLSL
#define HAIRBENCH_SIMULATION_AIR_DRAG_GLSL

#include "simulation/guides.glsl"

// Sum of two unit tangents below which the two segments at a vertex lie on each other and have no
// direction together.
const float kFolded = 1.0e-3;

vec3 directionOf(vec3 edge) {
    float len = length(edge);
    return len < kShortestSegment ? vec3(0.0) : edge / len;
}

// The tangent at a vertex between two segments, each a unit vector or zero without a direction:
// halfway between the two, of second order on a curved strand; that of the one above where they are
// folded. Zero where neither has one.
vec3 tangentBetween(vec3 above, vec3 below) {
    vec3 sum = above + below;
    float len = length(sum);
    return len < kFolded ? above : sum / len;
}

// h k of a hair with that tangent in air with the velocity u relative to it, m/s.
float brakeOf(AirDrag drag, vec3 tangent, vec3 u, float substep) {
    if (tangent == vec3(0.0)) return 0.0;
    float speed = length(u - dot(tangent, u) * tangent);
    return substep * (drag.inertial * speed + drag.viscous * pow(speed, 1.0 / 3.0));
}

// w of the above, in the unit of the other two velocities.
vec3 braked(vec3 velocity, vec3 air, vec3 tangent, float brake) {
    vec3 u = air - velocity;
    return velocity + brake / (1.0 + brake) * (u - dot(tangent, u) * tangent);
}

// Of an implicit pull c / (1 + c) what is left where air makes the vertex 1 + brake times as heavy:
// c is a spring's stiffness over the mass. It brings hair to rest where the spring bears the drag.
float pullOn(float stiffness, float brake) {
    return stiffness / (1.0 + brake * (1.0 - stiffness));
}

#endif

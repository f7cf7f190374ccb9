#ifndef HAIRBENCH_CONSTRAINT_LENGTH_GLSL
#define HAIRBENCH_CONSTRAINT_LENGTH_GLSL

#include "shared/distance_field_structs.h"
#include "shared/simulation_structs.h"

// Distance projection, thesis eq. 12; Mueller et al. 2007, Position Based Dynamics. w are inverse
// masses. Coincident points are separated along +y.
void projectLength(inout vec4 a, inout vec4 b, float rest_length) {
    float mass = a.w + b.w;
    if (mass == 0.0) return;  // both pinned
    vec3 edge = b.xyz - a.xyz;
    float len = length(edge);
    vec3 direction = len < kShortestSegment ? vec3(0.0, 1.0, 0.0) : edge / len;
    vec3 correction = ((len - rest_length) / mass) * direction;
    a.xyz += a.w * correction;
    b.xyz -= b.w * correction;
}

// Finds the positions nearest to the predicted positions p, in the metric of the masses 1 / w, with
// segments of their rest lengths:
//     x_i / w_i + q_i (x_i - x_(i-1)) - q_(i+1) (x_(i+1) - x_i) = p_i / w_i
// with the force densities q_i = tension_i / L_i. A pass first finds the tensions along the
// segments' directions d with corrections that give every segment its length along d,
//     (w_(i-1) + w_i) T_i - w_(i-1) d_(i-1).d_i T_(i-1) - w_i d_i.d_(i+1) T_(i+1)
//         = d_i.(p_i - p_(i-1)) - L_i:
// Han and Harada 2013, Tridiagonal matrix formulation for inextensible hair strand simulation, eq.
// 9. It then finds the positions by the equation above, where tensions turn with the segments. If
// they were placed along fixed d, hair under tension would become unstable. Schek 1974, The force
// density method for form finding and computation of general networks. Each system is eliminated on
// the walk that solves the other, so a pass is one walk down and one walk up.

// Near a body a vertex has a plane, dot(n, x) >= plane.w. The walk down keeps the vertex outside of
// it as far as the vertex above permits. If it touches, the tensions treat it as nearly infinitely
// heavy across the plane, with w (1 - kHeld n n^T) instead of w. If it sticks, it is as heavy in
// all directions. In between, the share of its motion that friction cancels interpolates.

// The largest part of a segment's compression that a pass pushes apart. The walk down does the
// rest. The limit keeps the system of positions diagonally dominant, with every pivot >= 1 / 5.
const float kMostPush = 0.2;
const uint kContactPasses = 1;  // after bodies have pushed
// Less than 1, because surfaces can face each other.
const float kHeld = 0.99;

// State that a walk down the strand passes from vertex to vertex.
struct LengthsAbove {
    vec3 place;
    vec3 direction;     // of the segment that ends there; 0 at the root
    vec3 normal;        // of its plane
    float held;         // as in LengthRow
    float yield;        // 1 / pivot of that segment's row
    float tension;      // of that segment, without the contribution of the segment below
};

// State that a walk up the strand passes from vertex to vertex: the pull of the segment below.
struct LengthsBelow {
    vec3 pull;      // q x, without what the vertex above adds to x
    float hold;     // reduction of the pull by the vertex's displacement
    float tension;  // its contribution to the tension of the segment above
};

// Data of a vertex and the segment that ends in it. A position is solved.xyz + solved.w * the
// position above.
struct LengthRow {
    vec4 solved;
    vec2 tension;  // without the segment below; coefficient of the tension above
    vec4 plane;    // of a body; 0 if there is none
    float held;    // reduction of its compliance across the plane, relative to along it
};

LengthRow lengthRow(vec4 predicted, vec4 plane, float held) {
    return LengthRow(vec4(predicted.xyz, 0.0), vec2(0.0), plane, held);
}

// Compliance of a vertex along a body if friction cancels `share` of the motion, and its reduction
// across the body; both relative to 1.
float complianceAlong(float share) { return 1.0 - kHeld * max(share, 0.0); }
float heldAcross(float share) {
    return share < 0.0 ? 0.0 : kHeld * (1.0 - share) / complianceAlong(share);
}

LengthsAbove aboveAll(vec3 root) {
    return LengthsAbove(root, vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0);
}

// The direction nearest to `direction` that ends on a plane. `height` is the distance to the plane
// along the normal, in lengths of the segment. If the segment is perpendicular to the plane, the
// result is off by up to half a percent; otherwise rounding would turn it.
vec3 towardPlane(vec3 direction, vec3 normal, float height) {
    height = clamp(height, -1.0, 1.0);
    vec3 across = direction - dot(direction, normal) * normal;
    across *= sqrt(max(1.0 - height * height, 0.01)) / max(length(across), 0.05);
    return normalize(height * normal + across);
}

// Places the vertex at the segment's length, outside its plane if there is one. A segment
// without a rest length takes the direction of the segment above. w of points are inverse masses.
void sweepPlace(
    inout vec3 place, inout vec3 direction, LengthRow row, vec4 point, float rest_length,
    bool planes) {
    vec3 solved = row.solved.xyz + row.solved.w * place;
    vec3 edge = solved - place;
    float len = length(edge);
    vec3 next = len < kShortestSegment ? vec3(0.0, 1.0, 0.0) : edge / len;
    if (planes) {
        vec3 normal = row.plane.xyz;
        float height = (row.plane.w - dot(normal, place)) / max(rest_length, kShortestSegment);
        if (normal != vec3(0.0) && dot(normal, next) < height)
            next = towardPlane(next, normal, height);
    }
    if (rest_length >= kShortestSegment) direction = next;
    place = point.w > 0.0 ? place + rest_length * direction : solved;
}

// Places the vertex and eliminates the segment's tension.
void sweepDown(
    inout LengthsAbove above, inout LengthRow row, vec4 point_above, vec4 point, float rest_length,
    bool planes) {
    vec3 direction = above.direction;
    sweepPlace(above.place, direction, row, point, rest_length, planes);
    float coupling = dot(above.direction, direction);
    float pivot = point_above.w + point.w;
    if (planes) {
        float facing_above = dot(above.normal, direction);
        float facing = dot(row.plane.xyz, direction);
        coupling -= above.held * dot(above.direction, above.normal) * facing_above;
        pivot -= point_above.w * above.held * facing_above * facing_above;
        pivot -= point.w * row.held * facing * facing;
        above.normal = row.plane.xyz;
        above.held = row.held;
    }
    coupling *= -point_above.w;
    float by_above = coupling * above.yield;
    pivot -= coupling * by_above;
    float stretch = dot(direction, point.xyz - point_above.xyz) - rest_length;
    above.yield = pivot > 0.0 ? 1.0 / pivot : 0.0;  // 0: both pinned
    above.tension = above.yield * (stretch - coupling * above.tension);
    above.direction = direction;
    row.tension = vec2(above.tension, by_above);
}

// Solves for the segment's tension and eliminates the vertex's position.
void sweepUp(
    inout LengthsBelow below, inout LengthRow row, vec4 point_above, vec4 point,
    float rest_length) {
    float tension = row.tension.x - below.tension;
    float density = tension / max(rest_length, kShortestSegment);
    float mass = point_above.w + point.w;
    density = mass > 0.0 ? max(density, -kMostPush / mass) : 0.0;
    float held = 1.0 + point.w * below.hold;
    float by_pivot = 1.0 / (held + point.w * density);
    row.solved = by_pivot * vec4(point.xyz + point.w * below.pull, point.w * density);
    below = LengthsBelow(
        density * row.solved.xyz, density * held * by_pivot, row.tension.y * tension);
}

#endif

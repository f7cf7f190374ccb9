#ifndef HAIRBENCH_CONSTRAINT_LENGTH_GLSL
#define HAIRBENCH_CONSTRAINT_LENGTH_GLSL

#include "shared/distance_field_structs.h"
#include "shared/simulation_structs.h"

// Distance projection, thesis eq. 12; Mueller et al. 2007, Position Based Dynamics.
// w are inverse masses. Points that coincide are parted along +y.
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

// The places nearest to the predicted ones p, in the metric of the masses 1 / w, whose segments
// have their rest lengths: x_i / w_i + q_i (x_i - x_(i-1)) - q_(i+1) (x_(i+1) - x_i) = p_i / w_i
// with the force densities q_i = tension_i / L_i. A pass finds, along the segments' directions d,
// the tensions whose corrections give every segment its length along d,
//     (w_(i-1) + w_i) T_i - w_(i-1) d_(i-1).d_i T_(i-1) - w_i d_i.d_(i+1) T_(i+1)
//         = d_i.(p_i - p_(i-1)) - L_i,
// which is Han and Harada 2013, Tridiagonal matrix formulation for inextensible hair strand
// simulation, eq. 9, and then the places by the equation above, in which the tensions turn with the
// segments: placed along fixed d, hair under tension grows unstable. Schek 1974, The force density
// method for form finding and computation of general networks. Each system is eliminated on the way
// that the other is solved on, so that a pass is one walk down and one up.

// Beside a body a vertex has a plane, dot(n, x) >= plane.w, which the walk down keeps it out of as
// far as the vertex above lets it. Where it touches, tensions find it as heavy as can be across the
// plane, w (1 - kHeld n n^T) in place of w, and as heavy all ways where it sticks; in between by the
// share of its motion that friction takes back.

// So much of a segment's stretch or, the other way, compression is pushed apart in a pass, the
// rest by the walk down. It keeps the system of places diagonally dominant, every pivot >= 1 / 5.
const float kMostPush = 0.2;
const uint kContactPasses = 1;  // once bodies have pushed
// Less than 1: surfaces can face each other.
const float kHeld = 0.99;

// What a walk down the strand hands on from vertex to vertex.
struct LengthsAbove {
    vec3 place;
    vec3 direction;     // of the segment that ends there; 0 at the root
    vec3 normal;        // of its plane
    float held;         // as in its row
    float yield;        // 1 / pivot of that segment's row
    float tension;      // of that segment, but for what the segment below adds
};

// What a walk up hands on: pulls by the segment below.
struct LengthsBelow {
    vec3 pull;      // q x, but for what the vertex above adds to x
    float hold;     // and how much less for its being moved
    float tension;  // what it adds to the tension of the segment above
};

// Of a vertex and the segment that ends in it. A place is solved.xyz + solved.w * the place above.
struct LengthRow {
    vec4 solved;
    vec2 tension;  // without the segment below; its part of the tension above
    vec4 plane;    // of a body; 0 where there is none
    float held;    // how much less it yields across that than along
};

LengthRow lengthRow(vec4 predicted, vec4 plane, float held) {
    return LengthRow(vec4(predicted.xyz, 0.0), vec2(0.0), plane, held);
}

// How much a vertex yields along a body of whose motion friction takes back a share, and how much
// less across it; both of 1.
float yieldAlong(float share) { return 1.0 - kHeld * max(share, 0.0); }
float heldAcross(float share) {
    return share < 0.0 ? 0.0 : kHeld * (1.0 - share) / yieldAlong(share);
}

LengthsAbove aboveAll(vec3 root) {
    return LengthsAbove(root, vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0);
}

// The direction next to `direction` that ends on a plane: `height` is how far that is along the
// normal, in lengths of the segment. Where the segment stands on the plane it is off by up to half a
// percent: rounding would turn it otherwise.
vec3 towardPlane(vec3 direction, vec3 normal, float height) {
    height = clamp(height, -1.0, 1.0);
    vec3 across = direction - dot(direction, normal) * normal;
    across *= sqrt(max(1.0 - height * height, 0.01)) / max(length(across), 0.05);
    return normalize(height * normal + across);
}

// Places the vertex at the segment's length, out of its plane where there are any. A segment without
// a length at rest has the direction of the one above. w of points are inverse masses.
void walkPlace(
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
void walkDown(
    inout LengthsAbove above, inout LengthRow row, vec4 point_above, vec4 point, float rest_length,
    bool planes) {
    vec3 direction = above.direction;
    walkPlace(above.place, direction, row, point, rest_length, planes);
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

// Solves the segment's tension, and eliminates the vertex's place.
void walkUp(
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

#ifndef HAIRBENCH_CONSTRAINT_BODIES_GLSL
#define HAIRBENCH_CONSTRAINT_BODIES_GLSL

#include "common/rigid_frame.glsl"
#include "shared/options.h"
#include "simulation/constraints/collide.glsl"
#include "simulation/constraints/distance_field.glsl"
#include "simulation/constraints/friction.glsl"
#include "simulation/guides.glsl"

// True if a vertex's path in the substep counts, and not only its end.
layout(constant_id = kContinuousCollisionConstant) const bool kContinuousCollision = false;

// ---- Bodies by number: first the capsules, then the distance fields ----

uint bodyCount(Bodies bodies) { return bodies.capsule_count + bodies.field_count; }

bool isOnHead(Bodies bodies, uint body) {
    if (body < bodies.capsule_count)
        return Capsules(bodies.capsules).at[body].follows == kFollowsHead;
    return BodyFields(bodies.fields).at[body - bodies.capsule_count].follows == kFollowsHead;
}

// Like gapTo() for the capsule or the field, in the body's own frame.
float gapToBody(Bodies bodies, uint body, float margin, vec3 position, out vec3 normal) {
    if (body < bodies.capsule_count)
        return gapTo(Capsules(bodies.capsules).at[body], margin, position, normal);
    return gapTo(
        BodyFields(bodies.fields).at[body - bodies.capsule_count].field, margin, position, normal);
}

// ---- Contact ----

const float kFar = 1.0e9;  // m

const float kTouchesNone = -1.0;

// The contact of a vertex. `plane`: the tangent plane of the last body that it touches, otherwise
// of the nearest body. dot(plane.xyz, x) >= plane.w outside; 0 if there is no body.
struct VertexContact {
    vec4 plane;
    float held;  // share of its motion along the body that friction cancels, or kTouchesNone
};

// A vertex in the world frame and in the head's frame, now and at the start of the substep, and its
// contact.
struct MovingVertex {
    vec3 position;
    vec3 before;
    vec3 position_on_head;
    vec3 before_on_head;
    vec4 plane;
    float gap;  // distance to the plane; 0 if the vertex touches it
    float share;  // share of its motion along the body that friction cancels
};

// A path into a body is followed by sphere tracing (Hart 1996, Sphere tracing). Near the body,
// Newton steps are used; they do not overshoot a convex body.
const uint kMostSteps = 32u;
const float kNearBody = 2.0e-3;  // m
const float kTouch = 1.0e-6;  // m
const float kGrazing = 0.02;  // sine of the smallest angle that Newton steps assume

// Tells whether the path from a point outside a body to another, in the body's frame, enters the
// body without its margin. If so, gives the outward normal there, and how far the path's end lies
// behind the plane there. `end_gap`: distance from the path's end to the body.
bool entersBody(Bodies bodies, uint body, vec3 from, vec3 to, float end_gap, out vec3 normal,
                out float behind) {
    float whole = distance(from, to);
    vec3 direction = (to - from) / whole;
    float gap = gapToBody(bodies, body, 0.0, from, normal);
    // A start inside is left to pushing out along the shortest way. If the distances at both ends
    // together exceed the path's length, the path cannot meet the body.
    if (gap < kTouch || gap + end_gap >= whole) return false;
    float at = 0.0;
    for (uint i = 0; i < kMostSteps; ++i) {
        at += gap < kNearBody ? gap / max(-dot(normal, direction), kGrazing) : gap;
        if (at >= whole) return false;
        vec3 place = from + at * direction;
        gap = gapToBody(bodies, body, 0.0, place, normal);
        if (gap < kTouch) {
            behind = dot(normal, place - to) - gap;
            return behind > 0.0;
        }
    }
    return false;
}

// Moves the vertex out of a body along the shortest way and lets it slide on the body. The sliding
// motion is relative to the body. With kContinuousCollision, a vertex with a path into the body
// stops at the entry point, however thin the body and however long the path.
//
// `gap`, `normal`: of the vertex, in the body's frame, including the margin.
void collideWithBody(inout MovingVertex vertex, Bodies bodies, uint body, float gap, vec3 normal,
                     bool on_head, RigidFrame frame) {
    vec3 here = on_head ? vertex.position_on_head : vertex.position;
    vec3 there = on_head ? vertex.before_on_head : vertex.before;
    float held_back = 0.0;
    vec3 outward;
    float behind;
    if (kContinuousCollision && gap + bodies.margin < distance(here, there) &&
        entersBody(bodies, body, there, here, gap + bodies.margin, outward, behind)) {
        held_back = behind;
        here += behind * outward;
        vertex.position = on_head ? toWorld(frame, here) : here;
        vertex.position_on_head = on_head ? here : fromWorld(frame, here);
        gap = gapToBody(bodies, body, bodies.margin, here, normal);
        vertex.gap = kFar;  // the old gap belongs to the position without the contact
    }
    if (gap >= vertex.gap) return;
    vec3 facing = on_head ? rotate(frame.rotation, normal) : normal;
    vertex.plane = vec4(facing, dot(facing, vertex.position) - gap);
    vertex.gap = held_back > 0.0 ? 0.0 : max(gap, 0.0);
    if (vertex.gap > 0.0 || (gap >= 0.0 && held_back == 0.0)) return;
    float depth = max(-gap, 0.0);
    vec3 pushed = slideBack(
        here + depth * normal, there, normal, held_back + depth, bodies.friction, vertex.share);
    vertex.position = on_head ? toWorld(frame, pushed) : pushed;
    vertex.position_on_head = on_head ? pushed : fromWorld(frame, pushed);
}

// The bodies with the margin for a vertex of [strand][vertex], which may be smaller than theirs.
Bodies bodiesAt(GuideParameters guides, uint vertex) {
    // Mesa 22's llvmpipe reads x if only the last component is read, so the whole vector is read.
    vec4 rest = Vectors(guides.rest_positions).at[vertex];
    Bodies bodies = guides.bodies;
    bodies.margin = rest.w;
    return bodies;
}

// Distance of a point from the nearest body without its margin, negative inside; infinite if there
// is no body.
float gapToBodies(vec3 position, Bodies bodies, RigidFrame frame) {
    float nearest = uintBitsToFloat(0x7f800000u);
    vec3 on_head = fromWorld(frame, position);
    vec3 normal;
    for (uint i = 0; i < bodyCount(bodies); ++i)
        nearest = min(
            nearest,
            gapToBody(bodies, i, 0.0, isOnHead(bodies, i) ? on_head : position, normal));
    return nearest;
}

// Moves a vertex out of every body in turn. `before` is its position at the start of the substep.
// Returns its new position.
vec3 pushOutOfBodies(
    vec3 position, vec3 before, Bodies bodies, RigidFrame frame, RigidFrame frame_before,
    out VertexContact met) {
    MovingVertex vertex = MovingVertex(
        position, before, fromWorld(frame, position), fromWorld(frame_before, before), vec4(0.0),
        kFar, 0.0);
    // A single loop over both kinds takes a quarter longer on llvmpipe.
    vec3 normal;
    for (uint i = 0; i < bodies.capsule_count; ++i) {
        Capsule capsule = Capsules(bodies.capsules).at[i];
        bool on_head = capsule.follows == kFollowsHead;
        vec3 here = on_head ? vertex.position_on_head : vertex.position;
        float gap = gapTo(capsule, bodies.margin, here, normal);
        collideWithBody(vertex, bodies, i, gap, normal, on_head, frame);
    }
    for (uint i = 0; i < bodies.field_count; ++i) {
        BodyField body = BodyFields(bodies.fields).at[i];
        bool on_head = body.follows == kFollowsHead;
        vec3 here = on_head ? vertex.position_on_head : vertex.position;
        float gap = gapTo(body.field, bodies.margin, here, normal);
        collideWithBody(vertex, bodies, bodies.capsule_count + i, gap, normal, on_head, frame);
    }
    met = VertexContact(vertex.plane, vertex.gap > 0.0 ? kTouchesNone : vertex.share);
    return vertex.position;
}

#endif

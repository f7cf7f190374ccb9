#ifndef HAIRBENCH_CONSTRAINT_BODIES_GLSL
#define HAIRBENCH_CONSTRAINT_BODIES_GLSL

#include "common/rigid_frame.glsl"
#include "shared/options.h"
#include "simulation/constraints/body.glsl"
#include "simulation/constraints/friction.glsl"
#include "simulation/guides.glsl"

// Whether a vertex's way in the substep counts, and not where it ends alone.
layout(constant_id = kContinuousCollisionConstant) const bool kContinuousCollision = false;

const float kFar = 1.0e9;  // m

const float kTouchesNone = -1.0;

// What a vertex has met. `plane`: the tangent plane of the last body that it touches, otherwise of
// the nearest: dot(plane.xyz, x) >= plane.w outside; 0 where there is no body.
struct Met {
    vec4 plane;
    float held;  // share of its motion along the body that friction takes back, or kTouchesNone
};

// A vertex in the world and as the head sees it, now and at the start of the substep, and what it
// has met.
struct MovingVertex {
    vec3 position;
    vec3 before;
    vec3 position_on_head;
    vec3 before_on_head;
    vec4 plane;
    float gap;  // to it; 0 where it touches
    float share;  // that friction takes back of its motion along the body
};

// A way into a body is followed by spheres in which there is nothing of it (Hart 1996, Sphere
// tracing), and near it by Newton's steps, which go no farther where the body is convex.
const uint kMostSteps = 32u;
const float kNearBody = 2.0e-3;  // m
const float kTouch = 1.0e-6;  // m
const float kGrazing = 0.02;  // sine of the least angle that Newton's steps reckon with

// Whether the way from a point outside of a body to another, in the body's frame, enters it, margin
// apart: then the outward normal there, and by how much the way's end lies behind the plane there.
// `end_gap`: how far the way's end is outside of the body.
bool entersBody(Bodies bodies, uint body, vec3 from, vec3 to, float end_gap, out vec3 normal,
                out float behind) {
    float whole = distance(from, to);
    vec3 direction = (to - from) / whole;
    float gap = gapToBody(bodies, body, 0.0, from, normal);
    // What starts inside is pushed out the shortest way, and what is farther from the body at both
    // ends together than its way is long can't have met it.
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

// Takes the vertex out of a body the shortest way, and lets it slide on the body: what slides is
// the motion relative to it. Where kContinuousCollision, a vertex whose way in the substep leads into
// the body goes no farther in than where it enters, however thin the body and however far it came.
//
// `gap`, `normal`: of the vertex, in the body's frame, margin included.
void meet(inout MovingVertex vertex, Bodies bodies, uint body, float gap, vec3 normal, bool on_head,
          RigidFrame frame) {
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
        vertex.gap = kFar;  // of where it would have been
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

// The bodies as a vertex of [strand][vertex] meets them, which may keep less of their margin.
Bodies bodiesAt(GuideParameters guides, uint vertex) {
    // Mesa 22's llvmpipe reads x where the last component alone is read: hence the whole vector.
    vec4 rest = Vectors(guides.rest_positions).at[vertex];
    Bodies bodies = guides.bodies;
    bodies.margin = rest.w;
    return bodies;
}

// Takes a vertex out of every body, one after the other. `before` is where it was at the start of
// the substep. Returns where it is then.
vec3 pushOutOfBodies(
    vec3 position, vec3 before, Bodies bodies, RigidFrame frame, RigidFrame frame_before,
    out Met met) {
    MovingVertex vertex = MovingVertex(
        position, before, fromWorld(frame, position), fromWorld(frame_before, before), vec4(0.0),
        kFar, 0.0);
    // One loop over both kinds takes a quarter longer on llvmpipe.
    vec3 normal;
    for (uint i = 0; i < bodies.capsule_count; ++i) {
        Capsule capsule = Capsules(bodies.capsules).at[i];
        bool on_head = capsule.follows == kFollowsHead;
        vec3 here = on_head ? vertex.position_on_head : vertex.position;
        float gap = gapTo(capsule, bodies.margin, here, normal);
        meet(vertex, bodies, i, gap, normal, on_head, frame);
    }
    for (uint i = 0; i < bodies.field_count; ++i) {
        BodyField body = BodyFields(bodies.fields).at[i];
        bool on_head = body.follows == kFollowsHead;
        vec3 here = on_head ? vertex.position_on_head : vertex.position;
        float gap = gapTo(body.field, bodies.margin, here, normal);
        meet(vertex, bodies, bodies.capsule_count + i, gap, normal, on_head, frame);
    }
    met = Met(vertex.plane, vertex.gap > 0.0 ? kTouchesNone : vertex.share);
    return vertex.position;
}

#endif

// Strands out of bodies, where they are drawn: guides collide vertex by vertex, and what is between
// vertices, or between guides, may be inside.
#ifndef HAIRBENCH_STRAND_COLLISION_GLSL
#define HAIRBENCH_STRAND_COLLISION_GLSL

#include "common/picture.glsl"
#include "simulation/constraints/collide.glsl"
#include "simulation/constraints/distance_field.glsl"

layout(buffer_reference, scalar) readonly buffer BodiesReference { Bodies bodies; };

// Near the root, in the first guide segment: the margin grows along it, and up to here strands are
// pushed by a growing part of the way, so that none leaves its root.
const float kPushedWhole = 0.25;
// However deep it was, a point is so much of the margin outside.
const float kLeastOutside = 0.25;

// Takes a point that is `gap` outside of a body, negative inside, out of it the shortest way. Within
// the margin points are pressed together smoothly, the deeper the more, and keep their order: on one
// surface they would lie like a cap. The tangent is that of the strand so moved, the body's curvature
// left out; where it came straight in it stays.
void pushOut(float gap, vec3 normal, float margin, float part, inout vec3 position,
             inout vec3 tangent) {
    if (gap >= margin) return;
    float least = kLeastOutside * margin;
    float pressed = exp((gap - margin) / max(margin - least, 1e-6));  // of gap's change
    precise vec3 moved =  // strands/curve.glsl
        position + part * (least + (margin - least) * pressed - gap) * normal;
    precise vec3 slid = tangent - part * (1.0 - pressed) * dot(tangent, normal) * normal;
    position = moved;
    if (dot(slid, slid) > 1e-4 * dot(tangent, tangent)) tangent = slid;
}

// `along`: guide segments from the root.
void pushStrandOut(PictureParameters picture, float along, inout vec3 position,
                   inout vec3 tangent) {
    Bodies bodies = BodiesReference(picture.bodies).bodies;
    float margin = bodies.margin * min(along, 1.0);
    float part = min(along / kPushedWhole, 1.0);
    mat3 rotation = mat3(picture.head);
    // One loop over both kinds takes half as long again among capsules on llvmpipe.
    vec3 normal;
    for (uint i = 0u; i < bodies.capsule_count; ++i) {
        Capsule capsule = Capsules(bodies.capsules).at[i];
        bool on_head = capsule.follows == kFollowsHead;
        vec3 here = on_head ? (position - picture.head[3].xyz) * rotation : position;
        float gap = gapTo(capsule, 0.0, here, normal);
        pushOut(gap, on_head ? rotation * normal : normal, margin, part, position,
                tangent);
    }
    for (uint i = 0u; i < bodies.field_count; ++i) {
        BodyField body = BodyFields(bodies.fields).at[i];
        bool on_head = body.follows == kFollowsHead;
        vec3 here = on_head ? (position - picture.head[3].xyz) * rotation : position;
        float gap = gapTo(body.field, 0.0, here, normal);
        pushOut(gap, on_head ? rotation * normal : normal, margin, part, position,
                tangent);
    }
}

#endif

// Pushes drawn strands out of bodies. Guides collide only at their vertices, so points between
// vertices, or between guides, may be inside.
#ifndef HAIRBENCH_STRAND_COLLISION_GLSL
#define HAIRBENCH_STRAND_COLLISION_GLSL

#include "common/picture.glsl"
#include "simulation/constraints/collide.glsl"
#include "simulation/constraints/distance_field.glsl"

layout(buffer_reference, scalar) readonly buffer BodiesReference { Bodies bodies; };

// Applies in the first guide segment. The margin grows along the segment. Up to this fraction of
// it, the push is scaled from 0 to its full length, so that no strand leaves its root.
const float kPushedWhole = 0.25;
// Every point ends at least this fraction of the margin outside, however deep it was.
const float kLeastOutside = 0.25;

// Moves a point at distance `gap` from a body, negative inside, out of it along the shortest way.
// Within the margin, points are compressed smoothly, deeper ones more, and keep their order. On a
// single surface they would look like a cap. The tangent is that of the moved strand, without the
// body's curvature. It stays unchanged if the strand came straight in.
void pushOut(float gap, vec3 normal, float margin, float part, inout vec3 position,
             inout vec3 tangent) {
    if (gap >= margin) return;
    float least = kLeastOutside * margin;
    float pressed = exp((gap - margin) / max(margin - least, 1e-6));  // derivative of the new gap
                                                                      // by `gap`
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
    // A single loop over both kinds takes 50 % longer with capsules on llvmpipe.
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

#ifndef HAIRBENCH_CONSTRAINT_TRANSPORT_GLSL
#define HAIRBENCH_CONSTRAINT_TRANSPORT_GLSL

#include "common/rigid_frame.glsl"
#include "shared/simulation_structs.h"

// Parallel transport along a strand: the tangent of the last segment that had a direction, and the
// rotation that took the first segment's rest tangent there. A segment without a direction, at rest
// or now, inherits the previous tangent.
struct Transport {
    vec3 tangent;
    vec4 rotation;
};

bool hasDirection(vec3 edge, float rest_length) {
    return dot(edge, edge) >= kShortestSegment * kShortestSegment &&
           rest_length >= kShortestSegment;
}

// Continues the transport past one more segment.
Transport transport(Transport before, vec3 edge, float rest_length) {
    vec3 tangent = hasDirection(edge, rest_length) ? normalize(edge) : before.tangent;
    return Transport(tangent, multiply(rotationBetween(before.tangent, tangent), before.rotation));
}

// Restores the unit length of a quaternion that is off by rounding, with one step of Newton's
// method.
vec4 renormalize(vec4 rotation) { return (1.5 - 0.5 * dot(rotation, rotation)) * rotation; }

// The rest tangent of a strand's first segment on the head, where parallel transport begins.
vec3 firstTangent(RigidFrame head, vec4 first_rest_edge) {
    vec3 tangent = first_rest_edge.w >= kShortestSegment ? normalize(first_rest_edge.xyz)
                                                         : vec3(0.0, 1.0, 0.0);
    return rotate(head.rotation, tangent);
}

#endif

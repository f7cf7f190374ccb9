#version 460
// Computes the rotation of guides since rest, at every vertex. It starts with the head's rotation
// and is turned along the guide by the smallest rotations that its directions require. It has no
// twist of its own. It is the identity if the guide is at rest, and the full rotation if the guide
// has turned as a whole. One invocation per guide.
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"
#include "common/quaternion.glsl"

layout(local_size_x = kFramesGroupSize) in;
layout(push_constant, scalar) uniform Push { TurnsPush push; };

layout(buffer_reference, scalar) readonly buffer RestTangents { vec3 at[]; };
layout(buffer_reference, scalar) writeonly buffer Turns { vec4 at[]; };

void main() {
    uint guide = gl_GlobalInvocationID.x;
    if (guide >= push.guide_count) return;  // no barrier follows
    GuidePoints guides = GuidePoints(push.guides);
    uint first = guide * push.vertices_per_guide;
    uint last = push.vertices_per_guide - 1u;

    vec4 turn = push.head_turn;
    for (uint vertex = 0u; vertex <= last; ++vertex) {
        vec3 rest = RestTangents(push.rest_tangents).at[first + vertex];
        vec3 chord = guides.points[first + min(vertex + 1u, last)].xyz -
                     guides.points[first + max(vertex, 1u) - 1u].xyz;
        float squared = dot(chord, chord);
        // Without a direction, at rest or now, the rotation of the vertex before is kept.
        if (squared > 0.0 && dot(rest, rest) > 0.0) {
            turn = multiply(rotationBetween(rotate(turn, rest), chord * inversesqrt(squared)), turn);
            turn *= inversesqrt(dot(turn, turn));
        }
        Turns(push.turns).at[first + vertex] = turn;
    }
}

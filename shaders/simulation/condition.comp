#version 460
// Computes the condition of every vertex: stretch, gap to bodies and movement. One invocation per
// vertex.
#extension GL_GOOGLE_include_directive : require

#include "simulation/constraints/bodies.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { ConditionPush push; };

layout(buffer_reference, scalar) writeonly buffer Conditions { VertexCondition at[]; };

void main() {
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= guides.strand_count * guides.vertices_per_strand) return;  // no barrier follows

    State positions = State(guides.positions);
    vec3 position = positions.at[index].xyz;
    VertexCondition condition = VertexCondition(
        1.0, uintBitsToFloat(0x7f800000u),
        distance(position, State(guides.previous).at[index].xyz));
    if (index % guides.vertices_per_strand > 0u) {
        Vectors rest = Vectors(guides.rest_positions);
        float rest_length = distance(rest.at[index].xyz, rest.at[index - 1].xyz);
        if (rest_length >= kShortestSegment)
            condition.stretch = distance(position, positions.at[index - 1].xyz) / rest_length;
        condition.gap = gapToBodies(position, guides.bodies, push.frame);
    }
    Conditions(push.conditions).at[index] = condition;
}

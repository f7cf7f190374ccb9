#version 460
// Sets the `rod` solver's state from positions and previous positions that were written from
// outside. One invocation per strand. Frames go along the strand by parallel transport, as at rest.
#extension GL_GOOGLE_include_directive : require

#include "common/rigid_frame.glsl"
#include "common/vectors.glsl"
#include "simulation/rod/state.glsl"
#include "simulation/root_frame.glsl"

layout(local_size_x = kRodGroupSize) in;

layout(push_constant, scalar) uniform Push { SubstepPush push; };

void main() {
    GuideParameters guides = GuideReference(push.guides).parameters;
    RodParameters rod = RodReference(push.solver).parameters;
    uint strand = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (strand >= guides.strand_count) return;  // no barrier follows

    State positions = State(guides.positions);
    State previous = State(guides.previous);
    float unit = Factors(rod.units).at[strand];
    uint root = strand * guides.vertices_per_strand;
    uint strands = guides.strand_count;
    vec4 orientation = multiply(
        rootFrame(push.frame, push.roots, strand).rotation,
        segmentRow(rod.segments, 0, kRodHalfRotation, strands, strand));
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        vec3 here = positions.at[root + i].xyz;
        vec3 before = previous.at[root + i].xyz;
        vec3 edge = here - positions.at[root + i - 1].xyz;
        vec3 edge_before = before - previous.at[root + i - 1].xyz;
        float len = segmentRow(rod.segments, i, kRodStiffness, strands, strand).x;
        float rest_length = unit * len;

        RodMotion motion;
        motion.velocity = (here - before) / unit;
        motion.angular_velocity = vec3(0.0);
        if (rest_length >= kShortestSegment && length(edge) >= kShortestSegment) {
            vec3 tangent = normalize(edge);
            orientation = normalize(
                multiply(rotationBetween(axisOf(orientation), tangent), orientation));
            if (length(edge_before) >= kShortestSegment)
                motion.angular_velocity =
                    2.0 * rotationBetween(normalize(edge_before), tangent).xyz;
        }
        motion.orientation = orientation;
        motion.contact = vec3(0.0);
        motion.residual = edge / unit - len * axisOf(orientation);
        storeMotion(rod.motion, i, strands, strand, motion);
    }
    if (rod.accelerations != kNoAddress)
        storeVector(rod.accelerations, rodIndex(0, 0, kRodAccelerationRows, strands, strand), vec4(1.0));
}

#version 460
// One substep of the `ftl` solver: Mueller, Kim and Chentanez 2012, Fast simulation of inextensible
// hair and fur. One invocation per strand, because a vertex needs the final position of the vertex
// before it.
#extension GL_GOOGLE_include_directive : require

#include "common/rigid_frame.glsl"
#include "simulation/air_drag.glsl"
#include "simulation/constraints/bodies.glsl"
#include "simulation/constraints/global.glsl"
#include "simulation/guides.glsl"
#include "simulation/root_frame.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { SubstepPush push; };

layout(buffer_reference, scalar) readonly buffer FtlReference { FtlParameters parameters; };

// The point at the rest length from the leader, towards the follower; along +y if they coincide.
// Mueller, Kim and Chentanez 2012, Fast simulation of inextensible hair and fur, section 3.2.
vec3 followLeader(vec3 leader, vec3 follower, float rest_length) {
    vec3 edge = follower - leader;
    float len = length(edge);
    vec3 direction = len < kShortestSegment ? vec3(0.0, 1.0, 0.0) : edge / len;
    return leader + rest_length * direction;
}

void main() {
    GuideParameters guides = GuideReference(push.guides).parameters;
    GuideParameters from = GuideReference(push.from).parameters;
    FtlParameters params = FtlReference(push.solver).parameters;
    uint strand = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (strand >= guides.strand_count) return;  // no barrier follows

    State positions = State(guides.positions);
    State previous = State(guides.previous);
    State positions_before = State(from.positions);
    State previous_before = State(from.previous);
    Vectors rest = Vectors(guides.rest_positions);
    uint root = strand * guides.vertices_per_strand;
    float contact = 0.0;  // 1 from the first vertex that touches a body
    vec4 follicle = positions_before.at[root];
    vec3 leader_before = follicle.xyz;  // at the start of the substep
    RigidFrame root_frame = rootFrame(push.frame, push.roots, strand);
    vec3 leader = toWorld(root_frame, rest.at[root].xyz);
    positions.at[root] = vec4(leader, follicle.w);
    previous.at[root] = vec4(leader_before, 0.0);
    for (uint i = root + 1; i < root + guides.vertices_per_strand; ++i) {
        vec4 point = positions_before.at[i];
        vec3 before = point.xyz;
        vec3 correction = vec3(0.0);
        if (point.w > 0.0) {
            vec3 acceleration = guides.gravity;
            if (push.accelerations != kNoAddress) acceleration += Vectors(push.accelerations).at[i].xyz;
            vec3 predicted = integrate(
                before, previous_before.at[i].xyz, acceleration, guides.velocity_kept,
                guides.step.sub * guides.step.sub);
            float stiffness = params.global_stiffness;
            if (push.air != kNoAddress) {
                vec3 below = vec3(0.0);
                if (i + 1 < root + guides.vertices_per_strand)
                    below = directionOf(positions_before.at[i + 1].xyz - before);
                vec3 tangent = tangentBetween(directionOf(before - leader_before), below);
                vec3 air = Vectors(push.air).at[i].xyz;
                vec3 u = air - (before - previous_before.at[i].xyz) / guides.step.sub;
                float drag = dragFactor(push.drag, tangent, u, guides.step.sub);
                predicted =
                    before + withDrag(predicted - before, guides.step.sub * air, tangent, drag);
                stiffness = pullOn(stiffness, drag);
            }
            predicted = pullToRest(predicted, toWorld(root_frame, rest.at[i].xyz), stiffness);
            float rest_length = distance(rest.at[i].xyz, rest.at[i - 1].xyz);
            point.xyz = followLeader(leader, predicted, rest_length);
            correction = point.xyz - predicted;
            VertexContact met;
            point.xyz = pushOutOfBodies(
                point.xyz, before, bodiesAt(guides, i), push.frame, push.frame_before, met);
            if (met.held != kTouchesNone) contact = 1.0;
        }
        positions.at[i] = point;
        // The leader's velocity is its displacement less a part of its follower's correction (eq.
        // 9). Velocities are differences of positions, so the position before the substep is
        // shifted instead.
        vec3 corrected = i > root + 1 ? params.velocity_correction * correction : vec3(0.0);
        previous.at[i - 1].xyz = leader_before + corrected;
        previous.at[i] = vec4(before, contact);
        leader_before = before;
        leader = point.xyz;
    }
}

#version 460
// One step of the guides: integrate, then the constraints in the thesis's order (3.2), then collisions.
// One invocation per vertex; a workgroup holds as many whole strands as fit. Invocations past the last
// strand work on zeros and store nothing, so that all of them reach every barrier.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "common/quaternion.glsl"
#include "shared/simulation_structs.h"
#include "simulation/constraints/collide.glsl"
#include "simulation/constraints/global.glsl"
#include "simulation/constraints/length.glsl"
#include "simulation/constraints/local.glsl"
#include "simulation/integrate.glsl"

// A multiple of kVerticesPerStrand.
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kVerticesPerStrand = 8;

layout(push_constant, scalar) uniform Push { SimulateParameters params; };

layout(buffer_reference, scalar) buffer State { vec4 at[]; };
layout(buffer_reference, scalar) readonly buffer Vectors { vec4 at[]; };
layout(buffer_reference, scalar) readonly buffer Factors { float at[]; };
layout(buffer_reference, scalar) readonly buffer Capsules { Capsule at[]; };

// Both are read in one half and written to the other, so that a barrier is enough between two sweeps.
shared vec3 points[2][gl_WorkGroupSize.x];
shared vec4 rotations[2][gl_WorkGroupSize.x];
shared float rest_lengths[gl_WorkGroupSize.x];  // of the segment that ends in the vertex

// Unit tangent of the segment that ends in `vertex` >= 1 of the strand whose root is lane `root`. A
// segment without a direction, at rest or now, takes that of the one before it, the first one its rest
// tangent.
vec3 tangent(uint current, uint root, uint vertex, vec3 first_rest_tangent) {
    for (uint i = root + vertex; i > root; --i) {
        vec3 edge = points[current][i] - points[current][i - 1];
        float len = length(edge);
        if (len >= kShortestSegment && rest_lengths[i] >= kShortestSegment) return edge / len;
    }
    return first_rest_tangent;
}

// The rotations between successive tangents, multiplied from the root up to the segment that ends in
// each vertex (an inclusive scan by recursive doubling): what parallel transport along the strand makes of the rest
// tangent of segment 1. Returns that of the own vertex; `before` gets that of the vertex before, none at the root.
// All invocations must call it.
vec4 transportFrames(
    uint current, uint lane, uint root, uint vertex, vec3 first_rest_tangent, out vec4 before) {
    vec4 rotation = kNoRotation;
    if (vertex > 0) {
        vec3 from = vertex > 1 ? tangent(current, root, vertex - 1, first_rest_tangent)
                               : first_rest_tangent;
        rotation = rotationBetween(from, tangent(current, root, vertex, first_rest_tangent));
    }
    uint scanned = 0;
    rotations[scanned][lane] = rotation;
    barrier();
    for (uint reach = 1; reach < kVerticesPerStrand; reach *= 2) {
        if (vertex >= reach) rotation = multiply(rotation, rotations[scanned][lane - reach]);
        scanned = 1 - scanned;
        rotations[scanned][lane] = rotation;
        barrier();
    }
    before = vertex > 0 ? normalize(rotations[scanned][lane - 1]) : kNoRotation;
    return normalize(rotation);
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint vertex = lane % kVerticesPerStrand;
    uint root = lane - vertex;
    uint strands_per_group = gl_WorkGroupSize.x / kVerticesPerStrand;
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint strand = group * strands_per_group + lane / kVerticesPerStrand;
    uint index = strand * kVerticesPerStrand + vertex;
    bool present = strand < params.strand_count;

    bool has_next = vertex + 1 < kVerticesPerStrand;

    vec4 point = vec4(0.0);
    vec3 previous = vec3(0.0);
    vec3 rest_position = vec3(0.0);
    vec4 edge = vec4(0.0);       // rest edge that ends in the vertex
    vec4 next_edge = vec4(0.0);  // and the one that starts there
    float before_mass = 0.0;     // inverse masses of the neighbours
    float next_mass = 0.0;
    vec3 first_rest_edge = vec3(0.0);
    vec3 acceleration = params.gravity;
    float local_stiffness = 0.0;
    if (present) {
        point = State(params.positions).at[index];
        previous = State(params.previous).at[index].xyz;
        rest_position = Vectors(params.rest_positions).at[index].xyz;
        edge = Vectors(params.rest_edges).at[index];
        first_rest_edge = Vectors(params.rest_edges).at[index - vertex + 1].xyz;
        if (vertex > 0) before_mass = State(params.positions).at[index - 1].w;
        if (has_next) {
            next_edge = Vectors(params.rest_edges).at[index + 1];
            next_mass = State(params.positions).at[index + 1].w;
        }
        local_stiffness = Factors(params.local_stiffness).at[strand];
        if (params.accelerations != 0)
            acceleration += Vectors(params.accelerations).at[index].xyz;
    }
    float first_length = length(first_rest_edge);
    vec3 first_rest_tangent = first_length >= kShortestSegment ? first_rest_edge / first_length
                                                               : vec3(0.0, 1.0, 0.0);

    vec3 before_step = point.xyz;
    if (vertex == 0) {
        point.xyz = rest_position;
    } else {
        point.xyz = integrate(
            point.xyz, previous, acceleration, params.velocity_kept, params.time_step_squared);
        point.xyz = pullToRest(point.xyz, rest_position, params.global_stiffness);
    }
    uint current = 0;  // half of `points` that holds the positions
    points[current][lane] = point.xyz;
    rest_lengths[lane] = edge.w;
    barrier();

    // Red-black: segments that share no vertex move at the same time, those that end in odd vertices
    // (the root's own among them) first. The invocations of both ends work a segment out, each keeps its end.
    for (uint iteration = 0; iteration < params.local_iterations; ++iteration) {
        vec4 frame_before;
        vec4 frame =
            transportFrames(current, lane, root, vertex, first_rest_tangent, frame_before);
        vec3 goal_edge = rotate(frame_before, edge.xyz);
        vec3 next_goal_edge = rotate(frame, next_edge.xyz);
        for (uint parity = 1; parity != 3; ++parity) {
            if (vertex % 2 == parity % 2 && vertex > 0) {
                vec4 before = vec4(points[current][lane - 1], before_mass);
                pullToShape(before, point, goal_edge, local_stiffness);
            } else if (vertex % 2 != parity % 2 && has_next) {
                vec4 next = vec4(points[current][lane + 1], next_mass);
                pullToShape(point, next, next_goal_edge, local_stiffness);
            }
            current = 1 - current;
            points[current][lane] = point.xyz;
            barrier();
        }
    }
    for (uint iteration = 0; iteration < params.length_iterations; ++iteration) {
        for (uint parity = 1; parity != 3; ++parity) {
            if (vertex % 2 == parity % 2 && vertex > 0) {
                vec4 before = vec4(points[current][lane - 1], before_mass);
                projectLength(before, point, edge.w);
            } else if (vertex % 2 != parity % 2 && has_next) {
                vec4 next = vec4(points[current][lane + 1], next_mass);
                projectLength(point, next, next_edge.w);
            }
            current = 1 - current;
            points[current][lane] = point.xyz;
            barrier();
        }
    }

    if (point.w > 0.0) {
        for (uint i = 0; i < params.capsule_count; ++i)
            point.xyz = pushOut(point.xyz, Capsules(params.capsules).at[i]);
    }
    if (present) {
        State(params.positions).at[index] = point;
        State(params.previous).at[index] = vertex == 0 ? point : vec4(before_step, 0.0);
    }
}

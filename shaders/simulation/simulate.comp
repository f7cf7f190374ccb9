#version 460
// One step of the guides: integrate, then the constraints in the thesis's order (3.2), then
// collisions. One invocation per vertex; a workgroup holds as many whole strands as fit.
// Invocations past the last strand work on zeros and store nothing, so that all of them reach every
// barrier.
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

shared vec4 points[gl_WorkGroupSize.x];        // xyz position, w inverse mass
shared float rest_lengths[gl_WorkGroupSize.x];  // of the segment that ends in the vertex
shared vec4 rotations[2][gl_WorkGroupSize.x];  // the scan reads one half and writes the other

bool hasDirection(vec3 edge, float rest_length) {
    return length(edge) >= kShortestSegment && rest_length >= kShortestSegment;
}

// The smallest rotation to the tangent of the segment that ends in the vertex, from that of the
// last one before it with a direction, both at rest and now; before them all comes the rest tangent
// of the first. None for a segment without a direction, which takes over the tangent before it.
vec4 bend(uint lane, uint vertex, vec3 first_rest_tangent) {
    if (vertex == 0) return kNoRotation;
    vec3 upper = points[lane - 1].xyz;
    vec3 edge = points[lane].xyz - upper;
    if (!hasDirection(edge, rest_lengths[lane])) return kNoRotation;
    vec3 from = first_rest_tangent;
    for (uint back = 1; back < vertex; ++back) {
        vec3 end = upper;
        upper = points[lane - back - 1].xyz;
        if (hasDirection(end - upper, rest_lengths[lane - back])) {
            from = normalize(end - upper);
            break;
        }
    }
    return rotationBetween(from, normalize(edge));
}

// The bends multiplied from the root up to each vertex, an inclusive scan by recursive doubling:
// entry v is the rotation of parallel transport from the rest tangent of segment 1 to the tangent
// of segment v. Returns the half of `rotations` with the result. All invocations must call it.
uint transportFrames(uint lane, uint vertex, vec3 first_rest_tangent) {
    vec4 rotation = bend(lane, vertex, first_rest_tangent);
    uint latest = 0;
    rotations[latest][lane] = rotation;
    barrier();
    for (uint reach = 1; reach < kVerticesPerStrand; reach *= 2) {
        if (vertex >= reach) rotation = multiply(rotation, rotations[latest][lane - reach]);
        latest = 1 - latest;
        rotations[latest][lane] = rotation;
        barrier();
    }
    return latest;
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint vertex = lane % kVerticesPerStrand;
    uint strands_per_group = gl_WorkGroupSize.x / kVerticesPerStrand;
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint strand = group * strands_per_group + lane / kVerticesPerStrand;
    uint index = strand * kVerticesPerStrand + vertex;
    bool present = strand < params.strand_count;

    vec4 point = vec4(0.0);
    vec3 previous = vec3(0.0);
    vec3 rest_position = vec3(0.0);
    vec4 rest_edge = vec4(0.0);  // of the segment that ends here, xyz in the transported frame
    vec3 first_rest_edge = vec3(0.0);
    vec3 acceleration = params.gravity;
    float local_stiffness = 0.0;
    if (present) {
        point = State(params.positions).at[index];
        previous = State(params.previous).at[index].xyz;
        rest_position = Vectors(params.rest_positions).at[index].xyz;
        rest_edge = Vectors(params.rest_edges).at[index];
        first_rest_edge = Vectors(params.rest_edges).at[index - vertex + 1].xyz;
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
    points[lane] = point;
    rest_lengths[lane] = rest_edge.w;
    barrier();

    // Red-black: segments that share no vertex move at the same time, those that end in odd
    // vertices (the root's own among them) first.
    for (uint iteration = 0; iteration < params.local_iterations; ++iteration) {
        uint frames = transportFrames(lane, vertex, first_rest_tangent);
        vec3 goal_edge = vec3(0.0);
        if (vertex > 0) goal_edge = rotate(normalize(rotations[frames][lane - 1]), rest_edge.xyz);
        for (uint parity = 1; parity != 3; ++parity) {
            if (vertex > 0 && vertex % 2 == parity % 2)
                pullToShape(points[lane - 1], points[lane], goal_edge, local_stiffness);
            barrier();
        }
    }
    for (uint iteration = 0; iteration < params.length_iterations; ++iteration) {
        for (uint parity = 1; parity != 3; ++parity) {
            if (vertex > 0 && vertex % 2 == parity % 2)
                projectLength(points[lane - 1], points[lane], rest_edge.w);
            barrier();
        }
    }

    point = points[lane];
    if (point.w > 0.0) {
        for (uint i = 0; i < params.capsule_count; ++i)
            point.xyz = pushOut(
                point.xyz, before_step, Capsules(params.capsules).at[i], params.collision_margin,
                params.friction);
    }
    if (present) {
        State(params.positions).at[index] = point;
        State(params.previous).at[index] = vec4(before_step, 0.0);
    }
}

#version 460
// The wind's acceleration of every guide vertex, thesis eq. 14; one invocation per vertex.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "common/random.glsl"
#include "shared/simulation_structs.h"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { WindParameters params; };

layout(buffer_reference, scalar) readonly buffer Positions { vec4 at[]; };
layout(buffer_reference, scalar) writeonly buffer Accelerations { vec4 at[]; };

// The strand's own wind: the four directions, weighed by four random numbers that sum to 1. m/s^2
vec3 strandWind(uint strand) {
    vec4 weights;
    for (uint i = 0; i < 4; ++i)
        weights[i] = random01(params.seed, strand, kWindWeightPurpose + i);
    float sum = weights.x + weights.y + weights.z + weights.w;
    weights = sum > 0.0 ? weights / sum : vec4(0.25);
    return weights.x * params.directions[0] + weights.y * params.directions[1] +
           weights.z * params.directions[2] + weights.w * params.directions[3];
}

// The part of the wind across a segment with tangent T: (T x W) x T. None along a segment without
// one.
vec3 across(vec3 edge, vec3 wind) {
    float len = length(edge);
    if (len < kShortestSegment) return vec3(0.0);
    vec3 tangent = edge / len;
    return cross(cross(tangent, wind), tangent);
}

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint index = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= params.strand_count * params.vertices_per_strand) return;  // no barrier follows

    uint strand = index / params.vertices_per_strand;
    uint vertex = index % params.vertices_per_strand;
    vec3 acceleration = vec3(0.0);
    if (vertex > 0) {
        Positions positions = Positions(params.positions);
        vec3 edge = positions.at[index].xyz - positions.at[index - 1].xyz;
        acceleration = params.magnitude * across(edge, strandWind(strand));
    }
    Accelerations(params.accelerations).at[index] = vec4(acceleration, 0.0);
}

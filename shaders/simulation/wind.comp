#version 460
// Computes the wind's acceleration of every guide vertex, thesis eq. 14. One invocation per vertex.
#extension GL_GOOGLE_include_directive : require

#include "common/random.glsl"
#include "simulation/guides.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { WindPush push; };

// The strand's own wind, m/s^2: the four directions, weighted by four random numbers with sum 1.
vec3 strandWind(uint seed, uint strand) {
    vec4 weights;
    for (uint i = 0; i < 4; ++i)
        weights[i] = random01(seed, strand, kWindWeightPurpose + i);
    float sum = weights.x + weights.y + weights.z + weights.w;
    weights = sum > 0.0 ? weights / sum : vec4(0.25);
    return weights.x * push.directions[0] + weights.y * push.directions[1] +
           weights.z * push.directions[2] + weights.w * push.directions[3];
}

// The part of the wind across a segment with tangent T: (T x W) x T. It is 0 for a segment without
// a tangent.
vec3 across(vec3 edge, vec3 wind) {
    float len = length(edge);
    if (len < kShortestSegment) return vec3(0.0);
    vec3 tangent = edge / len;
    return cross(cross(tangent, wind), tangent);
}

void main() {
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= guides.strand_count * guides.vertices_per_strand) return;  // no barrier follows

    uint strand = index / guides.vertices_per_strand;
    uint vertex = index % guides.vertices_per_strand;
    vec3 acceleration = vec3(0.0);
    if (vertex > 0) {
        State positions = State(guides.positions);
        vec3 edge = positions.at[index].xyz - positions.at[index - 1].xyz;
        acceleration = push.magnitude * across(edge, strandWind(guides.seed, strand));
    }
    State(push.accelerations).at[index] = vec4(acceleration, 0.0);
}

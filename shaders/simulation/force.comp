#version 460
// Adds the accelerations of a force that the scene defines; one invocation per vertex. It does not
// run without one.
#extension GL_GOOGLE_include_directive : require

#include "common/random.glsl"
#include "extension/force.glsl"
#include "extension/turns.glsl"
#include "simulation/guides.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { ForcePush push; };

#ifdef HAIRBENCH_EXTENDED_FORCE

float guideRandom(GuidePoint point, uint which) {
    uint seed = GuideReference(push.guides).parameters.seed;
    return random01(hash(seed, point.guide, kForcePurpose), which, kForcePurpose);
}

#endif

void main() {
#ifdef HAIRBENCH_EXTENDED_FORCE
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= guides.strand_count * guides.vertices_per_strand) return;  // no barrier follows

    uint vertex = index % guides.vertices_per_strand;
    vec3 position = State(guides.positions).at[index].xyz;
    vec3 before = State(guides.previous).at[index].xyz;
    beginTurns();
    vec3 added = accelerateGuide(GuidePoint(
        position, (position - before) / guides.step.sub,
        float(vertex) / float(guides.vertices_per_strand - 1u),
        index / guides.vertices_per_strand, push.time));
    State(push.accelerations).at[index] += vec4(added, 0.0);
#endif
}

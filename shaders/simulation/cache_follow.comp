#version 460
// Pulls every guide vertex to its place in a cache: hair/simulation/cache.h. One invocation per
// vertex.
#extension GL_GOOGLE_include_directive : require

#include "common/rigid_frame.glsl"
#include "simulation/cache.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { CacheFollowPush push; };

void main() {
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint vertex = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (vertex >= guides.strand_count * guides.vertices_per_strand) return;  // no barrier follows

    float dt = guides.step.whole;
    vec3 start = toWorld(push.frame_before, Vectors(guides.rest_positions).at[vertex].xyz);
    vec3 end = toWorld(push.frame, cachedAt(push.place, vertex));
    vec3 position = Vectors(guides.positions).at[vertex].xyz;
    vec3 velocity = (position - Vectors(guides.previous).at[vertex].xyz) / guides.step.sub;
    // Predicts the vertex at the step's end without the spring.
    vec3 acceleration = Vectors(push.accelerations).at[vertex].xyz;
    vec3 velocity_then = velocity + dt * (guides.gravity + acceleration);
    vec3 position_then = position + dt * velocity_then;

    float damping = 2.0 * sqrt(push.stiffness);
    vec3 force = push.stiffness * (end - position_then) +
                 damping * ((end - start) / dt - velocity_then);
    acceleration += force / (1.0 + damping * dt + push.stiffness * dt * dt);
    State(push.accelerations).at[vertex] = vec4(acceleration, 0.0);
}

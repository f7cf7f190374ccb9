#version 460
// Computes the acceleration of the vertex that a hand holds: hair/simulation/forces.h. One
// invocation. It runs before pull.comp, which also changes the held vertex.
#extension GL_GOOGLE_include_directive : require

#include "simulation/guides.glsl"

layout(local_size_x = 1) in;

layout(push_constant, scalar) uniform Push { PullPush push; };

void main() {
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint held = push.held_vertex;
    float dt = guides.step.whole;
    vec3 position = Vectors(guides.positions).at[held].xyz;
    vec3 velocity = (position - Vectors(guides.previous).at[held].xyz) / guides.step.sub;
    // Predicts the vertex at the step's end without this hand.
    vec3 others = guides.gravity + Vectors(push.accelerations).at[held].xyz;
    vec3 velocity_then = velocity + dt * others;
    vec3 position_then = position + dt * velocity_then;

    vec3 acceleration =
        push.implicit * (push.stiffness * (push.hand - position_then) +
                         push.damping * (push.hand_velocity - velocity_then));
    State(push.held).at[0] = vec4(acceleration, 0.0);
}

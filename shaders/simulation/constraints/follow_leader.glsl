#ifndef HAIRBENCH_CONSTRAINT_FOLLOW_LEADER_GLSL
#define HAIRBENCH_CONSTRAINT_FOLLOW_LEADER_GLSL

#include "shared/distance_field_structs.h"
#include "shared/simulation_structs.h"

// The point at the rest length from the leader, towards the follower; along +y if they coincide.
// Mueller, Kim and Chentanez 2012, Fast simulation of inextensible hair and fur, section 3.2.
vec3 followLeader(vec3 leader, vec3 follower, float rest_length) {
    vec3 edge = follower - leader;
    float len = length(edge);
    vec3 direction = len < kShortestSegment ? vec3(0.0, 1.0, 0.0) : edge / len;
    return leader + rest_length * direction;
}

#endif

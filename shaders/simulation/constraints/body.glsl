// Access to bodies by number: first the capsules, then the distance fields.
#ifndef HAIRBENCH_CONSTRAINT_BODY_GLSL
#define HAIRBENCH_CONSTRAINT_BODY_GLSL

#include "simulation/constraints/collide.glsl"
#include "simulation/constraints/distance_field.glsl"

uint bodyCount(Bodies bodies) { return bodies.capsule_count + bodies.field_count; }

bool isOnHead(Bodies bodies, uint body) {
    if (body < bodies.capsule_count)
        return Capsules(bodies.capsules).at[body].follows == kFollowsHead;
    return BodyFields(bodies.fields).at[body - bodies.capsule_count].follows == kFollowsHead;
}

// Like gapTo() for the capsule or the field, in the body's own frame.
float gapToBody(Bodies bodies, uint body, float margin, vec3 position, out vec3 normal) {
    if (body < bodies.capsule_count)
        return gapTo(Capsules(bodies.capsules).at[body], margin, position, normal);
    return gapTo(
        BodyFields(bodies.fields).at[body - bodies.capsule_count].field, margin, position, normal);
}

#endif

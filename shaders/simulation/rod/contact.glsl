// Contact inside the solve of a rod. A vertex that bodies moved in the last substep is held on
// their surface by a stiff spring and by the previous contact force, so that the rod bears the
// pressure of the surface. Friction holds it along the surface in the same way, up to Coulomb's
// cone; beyond that it slides under the force at the rim of the cone. (A vertex that is only
// pushed out after the solve sinks in again by N h^2 / m under a force N.) Define kScratchRows
// first.
#ifndef HAIRBENCH_SIMULATION_ROD_CONTACT_GLSL
#define HAIRBENCH_SIMULATION_ROD_CONTACT_GLSL

#include "simulation/rod/strand.glsl"

// kSlides: a vertex slides from this share of the cone's rim on. kRests: when it comes to rest, its
// force is lowered to this share.
const float kSlides = 0.999;
const float kRests = 0.99;

// The part of a vertex's motion that a body holds back.
const float kSticking = 1.0;
const float kSliding = 0.0;  // everything except the direction of friction: it slides
const float kNormalOnly = -1.0; // only along the normal

// How a body holds a vertex.
struct ContactConstraint {
    vec3 normal;  // 0: not held
    float state;
    vec3 offset;  // from the held position to the predicted one
};

const ContactConstraint kNoConstraint = ContactConstraint(vec3(0.0), 0.0, vec3(0.0));

vec3 tangential(vec3 normal, vec3 force) { return force - dot(force, normal) * normal; }

// The projection onto the held directions of a vertex with this contact force.
mat3 constraintProjection(ContactConstraint constraint, vec3 contact) {
    if (constraint.state == kNormalOnly)
        return outerProduct(constraint.normal, constraint.normal);
    if (constraint.state == kSticking) return mat3(1.0);
    vec3 slides = normalize(tangential(constraint.normal, contact));
    return mat3(1.0) - outerProduct(slides, slides);
}

// How the nearest body holds a vertex that was at `before` and was pressed with `contact`.
// `predicted`: its predicted displacement, in the strand's unit.
ContactConstraint constraintOf(uint i, vec3 before, vec3 contact, vec3 predicted) {
    Bodies bodies = bodiesAt(guides, root + i);
    float nearest = kFar;
    vec3 facing = vec3(0.0);
    vec3 carried = before;
    for (uint body = 0; body < bodyCount(bodies); ++body) {
        bool on_head = isOnHead(bodies, body);
        vec3 there = on_head ? fromWorld(push.frame_before, before) : before;
        vec3 normal;
        float gap = gapToBody(bodies, body, bodies.margin, there, normal);
        if (gap >= nearest) continue;
        nearest = gap;
        facing = on_head ? rotate(push.frame.rotation, normal) : normal;
        carried = on_head ? toWorld(push.frame, there) : there;
    }
    float pressure = dot(contact, facing);
    if (pressure <= 0.0) return kNoConstraint;
    float shear = length(tangential(facing, contact));
    float state = shear < kSlides * bodies.friction * pressure ? kSticking
                  : shear > 0.0                                ? kSliding
                                                               : kNormalOnly;
    vec3 anchor = (carried - nearest * facing - before) / unit;
    return ContactConstraint(facing, state, predicted - anchor);
}

// The force on a vertex after a substep, within the friction cone. `slid`: its displacement from
// the held position. A vertex that slides in the direction of its friction has come to rest.
vec3 clampToFrictionCone(ContactConstraint constraint, vec3 force, vec3 slid, float friction) {
    float pressure = dot(force, constraint.normal);
    if (pressure <= 0.0) return vec3(0.0);
    vec3 shear = tangential(constraint.normal, force);
    float size = length(shear);
    float most = friction * pressure;
    if (constraint.state == kSliding)
        shear *= (dot(slid, shear) > 0.0 ? kRests : 1.0) * most / max(size, 1.0e-30);
    else if (size > most)
        shear *= most / size;
    return pressure * constraint.normal + shear;
}

#endif

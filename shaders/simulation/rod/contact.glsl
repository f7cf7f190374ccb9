// Contact inside the solve of a rod. A vertex that bodies moved in the last substep is held on
// their surface by a stiff spring and by the previous contact force, so that the rod bears the
// pressure of the surface. Friction holds it along the surface in the same way, up to Coulomb's
// cone; beyond that it slides freely along the surface under a friction at the rim of the cone. (A
// vertex that is only pushed out after the solve sinks in again by N h^2 / m under a force N.)
// Define kScratchRows first.
#ifndef HAIRBENCH_SIMULATION_ROD_CONTACT_GLSL
#define HAIRBENCH_SIMULATION_ROD_CONTACT_GLSL

#include "simulation/rod/strand.glsl"

// A vertex slides from this share of the cone's rim on.
const float kSlides = 0.999;

// The part of a vertex's motion that a body holds back.
const float kSticking = 1.0;
const float kSliding = 0.0;  // only along the normal

// How a body holds a vertex.
struct ContactConstraint {
    vec3 normal;  // 0: not held
    float state;
    vec3 offset;  // from the held position to the predicted one
};

const ContactConstraint kNoConstraint = ContactConstraint(vec3(0.0), 0.0, vec3(0.0));

vec3 tangential(vec3 normal, vec3 force) { return force - dot(force, normal) * normal; }

// The projection onto the held directions of a vertex.
mat3 constraintProjection(ContactConstraint constraint) {
    if (constraint.state == kSticking) return mat3(1.0);
    return outerProduct(constraint.normal, constraint.normal);
}

// How the nearest body holds a vertex that was at `before` and was pressed with `contact`, which
// turns with the body. The friction of a vertex that slides is at the rim of the cone.
// `predicted`: its predicted displacement, in the strand's unit.
ContactConstraint constraintOf(uint i, vec3 before, inout vec3 contact, vec3 predicted) {
    Bodies bodies = bodiesAt(guides, root + i);
    float nearest = kFar;
    vec3 facing = vec3(0.0);
    vec3 carried = before;
    vec3 pressed = contact;
    for (uint body = 0; body < bodyCount(bodies); ++body) {
        bool on_head = isOnHead(bodies, body);
        vec3 there = on_head ? fromWorld(push.frame_before, before) : before;
        vec3 normal;
        float gap = gapToBody(bodies, body, bodies.margin, there, normal);
        if (gap >= nearest) continue;
        nearest = gap;
        facing = on_head ? rotate(push.frame.rotation, normal) : normal;
        carried = on_head ? toWorld(push.frame, there) : there;
        pressed = contact;
        if (on_head)
            pressed = rotate(
                push.frame.rotation, rotate(conjugate(push.frame_before.rotation), contact));
    }
    contact = pressed;
    float pressure = dot(contact, facing);
    if (pressure <= 0.0) return kNoConstraint;
    vec3 shear = tangential(facing, contact);
    float size = length(shear);
    float most = bodies.friction * pressure;
    float state = size < kSlides * most ? kSticking : kSliding;
    if (state == kSliding) contact = pressure * facing + most / max(size, 1.0e-30) * shear;
    vec3 anchor = (carried - nearest * facing - before) / unit;
    return ContactConstraint(facing, state, predicted - anchor);
}

// The force on a vertex, in addition to the spring: the previous one. If it slides, its friction is
// that of the pressure with which the spring holds it at `off` from the held position.
// `spring`: the stiffness over the vertex's mass.
vec3 carriedForce(ContactConstraint constraint, vec3 contact, vec3 off, float spring) {
    if (constraint.state == kSticking) return contact;
    float pressure = dot(contact, constraint.normal);
    float change = max(-spring * dot(off, constraint.normal), -pressure) / pressure;
    return contact + change * tangential(constraint.normal, contact);
}

// The force on a vertex after a substep at `off` from the held position, within the friction cone.
// A vertex that slides turns its friction against its motion; if the motion is along the friction,
// the vertex has come to rest.
vec3 clampToFrictionCone(
    ContactConstraint constraint, vec3 contact, vec3 off, float spring, float friction) {
    vec3 force = contact - spring * (constraintProjection(constraint) * off);
    float pressure = dot(force, constraint.normal);
    if (pressure <= 0.0) return vec3(0.0);
    vec3 shear = tangential(constraint.normal, force);
    float most = friction * pressure;
    if (constraint.state == kSliding)
        shear = most / max(length(shear), 1.0e-30) * shear - tangential(constraint.normal, off);
    float size = length(shear);
    if (size > most) shear *= most / size;
    return pressure * constraint.normal + shear;
}

// A contact force on a surface with the normal `before` after the vertex has moved to where the
// normal is `now`. Other normals are of other bodies or sides.
vec3 alongSurface(vec3 force, vec3 before, vec3 now) {
    if (dot(before, now) < kSameSideCosine) return force;
    return rotate(rotationBetween(before, now), force);
}

#endif

// Contact inside the solve of a rod: a vertex that bodies moved in the last substep is held on
// their surface by a stiff spring and by the force that it was held with before, so that the rod bears
// what the surface presses with. Friction holds it along the surface in the same way, up to
// Coulomb's cone; beyond that it slides under the force of the cone's rim. (A vertex that is pushed
// out after the solve alone is taken back in by it, by N h^2 / m under a force N.) Before it:
// common/vectors.glsl or common/packed_vectors.glsl, and kScratchRows.
#ifndef HAIRBENCH_SIMULATION_ROD_CONTACT_GLSL
#define HAIRBENCH_SIMULATION_ROD_CONTACT_GLSL

#include "simulation/rod/strand.glsl"

// Share of the cone's rim from which on a vertex slides, and to which the force on one is lowered
// that has come to rest.
const float kSlides = 0.999;
const float kRests = 0.99;

// What of a vertex's motion a body holds back.
const float kHeldWhole = 1.0;
const float kHeldAcross = 0.0;  // all but the direction that friction acts in: it slides
const float kHeldOut = -1.0;    // along the normal alone

// How a body holds a vertex.
struct Hold {
    vec3 normal;  // 0: not at all
    float what;
    vec3 offset;  // from where it is held to where the prediction has it
};

const Hold kNoHold = Hold(vec3(0.0), 0.0, vec3(0.0));

vec3 along(vec3 normal, vec3 force) { return force - dot(force, normal) * normal; }

// The projection onto what is held back, of a vertex with that force of contact.
mat3 heldBy(Hold hold, vec3 contact) {
    if (hold.what == kHeldOut) return outerProduct(hold.normal, hold.normal);
    if (hold.what == kHeldWhole) return mat3(1.0);
    vec3 slides = normalize(along(hold.normal, contact));
    return mat3(1.0) - outerProduct(slides, slides);
}

// How the nearest body holds a vertex that was at `before`, where it pressed on it with `contact`.
// `predicted`: the way that the prediction moves it, in the strand's unit.
Hold holdOf(uint i, vec3 before, vec3 contact, vec3 predicted) {
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
    if (pressure <= 0.0) return kNoHold;
    float shear = length(along(facing, contact));
    float what = shear < kSlides * bodies.friction * pressure ? kHeldWhole
                 : shear > 0.0                                ? kHeldAcross
                                                              : kHeldOut;
    vec3 anchor = (carried - nearest * facing - before) / unit;
    return Hold(facing, what, predicted - anchor);
}

// The force on a vertex after a substep, within the cone of friction. `slid`: its way from where it
// was held. What slides the way that friction pushes it has come to rest.
vec3 withinCone(Hold hold, vec3 force, vec3 slid, float friction) {
    float pressure = dot(force, hold.normal);
    if (pressure <= 0.0) return vec3(0.0);
    vec3 shear = along(hold.normal, force);
    float size = length(shear);
    float most = friction * pressure;
    if (hold.what == kHeldAcross)
        shear *= (dot(slid, shear) > 0.0 ? kRests : 1.0) * most / max(size, 1.0e-30);
    else if (size > most)
        shear *= most / size;
    return pressure * hold.normal + shear;
}

#endif

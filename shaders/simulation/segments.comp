#version 460
// Moves segments of strands out of bodies, after a substep of a solver with positions as its state.
// One invocation per strand.
//
// A contact force pushes a segment at its contact place. The compliance of that place is computed
// for the strand as a chain of masses with segments of fixed length: everything below hangs on the
// segment, and everything above holds it. For a contact at x = (1 - s) a + s b of the segment with
// the direction d from a to b it is
//     K = (1 - s)^2 A + s^2 B - g g^T / (d.A d + d.B d),    g = s B d - (1 - s) A d,
// where A is the compliance of the end a with everything above, and B that of b with everything
// below. A vertex may hang on one segment of direction e whose other end has compliance y along e.
// Its own compliance is then w (1 - w / (w + y) e e^T), so a walk along the strand finds all of
// them. This is the result of eliminating the tensions (Featherstone 1983, The calculation of robot
// dynamics using articulated-body inertias). Contacts are solved in order down the strand, each
// within Coulomb's cone for the whole substep, and several times: a projected Gauss-Seidel method
// (Jean 1999, The non-smooth contact dynamics method).
#extension GL_GOOGLE_include_directive : require

#include "common/rigid_frame.glsl"
#include "shared/options.h"
#include "simulation/constraints/segment.glsl"
#include "simulation/guides.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(constant_id = kSegmentVerticesConstant) const uint kVerticesPerStrand = 8;

layout(push_constant, scalar) uniform Push { SegmentPush push; };

const uint kMostPasses = 8u;
const float kStill = 1.0e-6;  // m: passes end below this displacement
// Relative to a free vertex's compliance. Below it, a segment stands on the body with its strand
// behind it.
const float kLeastCompliance = 0.02;
const float kMostMove = 0.5;  // relative to a segment's length in a pass
// Relative to the compliance. It regularises directions that both a taut strand and friction hold.
const float kComplianceRegularization = 1.0e-3;

GuideParameters guides;
uint root;
vec4 points[kVerticesPerStrand];  // w: inverse mass
vec3 forces[kVerticesPerStrand];  // of contact, on the segment that ends there
EnteredPlane planes[kVerticesPerStrand];
uint contact_bodies[kVerticesPerStrand];
float clearances[kVerticesPerStrand];  // distances of segments from bodies in the first pass, m
float travelled;  // upper bound of the vertices' displacement since then, m
float below[kVerticesPerStrand];  // w / (w + y) for the segment below
float above[kVerticesPerStrand];  // the same for the segment above
vec3 shifts[kVerticesPerStrand];  // in a pass, by contacts above and at the segment that ends there
vec3 lifts[kVerticesPerStrand];  // in a pass, by contacts below

vec3 startOf(uint i) { return Vectors(push.starts).at[root + i].xyz; }

vec3 directionTo(uint i) {
    vec3 edge = points[i].xyz - points[i - 1].xyz;
    float len = length(edge);
    return len < kShortestSegment ? vec3(0.0) : edge / len;
}

// Displacement of a vertex of inverse mass w by a force, if a segment along e holds a share.
vec3 displacementBy(vec3 force, float w, float share, vec3 e) {
    return w * (force - share * dot(e, force) * e);
}

float shareOf(float w, float beyond) { return w > 0.0 ? w / (w + beyond) : 0.0; }

// The contact force for the displacements so far.
vec3 forceOf(SegmentContact contact, mat3 compliance, vec3 slid, vec3 force, float friction) {
    vec3 normal = contact.normal;
    float normal_compliance = dot(normal, compliance * normal);
    if (normal_compliance < kLeastCompliance) return force;
    float pressed = dot(normal, compliance * force) - contact.gap;
    if (friction > 0.0) {
        vec3 wanted = -contact.gap * normal - (slid - dot(slid, normal) * normal);
        vec3 sticking = force + inverse(compliance + mat3(kComplianceRegularization)) * wanted;
        float pressure = dot(sticking, normal);
        vec3 shear = sticking - pressure * normal;
        float size = length(shear);
        if (pressure > 0.0 && size <= friction * pressure) return sticking;
        if (size > 0.0) {
            vec3 rim = normal + friction / size * shear;
            return max(pressed / max(dot(normal, compliance * rim), 0.1 * normal_compliance),
                       0.0) * rim;
        }
    }
    return max(pressed / normal_compliance, 0.0) * normal;
}

// Makes one pass over all contacts. Returns the greatest displacement of a vertex, m; 0 without
// contacts.
float pushSegments(bool by_way) {
    below[kVerticesPerStrand - 1] = 0.0;
    vec3 after = vec3(0.0);
    for (uint i = kVerticesPerStrand - 1; i > 0; --i) {
        vec3 direction = directionTo(i);
        float across = dot(after, direction);
        float beyond = points[i].w * (1.0 - below[i] * across * across);
        below[i - 1] = shareOf(points[i - 1].w, beyond);
        after = direction;
    }
    float farthest = 0.0;
    above[0] = 0.0;
    shifts[0] = vec3(0.0);
    vec3 direction_above = vec3(0.0);
    for (uint i = 1; i < kVerticesPerStrand; ++i) {
        vec3 direction = directionTo(i);
        vec3 direction_below = vec3(0.0);
        if (i + 1 < kVerticesPerStrand) direction_below = directionTo(i + 1);
        float w_a = points[i - 1].w;
        float w_b = points[i].w;
        vec3 a_compliance = displacementBy(direction, w_a, above[i - 1], direction_above);
        vec3 b_compliance = displacementBy(direction, w_b, below[i], direction_below);
        float along_a = dot(direction, a_compliance);
        float along_b = dot(direction, b_compliance);
        above[i] = shareOf(w_b, along_a);
        shifts[i] = along_b > 0.0 ? dot(direction, shifts[i - 1]) / along_b * b_compliance
                                  : vec3(0.0);
        lifts[i - 1] = vec3(0.0);

        vec3 a = points[i - 1].xyz + shifts[i - 1];
        vec3 b = points[i].xyz + shifts[i];
        SegmentContact contact = kNoContact;
        MovingSegment segment;
        // Later passes test only segments that touch, or that may have moved into the body that was
        // nearest.
        bool held = forces[i] != vec3(0.0);
        for (bool near = by_way || held || clearances[i] < travelled; near; near = false) {
            segment = movingSegment(guides, root + i, w_a, a, b, startOf(i - 1), startOf(i));
            uint first = by_way ? 0u : contact_bodies[i];
            float clearance;
            contact = contactOf(
                segment, guides.bodies, first, by_way ? bodyCount(guides.bodies) : first + 1u,
                push.frame, push.frame_before, by_way, push.keeps_rest != 0u, planes[i],
                clearance);
            if (by_way) {
                clearances[i] = clearance;
                contact_bodies[i] = contact.body;
            }
        }
        for (bool touches = (contact.gap < 0.0 || held) &&
                            contact.normal != vec3(0.0) && along_a + along_b > 0.0;
             touches; touches = false) {
            float s = contact.at;
            float r = 1.0 - s;
            mat3 compliance = mat3(r * r * w_a + s * s * w_b);
            compliance -=
                r * r * w_a * above[i - 1] * outerProduct(direction_above, direction_above);
            compliance -= s * s * w_b * below[i] * outerProduct(direction_below, direction_below);
            vec3 g = s * b_compliance - r * a_compliance;
            compliance -= outerProduct(g, g) / (along_a + along_b);
            vec3 slid = movedPast(segment, contact, push.frame, push.frame_before);
            vec3 change =
                forceOf(contact, compliance, slid, forces[i], guides.bodies.friction) - forces[i];
            float tension = dot(g, change) / (along_a + along_b);
            vec3 move_a = r * displacementBy(change, w_a, above[i - 1], direction_above) +
                          tension * a_compliance;
            vec3 move_b = s * displacementBy(change, w_b, below[i], direction_below) -
                          tension * b_compliance;
            float move = max(length(move_a), length(move_b));
            float part = min(1.0, kMostMove * distance(a, b) / max(move, 1.0e-30));
            forces[i] += part * change;
            lifts[i - 1] = part * move_a;
            shifts[i] += part * move_b;
            farthest = max(farthest, move);
        }
        direction_above = direction;
    }
    return farthest;
}

// Moves vertices by the result of a pass and restores the lengths of segments. The result of a pass
// is accurate to first order in the displacements.
void movePoints(float lengths[kVerticesPerStrand]) {
    vec3 lifted = vec3(0.0);  // with the vertex below
    lifts[kVerticesPerStrand - 1] = vec3(0.0);
    for (uint i = kVerticesPerStrand - 1; i > 0; --i) {
        vec3 direction = directionTo(i);
        vec3 direction_above = vec3(0.0);
        if (i > 1) direction_above = directionTo(i - 1);
        vec3 lift = lifts[i] + lifted;
        vec3 compliance = displacementBy(direction, points[i - 1].w, above[i - 1], direction_above);
        float along = dot(direction, compliance);
        lifted = along > 0.0 ? dot(direction, lift) / along * compliance : vec3(0.0);
        points[i].xyz += shifts[i] + lift;
    }
    for (uint i = 1; i < kVerticesPerStrand; ++i)
        if (points[i].w > 0.0) points[i].xyz = points[i - 1].xyz + lengths[i] * directionTo(i);
}

void main() {
    guides = GuideReference(push.guides).parameters;
    uint strand = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (strand >= guides.strand_count) return;  // no barrier follows
    root = strand * kVerticesPerStrand;
    State positions = State(guides.positions);
    State previous = State(guides.previous);

    float lengths[kVerticesPerStrand];
    points[0] = positions.at[root];
    lengths[0] = 0.0;
    for (uint i = 1; i < kVerticesPerStrand; ++i) {
        points[i] = positions.at[root + i];
        lengths[i] = distance(points[i].xyz, points[i - 1].xyz);
        forces[i] = vec3(0.0);
    }
    bool touches = false;
    travelled = 0.0;
    for (uint pass = 0; pass < kMostPasses; ++pass) {
        float moved = pushSegments(pass == 0);
        if (moved == 0.0) break;
        movePoints(lengths);
        travelled += 2.0 * moved;
        touches = true;
        if (moved < kStill) break;
    }
    if (!touches) return;
    float contact = 0.0;  // 1 from the first segment that touches a body
    for (uint i = 1; i < kVerticesPerStrand; ++i) {
        if (forces[i] != vec3(0.0)) contact = 1.0;
        positions.at[root + i] = points[i];
        if (contact > 0.0) previous.at[root + i].w = contact;
    }
}

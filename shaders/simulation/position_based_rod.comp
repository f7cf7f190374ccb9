#version 460
// One substep of the `position_based_rod` solver, one invocation per strand: Kugelstadt and
// Schoemer 2016, Position and orientation based Cosserat rods, with the compliances of Macklin,
// Mueller and Chentanez 2016, XPBD. hair/reference/compared_rods.h describes the constraints and
// the differences from the papers. See rod_structs.h for the units.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"
#include "shared/rod_structs.h"

// Rows of the scratch memory. kMoved: the vertex's displacement in the substep. kStretchForce: the
// multipliers of the segment's stretch and shear. kJointForce: those of bend and twist of the joint
// at its start. kBefore: its orientation at the start of the substep. kDrag: the tangent and the
// strength of the drag across it.
const uint kScratchRows = kPositionBasedScratchRows;
const uint kMoved = 0u;
const uint kStretchForce = 1u;
const uint kJointForce = 2u;
const uint kBefore = 3u;
const uint kDrag = 4u;

#include "simulation/rod/edges.glsl"
#include "simulation/rod/symmetric.glsl"

const float kLeastStiffness = 1.0e-15;  // limp compared with any mass; its inverse is a float

// Predicts velocities with the forces of the substep, and the resulting positions.
void predict() {
    takeRoot();
    vec3 edges = vec3(0.0);  // from the root to here
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        RodMotion motion = motionAt(i);
        vec4 drag;
        vec3 moved = predictedMove(i, motion, edges, drag);
        setScratch(i, kMoved, vec4(moved, 0.0));
        setScratch(i, kStretchForce, vec4(0.0));
        setScratch(i, kJointForce, vec4(0.0));
        setScratch(i, kBefore, motion.orientation);
        setScratch(i, kDrag, drag);
        vec4 orientation =
            turned(motion.orientation, guides.velocity_kept * motion.angular_velocity);
        storeVector(rod.motion, orientationIndex(i), orientation);
    }
}

vec3 movedAt(uint i) { return i > 0 ? scratchAt(i, kMoved).xyz : root_moved; }

// The inverse mass of a vertex: x across the hair, y its excess along the hair, where air does not
// add to the mass.
vec2 inverseMassOf(uint i, vec4 drag) {
    if (i == 0 || isPinned(i)) return vec2(0.0);
    float mass = segmentRow(rod.segments, i, kRodStiffness, guides.strand_count, strand).y;
    float across = 1.0 / (mass * (1.0 + drag.w));
    return vec2(across, 1.0 / mass - across);
}

// The inverse of a quarter of a segment's inertia. That quarter is the mass of the orientation if
// its four numbers are treated as a position.
float inverseInertiaOf(uint i) {
    if (i == 0) return 0.0;
    float len = max(restLength(i), kLeastLength);
    return 3.0 / (len * len * len);
}

// Projects stretch and shear of segment i: edge / length = d3.
void projectSegment(uint i) {
    RodSegment segment = loadSegment(rod.segments, i, guides.strand_count, strand);
    float len = max(segment.rest_length, kLeastLength);
    vec3 above = movedAt(i - 1);
    vec3 below = movedAt(i);
    vec4 drag_above = i > 1 ? scratchAt(i - 1, kDrag) : vec4(0.0);
    vec4 drag_below = scratchAt(i, kDrag);
    vec2 w_above = inverseMassOf(i - 1, drag_above);
    vec2 w_below = inverseMassOf(i, drag_below);
    float w_turn = inverseInertiaOf(i);
    vec4 orientation = orientationAt(i);
    vec3 force = scratchAt(i, kStretchForce).xyz;

    vec3 edge = edgeAt(i) + below - above;
    vec3 residual = (edge - segment.rest_length * axisOf(orientation)) / len;
    float compliance = 1.0 / (max(stretching, kLeastStiffness) * len);
    vec3 wanted = -(residual + compliance * force);
    float isotropic = (w_above.x + w_below.x) / (len * len) + 4.0 * w_turn + compliance;
    vec3 more;
    if (push.air == kNoAddress) {
        more = wanted / isotropic;
    } else {
        mat3 denominator = mat3(isotropic);
        denominator += w_above.y / (len * len) * outerProduct(drag_above.xyz, drag_above.xyz);
        denominator += w_below.y / (len * len) * outerProduct(drag_below.xyz, drag_below.xyz);
        more = inverseOfSymmetric(denominator) * wanted;
    }
    setScratch(i, kStretchForce, vec4(force + more, 0.0));
    vec3 along_above = dot(drag_above.xyz, more) * drag_above.xyz;
    vec3 along_below = dot(drag_below.xyz, more) * drag_below.xyz;
    above -= (w_above.x * more + w_above.y * along_above) / len;
    below += (w_below.x * more + w_below.y * along_below) / len;
    if (i > 1) setScratch(i - 1, kMoved, vec4(above, 0.0));
    setScratch(i, kMoved, vec4(below, 0.0));
    vec4 turn = multiply(multiply(vec4(more, 0.0), orientation), vec4(0.0, 0.0, 1.0, 0.0));
    storeVector(
        rod.motion, orientationIndex(i), normalize(orientation + 2.0 * w_turn * turn));
}

// Projects bend and twist of the joint at the start of segment i: no rotation from one frame to the
// other.
void projectJoint(uint i) {
    RodSegment segment = loadSegment(rod.segments, i, guides.strand_count, strand);
    vec4 above = orientationAt(i - 1);
    vec4 orientation = orientationAt(i);
    vec4 half_back = conjugate(segment.half_rotation);
    vec4 first = multiply(above, segment.half_rotation);
    vec4 second = multiply(orientation, half_back);
    vec4 r = multiply(conjugate(first), second);
    float nearer = r.w < 0.0 ? -1.0 : 1.0;
    vec3 stiffness = 4.0 * vec3(vec2(segment.bend_stiffness), segment.twist_stiffness);
    vec3 compliance = 1.0 / max(stiffness, vec3(kLeastStiffness));
    float w_above = inverseInertiaOf(i - 1);
    float w_below = inverseInertiaOf(i);

    vec3 force = scratchAt(i, kJointForce).xyz;
    vec3 more =
        -(nearer * r.xyz + compliance * force) / (w_above + w_below + compliance);
    setScratch(i, kJointForce, vec4(force + more, 0.0));
    vec4 turn = vec4(nearer * more, 0.0);
    vec4 turned_below = multiply(multiply(first, turn), segment.half_rotation);
    storeVector(
        rod.motion, orientationIndex(i), normalize(orientation + w_below * turned_below));
    if (i > 1) {
        vec4 turned_above = multiply(multiply(second, conjugate(turn)), half_back);
        storeVector(
            rod.motion, orientationIndex(i - 1), normalize(above + w_above * turned_above));
    }
}

// Projects every segment and joint once. Odd ones go down the strand, even ones up, in alternation.
void projectAll() {
    uint count = guides.vertices_per_strand - 1;
    uint last_odd = count - 1 - count % 2;
    for (uint k = 0; k < count; ++k) {
        uint i = 1 + (k % 2 == 0 ? k : last_odd - (k - 1));
        projectSegment(i);
        projectJoint(i);
    }
}

// Sets the angular velocity from the segment's rotation in the substep.
void setTurn(uint i) {
    vec4 turn = multiply(orientationAt(i), conjugate(scratchAt(i, kBefore)));
    uint index = motionIndex(i, kRodAngularVelocity, guides.strand_count, strand);
    storeVector(rod.motion, index, vec4((turn.w < 0.0 ? -2.0 : 2.0) * turn.xyz, 0.0));
}

void main() {
    if (!takeStrand()) return;  // no barrier follows
    predict();
    for (uint i = 0; i < rod.iterations; ++i) projectAll();
    for (uint i = 1; i < guides.vertices_per_strand; ++i) setTurn(i);
    finish();
}

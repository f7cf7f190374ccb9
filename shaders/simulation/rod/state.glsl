// The `rod` solver's memory, and rotations of segments.
#ifndef HAIRBENCH_SIMULATION_ROD_STATE_GLSL
#define HAIRBENCH_SIMULATION_ROD_STATE_GLSL

#include "common/quaternion.glsl"
#include "common/vectors.glsl"
#include "shared/rod_structs.h"
#include "simulation/guides.glsl"

layout(buffer_reference, scalar) readonly buffer RodReference { RodParameters parameters; };

// A segment, and the motion of it and of the vertex at its end: rod_structs.h.
struct RodSegment {
    vec4 half_rotation;
    float rest_length;
    float mass;
    float bend_stiffness;
    float twist_stiffness;
};

struct RodMotion {
    vec4 orientation;
    vec3 angular_velocity;
    vec3 velocity;
    vec3 residual;
    vec3 contact;  // the force of bodies on the vertex, if it is carried
};

// The index of a row of vertex i in an array with `rows` rows per vertex and `strands` entries per
// row.
uint rodIndex(uint i, uint row, uint rows, uint strands, uint strand) {
    return (i * rows + row) * strands + strand;
}

vec4 segmentRow(Address segments, uint i, uint row, uint strands, uint strand) {
    return loadVector(segments, rodIndex(i, row, kRodSegmentRows, strands, strand));
}

RodSegment loadSegment(Address segments, uint i, uint strands, uint strand) {
    vec4 rotation = segmentRow(segments, i, kRodHalfRotation, strands, strand);
    vec4 numbers = segmentRow(segments, i, kRodStiffness, strands, strand);
    return RodSegment(rotation, numbers.x, numbers.y, numbers.z, numbers.w);
}

uint setIndex(uint i, uint strands, uint strand) { return rodIndex(i, 0, 1, strands, strand); }

uint motionIndex(uint i, uint row, uint strands, uint strand) {
    return rodIndex(i, row, kRodMotionRows, strands, strand);
}

RodMotion loadMotion(Address motion, uint i, uint strands, uint strand) {
    vec4 orientation = loadVector(motion, motionIndex(i, kRodOrientation, strands, strand));
    vec4 turns = loadVector(motion, motionIndex(i, kRodAngularVelocity, strands, strand));
    vec4 moves = loadVector(motion, motionIndex(i, kRodVelocity, strands, strand));
    vec4 residual = loadVector(motion, motionIndex(i, kRodResidual, strands, strand));
    return RodMotion(
        orientation, turns.xyz, moves.xyz, residual.xyz, vec3(turns.w, moves.w, residual.w));
}

void storeMotion(Address motion, uint i, uint strands, uint strand, RodMotion moves) {
    storeVector(motion, motionIndex(i, kRodOrientation, strands, strand), moves.orientation);
    storeVector(
        motion, motionIndex(i, kRodAngularVelocity, strands, strand),
        vec4(moves.angular_velocity, moves.contact.x));
    storeVector(
        motion, motionIndex(i, kRodVelocity, strands, strand),
        vec4(moves.velocity, moves.contact.y));
    storeVector(
        motion, motionIndex(i, kRodResidual, strands, strand),
        vec4(moves.residual, moves.contact.z));
}

// The third axis of the frame of a unit quaternion.
vec3 axisOf(vec4 q) {
    return vec3(
        2.0 * (q.x * q.z + q.w * q.y), 2.0 * (q.y * q.z - q.w * q.x),
        q.w * q.w + q.z * q.z - q.x * q.x - q.y * q.y);
}

// The rotation as a matrix; its columns are the three axes.
mat3 matrixOf(vec4 q) {
    return mat3(
        q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z, 2.0 * (q.x * q.y + q.w * q.z),
        2.0 * (q.x * q.z - q.w * q.y), 2.0 * (q.x * q.y - q.w * q.z),
        q.w * q.w + q.y * q.y - q.x * q.x - q.z * q.z, 2.0 * (q.y * q.z + q.w * q.x), axisOf(q));
}

// Turns the orientation by a rotation vector, to second order; by less than half a turn for any
// length.
vec4 turned(vec4 orientation, vec3 rotation) {
    return normalize(multiply(vec4(0.5 * rotation, 1.0), orientation));
}

// The change of a vector by turned(). It stays exact if the difference of the two would be lost in
// rounding.
vec3 gainOf(vec3 v, vec3 rotation) {
    vec3 t = 0.5 * rotation;
    vec3 swept = cross(t, v);
    return 2.0 / (1.0 + dot(t, t)) * (swept + cross(t, swept));
}

#endif

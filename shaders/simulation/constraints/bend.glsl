#ifndef HAIRBENCH_CONSTRAINT_BEND_GLSL
#define HAIRBENCH_CONSTRAINT_BEND_GLSL

#extension GL_EXT_control_flow_attributes : require

#include "shared/distance_field_structs.h"
#include "shared/simulation_structs.h"

// The local constraint as an energy. It pulls segment e_i to its rest edge in the frame that
// parallel transport carries to the segment above,
//     E = sum 1/2 K |e_i - R_(i-1) e0_i|^2,
// on a strand that does not stretch. It does not twist either, since parallel transport does not
// turn about the strand. Every term depends only on the rotation of a segment against the one
// above. The constraint therefore acts as a couple: c_i = K e_i x R_(i-1) e0_i on that segment, and
// -c_i on the frame above, which passes it up the strand. (Thesis eq. 11 turns the segment but not
// the one above. It is not the gradient of any energy.)
//
// A substep of length h is one linear system. Segments turn by w_i, so that vertices move by d_i =
// d_(i-1) + w_i x e_i. Joints turn by w_i - w_(i-1), perpendicular to the axis s_i between both
// segments: this keeps the rotations from one tangent to the next the smallest ones. The substep
// minimises
//     sum 1/2 d M d - b d + 1/2 k_i |w_i - w_(i-1)|^2 - h^2 c_i (w_i - w_(i-1))
//         + 1/2 T_i l_i |w_i across e_i|^2
// with all forces of its start. b is h^2 times the sum of the accelerations, plus the displacement
// without any. M is the mass with the contributions of air and of the pull toward the rest
// position. T_i is the tension, which straightens (Tournier et al. 2015, Stable constrained
// dynamics). Where d = 0 is the solution, forces and couples are in balance for any h, stiffness
// and estimate of the tension. k_i = h max(h, h0) K l_i^2 is implicit damping of joint rotations
// only, with the time constant h0 = 1/60 s. At h = h0 it is that of implicit Euler. With shorter
// steps, hair is damped as much in a second.
//
// Lengths are exact, because a segment is turned. The unknowns are eliminated from the tip up:
// Featherstone 1983, The calculation of robot dynamics using articulated-body inertias.

const float kMostTurned = 1.0;  // rad in a substep
// Mass of a held vertex for each vertex of the strand. The length constraint corrects its position.
const float kHeldMass = 100.0;
const float kLeastSize = 1.0e-37;  // of a determinant

// A symmetric matrix: its diagonal, and the entries yz, xz, xy.
struct Symmetric {
    vec3 diagonal;
    vec3 off_diagonal;
};

vec3 times(Symmetric m, vec3 v) {
    return m.diagonal * v + m.off_diagonal.zxy * v.yzx + m.off_diagonal.yzx * v.zxy;
}

Symmetric plus(Symmetric a, Symmetric b) {
    return Symmetric(a.diagonal + b.diagonal, a.off_diagonal + b.off_diagonal);
}

Symmetric scaled(float factor, Symmetric m) {
    return Symmetric(factor * m.diagonal, factor * m.off_diagonal);
}

// a b^T + b a^T.
Symmetric symmetricProduct(vec3 a, vec3 b) {
    return Symmetric(2.0 * a * b, a.yzx * b.zxy + a.zxy * b.yzx);
}

// factor v v^T.
Symmetric outerSquare(float factor, vec3 v) {
    return Symmetric(factor * v * v, factor * v.yzx * v.zxy);
}

// factor (1 - v v^T) for a unit vector.
Symmetric perpendicularProjection(float factor, vec3 v) {
    Symmetric square = outerSquare(-factor, v);
    return Symmetric(square.diagonal + factor, square.off_diagonal);
}

// m + transpose(m).
Symmetric plusTranspose(mat3 m) {
    return Symmetric(
        2.0 * vec3(m[0].x, m[1].y, m[2].z),
        vec3(m[1].z + m[2].y, m[2].x + m[0].z, m[0].y + m[1].x));
}

// The minimum over all below a vertex, as a function of the vertex's displacement d and the
// rotation w of the segment that ends there: d hessian_move d / 2 + d hessian_mixed w + w
// hessian_turn w / 2 - push d - couple w. `force` is the sum of the forces on the vertices, times
// h^2.
struct BendBelow {
    Symmetric hessian_move;
    mat3 hessian_mixed;
    Symmetric hessian_turn;
    vec3 push;
    vec3 couple;
    vec3 force;
};

BendBelow noBody() {
    Symmetric none = Symmetric(vec3(0.0), vec3(0.0));
    return BendBelow(none, mat3(0.0), none, vec3(0.0), vec3(0.0), vec3(0.0));
}

// Rotation of the segment below a joint: kept w + past (axis w) - move_response d + constant_term,
// with d and w of the vertex and the segment above.
struct BendJoint {
    Symmetric kept;
    mat3 move_response;
    vec3 constant_term;
    vec3 past;  // the part of a rotation about the axis that passes the joint
};

// The loads of a vertex in a substep.
struct BendLoad {
    vec3 push;     // b, m
    float along;   // pull of the air along the strand, which turns with the strand, m
    vec3 tangent;  // air brakes the vertex across this tangent
    float drag;
};

const BendLoad kNoLoad = BendLoad(vec3(0.0), 0.0, vec3(0.0), 0.0);

// `moved`: displacement by everything except air and the pull toward the rest position;
// `pull`: that pull's acceleration times h^2.
BendLoad freeLoad(vec3 moved, vec3 pull) { return BendLoad(moved + pull, 0.0, vec3(0.0), 0.0); }

// Adds drag with the coefficient at the substep's start and the velocity at its end: air_drag.glsl.
// The drag stays perpendicular to a turning strand. This is equivalent to an additional force of
// air along it.
void addAir(
    inout BendLoad load, vec3 tangent, float drag, vec3 air, vec3 velocity, float substep) {
    load.push += drag * substep * (air - dot(tangent, air) * tangent);
    load.along = drag * substep * dot(tangent, air - velocity);
    load.tangent = tangent;
    load.drag = drag;
}

// `mass`: relative to a vertex's own, without air. `root_moved`: displacement of the root.
void addVertex(inout BendBelow below, BendLoad load, float mass, vec3 root_moved) {
    Symmetric mass_matrix = perpendicularProjection(load.drag, load.tangent);
    mass_matrix.diagonal += mass;
    below.hessian_move = plus(below.hessian_move, mass_matrix);
    below.push += load.push;
    below.force += load.push + load.along * load.tangent - times(mass_matrix, root_moved);
}

// Continues to the vertex above. `edge` is the segment's edge, `goal` its target edge and `axis`
// the axis of its joint. `stiffness`: h^2 K, and k / l^2.
BendJoint addJoint(inout BendBelow below, vec3 edge, vec3 goal, vec3 axis, vec2 stiffness) {
    float square = dot(edge, edge);
    float len = sqrt(square);
    vec3 direction = edge / len;
    below.hessian_turn =
        plus(below.hessian_turn,
             perpendicularProjection(len * max(dot(below.force, direction), 0.0), direction));

    // Moves the reference from the vertex at the segment's end to that at its start: d = d_above -
    // edge x w.
    mat3 lever =
        mat3(vec3(0.0, edge.z, -edge.y), vec3(-edge.z, 0.0, edge.x), vec3(edge.y, -edge.x, 0.0));
    mat3 hessian_mixed = below.hessian_mixed;
    [[unroll]] for (uint k = 0; k < 3; ++k) hessian_mixed[k] -= times(below.hessian_move, lever[k]);
    mat3 raised;
    [[unroll]] for (uint k = 0; k < 3; ++k)
        raised[k] = cross(edge, 0.5 * (below.hessian_mixed[k] + hessian_mixed[k]));
    Symmetric hessian_turn = plus(below.hessian_turn, plusTranspose(raised));
    vec3 couple = below.couple + cross(edge, below.push);

    // The inverse of k + hessian_turn for rotations perpendicular to the axis: [s] H [s]^T / (s
    // adj(H) s).
    float joint = stiffness.y * square;
    Symmetric held = Symmetric(hessian_turn.diagonal + joint, hessian_turn.off_diagonal);
    vec3 d = held.diagonal;
    vec3 o = held.off_diagonal;
    Symmetric cofactors = Symmetric(d.yzx * d.zxy - o * o, o.yzx * o.zxy - d * o);
    float size = dot(axis, times(cofactors, axis));
    mat3 turned = mat3(
        times(held, vec3(0.0, -axis.z, axis.y)), times(held, vec3(axis.z, 0.0, -axis.x)),
        times(held, vec3(-axis.y, axis.x, 0.0)));
    [[unroll]] for (uint k = 0; k < 3; ++k) turned[k] = cross(axis, turned[k]) / max(size, kLeastSize);
    Symmetric compliance = Symmetric(
        vec3(turned[0].x, turned[1].y, turned[2].z), vec3(turned[1].z, turned[0].z, turned[0].y));

    vec3 moment = stiffness.x * cross(edge, goal);
    vec3 drive = couple + moment;
    vec3 about = times(hessian_turn, axis);
    vec3 past = axis - times(compliance, about);
    mat3 turn_response = transpose(hessian_mixed);
    mat3 move_response =
        mat3(times(compliance, turn_response[0]), times(compliance, turn_response[1]),
             times(compliance, turn_response[2]));
    BendJoint answer =
        BendJoint(scaled(joint, compliance), move_response, times(compliance, drive), past);

    // The remainder for the vertex above.
    below.hessian_move.diagonal -=
        vec3(dot(move_response[0], turn_response[0]), dot(move_response[1], turn_response[1]),
             dot(move_response[2], turn_response[2]));
    below.hessian_move.off_diagonal -=
        vec3(dot(move_response[1], turn_response[2]), dot(move_response[0], turn_response[2]),
             dot(move_response[0], turn_response[1]));
    below.push -= drive * move_response;
    below.hessian_mixed =
        joint * transpose(move_response) + outerProduct(hessian_mixed * past, axis);
    below.couple = joint * answer.constant_term + dot(past, drive) * axis - moment;
    below.hessian_turn = plus(
        plus(perpendicularProjection(joint, axis), scaled(-joint, answer.kept)),
        plus(symmetricProduct(joint * (axis - past), axis), outerSquare(dot(past, about), axis)));
    return answer;
}

// State that a walk down the strand passes on.
struct BendAbove {
    vec3 place;
    vec3 moved;  // d
    vec3 turned;  // w
};

// Moves the vertex with the rotation of its segment.
void turnSegment(inout BendAbove above, BendJoint joint, vec3 edge, vec3 axis, float rest_length) {
    vec3 move_response = joint.move_response * above.moved;
    above.turned = times(joint.kept, above.turned) - move_response + joint.constant_term +
                   dot(axis, above.turned) * joint.past;
    above.moved += cross(above.turned, edge);
    // Second order, so that a free hair continues its rotation.
    vec3 turn = above.turned / max(length(above.turned) / kMostTurned, 1.0);
    vec3 gain = cross(turn, edge);
    above.place += rest_length * normalize(edge + gain + 0.5 * cross(turn, gain));
}

// The axis of the joint between unit tangents. It is the lower tangent if they are opposite.
vec3 jointAxis(vec3 above, vec3 below) {
    vec3 sum = above + below;
    float len = length(sum);
    return len < 1.0e-3 ? below : sum / len;
}

#endif

#version 460
// One substep of the `rod` solver, one invocation per strand: implicit Euler for an elastic rod
// that neither stretches nor shears. The unknowns are rotations of the segments; the vertices
// follow. Each iteration is a Newton step that eliminates the segments one by one from the tip up:
// Featherstone 1983, The calculation of robot dynamics using articulated-body inertias. rod.h
// describes the rod and generalised alpha, with sources; rod_structs.h describes the units.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"
#include "shared/options.h"
#include "shared/rod_structs.h"

// True if contact forces are carried to the next substep: simulation/rod/contact.glsl.
layout(constant_id = kWarmStartConstant) const bool kWarmStart = false;

// How segments, and not only vertices, collide with bodies: kRodNoSegments and following.
layout(constant_id = kRodSegmentsConstant) const uint kSegments = kRodNoSegments;
const bool kSegmentsCollide = kSegments != kRodNoSegments;

// Rows of the scratch memory. 0 to 2: the columns of `move_response`, with `constant_term` as the
// last row. 3 to 5: the columns of `turn_response`. 6 and 7: the vertex's displacement and the
// segment's rotation since the prediction. 8: the tangent and the strength of the drag across it
// (air_drag.glsl). 9 and 10, if contact forces are carried: its ContactConstraint. The last row, if
// segments collide with bodies: the push of bodies on the vertex, and 1 if it or its segment
// touches a body.
const uint kPushRow = kRodScratchRows + (kWarmStart ? kRodContactScratchRows : 0u);
const uint kScratchRows = kPushRow + (kSegmentsCollide ? 1u : 0u);

#include "simulation/constraints/segment.glsl"
#include "simulation/rod/contact.glsl"
#include "simulation/rod/joint.glsl"
#include "simulation/rod/strand.glsl"
#include "simulation/rod/symmetric.glsl"

const float kMostTurn = 1.0;  // rad in an iteration; a distant Newton step can overshoot
const float kPinMass = 100.0;  // of a pinned vertex, relative to the strand's: a stiff spring to
                               // its position

float pinMass() { return kPinMass * float(guides.vertices_per_strand - 1); }

ContactConstraint constraintAt(uint i) {
    vec4 facing = scratchAt(i, 9);
    return ContactConstraint(facing.xyz, facing.w, scratchAt(i, 10).xyz);
}

// Weights of generalised alpha (rod.h). kCarried: of the previous accelerations in a prediction,
// those that moved the velocities and the true ones. kSpeedsUp: of the previous and the current
// acceleration in a velocity. kForceShare: share of the substep squared for which the forces at its
// end act.
const vec2 kCarried = vec2(1.0 / 18.0, 4.0 / 27.0);
const vec2 kSpeedsUp = vec2(1.0 / 6.0, 5.0 / 6.0);
const vec2 kTaken = vec2(1.0 / 3.0, 2.0 / 3.0);  // of the previous and the current true
                                                 // acceleration in the one that moves velocities
const float kForceShare = 8.0 / 27.0;
const float kSmoothTurn = 1.0e-3;   // rad
const float kLeastResidual = 1.0e-4;  // smaller residuals do not affect accelerations

// Whether accelerations are kept, and whether the material damps. They are constants because
// lavapipe evaluates both sides of a branch, but a constant removes the code.
layout(constant_id = kRodAlphaConstant) const bool kAlpha = false;
layout(constant_id = kRodDampedConstant) const bool kDamped = false;

bool second_order;  // in this substep
bool is_smooth;       // the next substep may be second order
float viscosity;    // of joints, over their stiffness

uint accelerationIndex(uint i, uint row) {
    return rodIndex(i, row, kRodAccelerationRows, guides.strand_count, strand);
}

vec3 accelerationAt(uint i, uint row) {
    return loadVector(rod.accelerations, accelerationIndex(i, row)).xyz;
}

// The displacement in a substep by gravity and the substep's accelerations alone.
vec3 loadAt(uint i) {
    vec3 acceleration = guides.gravity;
    if (push.accelerations != kNoAddress) acceleration += Vectors(push.accelerations).at[root + i].xyz;
    return guides.step.sub * guides.step.sub / unit * acceleration;
}

void chooseOrder() {
    second_order = false;
    if (kAlpha && push.air == kNoAddress)
        second_order = accelerationAt(0, 0).x == 0.0;
    viscosity = second_order ? rod.damping : max(rod.damping - 1.0, 0.0);
    is_smooth = true;
}

// The predicted rotation of a segment with this angular velocity, including damping.
vec3 predictedTurn(uint i, vec3 angular_velocity) {
    if (!kAlpha || !second_order) return angular_velocity;
    return angular_velocity + kCarried.x * accelerationAt(i, kRodAngularAcceleration) +
           kCarried.y * accelerationAt(i, kRodTrueAngularAcceleration);
}

// Predicts velocities with the forces of the substep, and the resulting positions.
void predict() {
    State positions = State(from.positions);
    root_now = toWorld(root_frame, Vectors(guides.rest_positions).at[root].xyz);
    vec4 follicle = positions.at[root];
    vec3 root_moved = (root_now - follicle.xyz) / unit;
    State(guides.previous).at[root] = vec4(follicle.xyz, 0.0);
    State(guides.positions).at[root] = vec4(root_now, follicle.w);
    vec3 edges = vec3(0.0);    // from the root to here
    vec3 residuals = vec3(0.0);  // from the root to here
    vec3 moved = vec3(0.0);    // by rotating segments
    vec4 above = vec4(0.0);  // orientation of the segment above, before the substep
    if (kSets)
        above = multiply(
            root_frame_before.rotation,
            segmentRow(rod.segments, 0, kRodHalfRotation, guides.strand_count, strand));
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        RodMotion motion = motionAt(i);
        float len = restLength(i);
        vec3 load = loadAt(i);
        vec4 drag = vec4(0.0);
        if (push.air != kNoAddress) drag = dragAt(i, motion);
        motion.velocity *= guides.velocity_kept;
        vec3 free = motion.velocity;  // displacement of the vertex by itself
        if (kAlpha && second_order)
            free += kCarried.x * accelerationAt(i, kRodAcceleration) +
                    kCarried.y * accelerationAt(i, kRodTrueAcceleration) + kForceShare * load;
        else
            motion.velocity += load;
        if (push.air != kNoAddress) {
            vec3 air = guides.step.sub / unit * Vectors(push.air).at[root + i].xyz;
            motion.velocity = withDrag(motion.velocity, air, drag.xyz, drag.w);
            setScratch(i, 8, drag);
        }
        motion.angular_velocity *= guides.velocity_kept;
        if (!second_order) free = motion.velocity;
        if (kSets) {
            uint at = setIndex(i, guides.strand_count, strand);
            vec4 half_rotation =
                segmentRow(rod.segments, i, kRodHalfRotation, guides.strand_count, strand);
            vec4 set = relaxed(
                loadVector(rod.set, at), multiply(above, half_rotation),
                multiply(motion.orientation, conjugate(half_rotation)), rod.set_kept);
            storeVector(rod.set, at, set);
            above = motion.orientation;
        }
        vec3 turn = predictedTurn(i, motion.angular_velocity);
        moved += gainOf(len * axisOf(motion.orientation), turn);
        motion.orientation = turned(motion.orientation, turn);
        residuals += motion.residual;
        is_smooth = is_smooth && length(motion.residual) <= kLeastResidual;
        edges += len * axisOf(motion.orientation);
        vec3 displacement = root_moved - residuals + moved - free;
        if (isPinned(i)) {
            motion.velocity = vec3(0.0);
            displacement = (root_now - positions.at[root + i].xyz) / unit + edges;
        }
        if (kWarmStart) {
            ContactConstraint constraint = kNoConstraint;
            if (!isPinned(i) && motion.contact != vec3(0.0))
                constraint = constraintOf(
                    i, positions.at[root + i].xyz, motion.contact, motion.velocity);
            if (constraint.normal == vec3(0.0)) motion.contact = vec3(0.0);
            setScratch(i, 9, vec4(constraint.normal, constraint.state));
            setScratch(i, 10, vec4(constraint.offset, 0.0));
        }
        setMotion(i, motion);
        setScratch(i, 6, vec4(displacement, 0.0));
        setScratch(i, 7, vec4(0.0));
    }
}

// Rotation of a segment in the substep, as the sum of small rotations.
vec3 turnSoFar(uint i) {
    if (i > 0) return predictedTurn(i, motionAt(i).angular_velocity) + scratchAt(i, 7).xyz;
    vec4 turn = multiply(root_frame.rotation, conjugate(root_frame_before.rotation));
    return (turn.w < 0.0 ? -2.0 : 2.0) * turn.xyz;
}

// Eliminates segments from the tip up. The minimum energy of all below a vertex is x A x / 2 + x B
// t + t C t / 2 + a x + b t, where x is the further displacement of the vertex and t the further
// rotation of the segment that ends there. All are in the segment's own axes: under great tension,
// bending and twisting differ too much for 32 bits to hold their sum. `first`: nothing has moved
// since the prediction.
void eliminate(bool first) {
    mat3 A = mat3(0.0);
    mat3 B = mat3(0.0);
    mat3 C = mat3(0.0);
    vec3 a = vec3(0.0);
    vec3 b = vec3(0.0);
    vec3 force = vec3(0.0);  // force that the segment transmits to the vertex at its end
    vec4 orientation = orientationAt(guides.vertices_per_strand - 1);
    float mass_scale = second_order ? 1.0 / kForceShare : 1.0;  // because forces act for a shorter
                                                               // time
    for (uint i = guides.vertices_per_strand - 1; i > 0; --i) {
        RodSegment segment = loadSegment(rod.segments, i, guides.strand_count, strand);
        vec4 above = orientationAt(i - 1);
        mat3 from_space = transpose(matrixOf(orientation));
        vec3 displacement = from_space * scratchAt(i, 6).xyz;
        vec3 rotation = from_space * scratchAt(i, 7).xyz;
        float mass = isPinned(i) ? pinMass() : segment.mass;
        mass *= mass_scale;
        float turning_length = max(segment.rest_length, kLeastLength);
        float inertia = mass_scale * turning_length * turning_length * turning_length / 12.0;

        // Tension straightens: Tournier et al. 2015, Stable constrained dynamics.
        vec3 held = mass * displacement;
        A += mat3(mass);
        if (push.air != kNoAddress && !isPinned(i)) {
            vec4 drag = scratchAt(i, 8);
            vec3 tangent = from_space * drag.xyz;
            float added_mass = mass * drag.w;
            A += added_mass * (mat3(1.0) - outerProduct(tangent, tangent));
            held += added_mass * (displacement - dot(tangent, displacement) * tangent);
        }
        if (kWarmStart) {
            ContactConstraint constraint = constraintAt(i);
            if (constraint.normal != vec3(0.0)) {
                mat3 contact_stiffness = pinMass() * constraintProjection(constraint);
                vec3 off = scratchAt(i, 6).xyz + constraint.offset;
                vec3 contact = motionAt(i).contact;
                if (!first)  // before the first solve, the spring has not held the vertex
                    contact = carriedForce(
                        constraint, contact, off, pinMass() / segment.mass);
                A += from_space * contact_stiffness * transpose(from_space);
                held += from_space * (contact_stiffness * off - segment.mass * contact);
            }
        }
        force += held;
        float geometric_stiffness = segment.rest_length * max(-force.z, 0.0);
        a += held;
        C += mat3(inertia);
        C[0][0] += geometric_stiffness;
        C[1][1] += geometric_stiffness;
        b += inertia * rotation;

        // Moves the reference from the vertex at the segment's end to that at its start, which
        // moves by x + lever t.
        mat3 lever = -segment.rest_length * crossMatrix(vec3(0.0, 0.0, 1.0));
        mat3 raised = transpose(lever) * B;
        C = symmetric(C + transpose(lever) * A * lever + raised + transpose(raised));
        B += A * lever;
        b += transpose(lever) * a;

        vec4 joint_above = multiply(above, segment.half_rotation);
        vec4 joint_below = multiply(orientation, conjugate(segment.half_rotation));
        RodJoint joint = bendAndTwist(
            joint_above, joint_below, segment.bend_stiffness, segment.twist_stiffness,
            rod.ellipticity, i == 1);
        if (kSets) {
            vec4 set = loadVector(rod.set, setIndex(i, guides.strand_count, strand));
            RodJoint yielding = bendAndTwist(
                multiply(joint_above, set), multiply(joint_below, conjugate(set)),
                segment.bend_stiffness, segment.twist_stiffness, rod.ellipticity, i == 1);
            float share = rod.set_share * rod.set_mean;
            joint.torque = (1.0 - rod.set_share) * joint.torque + share * yielding.torque;
            joint.stiffness =
                (1.0 - rod.set_share) * joint.stiffness + share * yielding.stiffness;
        }
        vec3 torque = from_space * joint.torque;
        mat3 stiffness = symmetric(from_space * joint.stiffness * transpose(from_space));
        if (kDamped && viscosity > 0.0) {
            torque -= viscosity * (stiffness * (from_space * (turnSoFar(i) - turnSoFar(i - 1))));
            stiffness *= 1.0 + viscosity;
        }

        mat3 compliance = inverseOfSymmetric(C + stiffness);
        mat3 move_response = -compliance * transpose(B);
        mat3 turn_response = compliance * stiffness;
        vec3 constant_term = compliance * (torque - b);
        for (uint k = 0; k < 3; ++k) {
            setScratch(i, k, vec4(move_response[k], constant_term[k]));
            setScratch(i, 3 + k, vec4(turn_response[k], 0.0));
        }

        mat3 to_above = transpose(matrixOf(above)) * transpose(from_space);
        a = to_above * (a + B * constant_term);
        b = to_above * (stiffness * (compliance * b) + C * (compliance * torque));
        A = symmetric(to_above * (A + B * move_response) * transpose(to_above));
        B = to_above * (B * turn_response) * transpose(to_above);
        C = symmetric(to_above * (C * turn_response) * transpose(to_above));
        force = to_above * force;
        orientation = above;
    }
}

// Turns the segments from the root down and moves the vertices. Returns the greatest rotation.
float turnSegments() {
    float greatest = 0.0;
    vec3 turn = vec3(0.0);
    vec3 linear = vec3(0.0);  // displacement of the vertex above for small rotations
    vec3 moved = vec3(0.0);   // its actual displacement
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        mat3 move_response;
        mat3 turn_response;
        vec3 constant_term;
        for (uint k = 0; k < 3; ++k) {
            vec4 row = scratchAt(i, k);
            move_response[k] = row.xyz;
            constant_term[k] = row.w;
            turn_response[k] = scratchAt(i, 3 + k).xyz;
        }
        vec4 orientation = orientationAt(i);
        mat3 to_space = matrixOf(orientation);
        vec3 edge = restLength(i) * to_space[2];
        vec3 own = move_response * (linear * to_space) + turn_response * (turn * to_space) +
                   constant_term;
        greatest = max(greatest, length(own));
        turn = to_space * own * (kMostTurn / max(length(own), kMostTurn));
        linear += cross(turn, edge);
        moved += gainOf(edge, turn);
        storeVector(rod.motion, orientationIndex(i), turned(orientation, turn));
        setScratch(i, 6, vec4(scratchAt(i, 6).xyz + moved, 0.0));
        setScratch(i, 7, vec4(scratchAt(i, 7).xyz + turn, 0.0));
    }
    return greatest;
}

// The velocity change by accelerations, which are kept in two rows from `row` on. `now` is the
// acceleration from forces and inertia.
vec3 updateAcceleration(uint i, uint row, vec3 now) {
    if (!kAlpha) return now;
    vec3 taken = now;
    vec3 change = now;
    if (second_order) {
        taken = kTaken.x * accelerationAt(i, row + 1) + kTaken.y * now;
        change = kSpeedsUp.x * accelerationAt(i, row) + kSpeedsUp.y * taken;
    }
    storeVector(rod.accelerations, accelerationIndex(i, row), vec4(taken, 0.0));
    storeVector(rod.accelerations, accelerationIndex(i, row + 1), vec4(now, 0.0));
    return change;
}

// Pushes of bodies on vertices and then, twice, on the segments between them. Each push acts on the
// masses of its own two ends. The next solve passes it on to the rest of the strand.
const uint kSweeps = 2u;

void pushSegments() {
    for (uint sweep = 0; sweep < kSweeps; ++sweep) {
        MovingSegment segment;
        segment.b = root_now;
        segment.b_before = State(guides.previous).at[root].xyz;
        vec3 free_above = root_now;
        vec3 edges = vec3(0.0);
        float touched_above = 0.0;
        for (uint i = 1; i < guides.vertices_per_strand; ++i) {
            edges += restLength(i) * axisOf(orientationAt(i));
            vec3 before = State(from.positions).at[root + i].xyz;
            vec3 free = isPinned(i) ? before : root_now + unit * edges;
            float touched = 0.0;
            vec3 held = free;
            if (sweep > 0u) {
                vec4 pushed = scratchAt(i, kPushRow);
                held += unit * pushed.xyz;
                touched = pushed.w;
            } else if (!isPinned(i)) {
                vec3 pushed;
                VertexContact met;
                held = collideVertex(i, free, before, touched, pushed, met);
            }
            float w_a = i > 1 && !isPinned(i - 1) ? 1.0 : 0.0;
            float w_b = isPinned(i) ? 0.0 : 1.0;
            segment =
                movingSegment(guides, root + i, w_a, segment.b, held, segment.b_before, before);
            EnteredPlane entered;
            float clearance;
            SegmentContact contact = contactOf(
                segment, guides.bodies, 0u, bodyCount(guides.bodies), push.frame,
                push.frame_before, true, kSegments == kRodSegmentsAtRest, entered, clearance);
            float s = contact.at;
            float r = 1.0 - s;
            float compliance = r * r * w_a + s * s * w_b;
            if (contact.gap < 0.0 && compliance > 0.0) {
                vec3 slid = movedPast(segment, contact, push.frame, push.frame_before);
                float share;
                vec3 kept = slideBack(
                    slid - contact.gap * contact.normal, vec3(0.0), contact.normal, -contact.gap,
                    guides.bodies.friction, share);
                vec3 move = (kept - slid) / compliance;
                segment.a += r * w_a * move;
                segment.b += s * w_b * move;
                touched = 1.0;
            }
            if (i > 1)
                setScratch(
                    i - 1, kPushRow, vec4((segment.a - free_above) / unit, touched_above));
            free_above = free;
            touched_above = touched;
        }
        setScratch(
            guides.vertices_per_strand - 1, kPushRow,
            vec4((segment.b - free_above) / unit, touched_above));
    }
}

// Updates velocities and positions, and collides. Pushes of bodies turn segments and leave
// residuals.
void finish() {
    State positions = State(guides.positions);
    vec3 edges = vec3(0.0);  // from the root to here, without collisions
    vec3 pushed_above = vec3(0.0);
    float contact = 0.0;  // 1 from the first vertex that touches a body
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        RodMotion motion = motionAt(i);
        float len = restLength(i);
        vec3 axis = axisOf(motion.orientation);
        vec4 point = State(from.positions).at[root + i];
        vec3 before = point.xyz;
        edges += len * axis;
        float share = second_order ? 1.0 / kForceShare : 1.0;
        motion.angular_velocity +=
            updateAcceleration(i, kRodAngularAcceleration, share * scratchAt(i, 7).xyz);
        vec3 pushed = vec3(0.0);
        if (!isPinned(i)) {
            vec3 free = root_now + unit * edges;
            vec3 held;
            VertexContact met = VertexContact(vec4(0.0), kTouchesNone);
            if (kSegmentsCollide) {
                vec4 push_of_bodies = scratchAt(i, kPushRow);
                pushed = push_of_bodies.xyz;
                contact = max(contact, push_of_bodies.w);
                held = free + unit * pushed;
            } else {
                held = collideVertex(i, free, before, contact, pushed, met);
            }
            // Implicit Euler's velocity already includes the load.
            vec3 load = kAlpha ? loadAt(i) : vec3(0.0);
            vec3 change =
                updateAcceleration(i, kRodAcceleration, share * scratchAt(i, 6).xyz + load);
            motion.velocity += (second_order ? change : change - load) + pushed;
            is_smooth = is_smooth && pushed == vec3(0.0);
            if (kWarmStart) {
                ContactConstraint constraint = constraintAt(i);
                if (constraint.normal == vec3(0.0)) {
                    motion.contact = pushed;
                } else {
                    float mass =
                        segmentRow(rod.segments, i, kRodStiffness, guides.strand_count, strand).y;
                    vec3 off = scratchAt(i, 6).xyz + constraint.offset;
                    motion.contact = alongSurface(
                        clampToFrictionCone(
                            constraint, motion.contact, off, pinMass() / mass,
                            guides.bodies.friction),
                        constraint.normal, met.plane.xyz);
                }
            }
            point.xyz = held;
        } else if (kAlpha) {
            storeVector(rod.accelerations, accelerationIndex(i, kRodAcceleration), vec4(0.0));
            storeVector(rod.accelerations, accelerationIndex(i, kRodTrueAcceleration), vec4(0.0));
        }
        positions.at[root + i] = point;
        motion.residual = vec3(0.0);
        if (pushed != pushed_above) {
            vec3 edge = len * axis + pushed - pushed_above;
            if (unit * min(len, length(edge)) >= kShortestSegment) {
                vec4 turn = rotationBetween(axis, normalize(edge));
                motion.orientation = normalize(multiply(turn, motion.orientation));
                motion.angular_velocity += 2.0 * turn.xyz;
            }
            motion.residual = edge - len * axisOf(motion.orientation);
        }
        setMotion(i, motion);
        State(guides.previous).at[root + i] = vec4(before, contact);
        pushed_above = pushed;
    }
}

void main() {
    if (!takeStrand()) return;  // no barrier follows
    chooseOrder();
    predict();
    float last_turn = 0.0;
    for (uint i = 0; i < rod.iterations; ++i) {
        eliminate(i == 0);
        last_turn = turnSegments();
    }
    if (kSegmentsCollide) pushSegments();
    finish();
    if (kAlpha) {
        bool smooth_strand = is_smooth && last_turn <= kSmoothTurn;
        storeVector(rod.accelerations, accelerationIndex(0, 0), vec4(smooth_strand ? 0.0 : 1.0));
    }
}

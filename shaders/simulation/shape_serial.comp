#version 460
// A substep of the `shape` solver like shape.comp, for comparison. There is one invocation per
// strand, like the one busy lane per strand of the thesis's local constraint, but strands are
// packed. It walks along the strand with its state in the device's buffers. With HAIRBENCH_ENERGY
// the local constraint has an energy.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "common/rigid_frame.glsl"
#include "shared/options.h"
#include "simulation/air_drag.glsl"
#ifdef HAIRBENCH_ENERGY
#include "simulation/constraints/bend.glsl"
#endif
#include "simulation/constraints/global.glsl"
#include "simulation/constraints/length.glsl"
#include "simulation/constraints/local.glsl"
#include "simulation/constraints/transport.glsl"
#include "simulation/contacts.glsl"
#include "simulation/guides.glsl"
#include "simulation/root_frame.glsl"

layout(local_size_x_id = kShapeGroupSizeConstant) in;
layout(constant_id = kShapeVerticesPerStrandConstant) const uint kVerticesPerStrand = 8;
layout(constant_id = kShapeCollidesConstant) const bool kCollides = true;
layout(constant_id = kShapeTridiagonalConstant) const bool kTridiagonal = true;

layout(push_constant, scalar) uniform Push { SubstepPush push; };

layout(buffer_reference, scalar) readonly buffer ShapeReference { ShapeParameters parameters; };

void main() {
    GuideParameters guides = GuideReference(push.guides).parameters;
    GuideParameters from = GuideReference(push.from).parameters;
    ShapeParameters params = ShapeReference(push.solver).parameters;
    uint strand = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (strand >= guides.strand_count) return;  // no barrier follows
    uint root = strand * kVerticesPerStrand;
    State positions = State(guides.positions);
    State previous = State(guides.previous);
    Vectors rest_edges = Vectors(params.rest_edges);
    RigidFrame root_frame = rootFrame(push.frame, push.roots, strand);
    RigidFrame root_frame_before = rootFrame(push.frame_before, push.roots_before, strand);

    vec3 above = vec3(0.0);  // at the start of the substep
    float inverse_masses[kVerticesPerStrand];
#ifdef HAIRBENCH_ENERGY
    BendLoad loads[kVerticesPerStrand];
    vec3 root_moved = vec3(0.0);
    bool held = false;  // true if any vertex except the root is held
#endif
    for (uint v = 0; v < kVerticesPerStrand; ++v) {
        vec4 point = State(from.positions).at[root + v];
        float inverse_mass = point.w;
        vec3 before = point.xyz;
        vec3 rest = toWorld(root_frame, Vectors(params.rest_positions).at[root + v].xyz);
#ifdef HAIRBENCH_ENERGY
        loads[v] = kNoLoad;
        if (v == 0) root_moved = rest - before;
        held = held || (v > 0 && point.w == 0.0);
#endif
        if (v == 0) {
            point.xyz = rest;
        } else if (point.w > 0.0) {
            vec3 acceleration = guides.gravity;
            if (push.accelerations != kNoAddress)
                acceleration += Vectors(push.accelerations).at[root + v].xyz;
            vec3 previous_point = State(from.previous).at[root + v].xyz;
            point.xyz = integrate(
                before, previous_point, acceleration, guides.velocity_kept,
                guides.step.sub * guides.step.sub);
#ifdef HAIRBENCH_ENERGY
            loads[v] = freeLoad(
                point.xyz - before, pullPerMass(params.global_stiffness) * (rest - before));
#endif
            float stiffness = params.global_stiffness;
            if (push.air != kNoAddress) {
                vec3 below = vec3(0.0);
                if (v + 1 < kVerticesPerStrand)
                    below = directionOf(State(from.positions).at[root + v + 1].xyz - before);
                vec3 tangent = tangentBetween(directionOf(before - above), below);
                vec3 air = Vectors(push.air).at[root + v].xyz;
                vec3 velocity = (before - previous_point) / guides.step.sub;
                float drag = dragFactor(push.drag, tangent, air - velocity, guides.step.sub);
#ifdef HAIRBENCH_ENERGY
                addAir(loads[v], tangent, drag, air, velocity, guides.step.sub);
#endif
                point.xyz =
                    before + withDrag(point.xyz - before, guides.step.sub * air, tangent, drag);
                inverse_mass /= 1.0 + drag;
                stiffness = pullOn(stiffness, drag);
            }
            point.xyz = pullToRest(point.xyz, rest, stiffness);
        }
#ifdef HAIRBENCH_ENERGY
        point.xyz = before;
#endif
        positions.at[root + v] = point;
        previous.at[root + v] = vec4(before, 0.0);
        inverse_masses[v] = inverse_mass;
        above = before;
    }

    float stiffness = Factors(params.local_stiffness).at[strand];
    vec3 goal_edges[kVerticesPerStrand];
    bool lengths = true;  // true if lengths still need solving
#ifdef HAIRBENCH_ENERGY
    // Mesa would unroll these loops up to 32 vertices, and lavapipe would compile 20 times as long.
    lengths = held;
    RigidFrame head = root_frame_before;
    Transport start = Transport(firstTangent(head, rest_edges.at[root + 1]), head.rotation);
    vec3 axes[kVerticesPerStrand];
    // Kept in an array, because Mesa 22.3.6's lavapipe reads x instead of w if w alone is loaded
    // again (2 vertices).
    float rest_lengths[kVerticesPerStrand];
    BendJoint joints[kVerticesPerStrand];
    Transport frame = start;
    [[dont_unroll]] for (uint v = 1; v < kVerticesPerStrand; ++v) {
        vec4 rest_edge = rest_edges.at[root + v];
        rest_lengths[v] = rest_edge.w;
        goal_edges[v] = rotate(frame.rotation, rest_edge.xyz);
        vec3 tangent = frame.tangent;
        vec3 edge = positions.at[root + v].xyz - positions.at[root + v - 1].xyz;
        frame = transport(frame, edge, rest_edge.w);
        axes[v] = jointAxis(tangent, frame.tangent);
    }
    float free_mass = 1.0 + pullPerMass(params.global_stiffness);
    BendBelow below = noBody();
    [[dont_unroll]] for (uint v = kVerticesPerStrand - 1; v > 0; --v) {
        float mass = inverse_masses[v] > 0.0 ? free_mass : kHeldMass * kVerticesPerStrand;
        addVertex(below, loads[v], mass, root_moved);
        vec3 edge = positions.at[root + v].xyz - positions.at[root + v - 1].xyz;
        if (hasDirection(edge, rest_lengths[v]))
            joints[v] = addJoint(
                below, edge, goal_edges[v], axes[v], stiffness * vec2(1.0, params.local_damping));
    }
    vec4 head_turn = multiply(root_frame.rotation, conjugate(root_frame_before.rotation));
    vec3 upper = positions.at[root].xyz;
    BendAbove turning =
        BendAbove(upper + root_moved, root_moved, (head_turn.w < 0.0 ? -2.0 : 2.0) * head_turn.xyz);
    positions.at[root].xyz = turning.place;
    [[dont_unroll]] for (uint v = 1; v < kVerticesPerStrand; ++v) {
        vec3 lower = positions.at[root + v].xyz;
        float rest_length = rest_lengths[v];
        if (hasDirection(lower - upper, rest_length))
            turnSegment(turning, joints[v], lower - upper, axes[v], rest_length);
        else if (rest_length >= kShortestSegment)
            turning.place.y += rest_length;
        if (inverse_masses[v] > 0.0) positions.at[root + v].xyz = turning.place;
        upper = lower;
    }
#else
    Transport start =
        Transport(firstTangent(root_frame, rest_edges.at[root + 1]), root_frame.rotation);
    for (uint iteration = 0; iteration < params.local_iterations; ++iteration) {
        Transport frame = start;
        vec3 upper = positions.at[root].xyz;
        for (uint v = 1; v < kVerticesPerStrand; ++v) {
            vec4 rest_edge = rest_edges.at[root + v];
            vec3 lower = positions.at[root + v].xyz;
            goal_edges[v] = rotate(frame.rotation, rest_edge.xyz);
            frame = transport(frame, lower - upper, rest_edge.w);
            upper = lower;
        }
        for (uint first = 1; first <= 2; ++first) {
            for (uint v = first; v < kVerticesPerStrand; v += 2) {
                vec4 a = vec4(positions.at[root + v - 1].xyz, inverse_masses[v - 1]);
                vec4 b = vec4(positions.at[root + v].xyz, inverse_masses[v]);
                pullToShape(a, b, goal_edges[v], stiffness);
                positions.at[root + v - 1].xyz = a.xyz;
                positions.at[root + v].xyz = b.xyz;
            }
        }
    }
#endif
    for (uint iteration = 0; !kTridiagonal && lengths && iteration < params.length_iterations;
         ++iteration) {
        for (uint first = 1; first <= 2; ++first) {
            for (uint v = first; v < kVerticesPerStrand; v += 2) {
                vec4 a = vec4(positions.at[root + v - 1].xyz, inverse_masses[v - 1]);
                vec4 b = vec4(positions.at[root + v].xyz, inverse_masses[v]);
                projectLength(a, b, rest_edges.at[root + v].w);
                positions.at[root + v - 1].xyz = a.xyz;
                positions.at[root + v].xyz = b.xyz;
            }
        }
    }

    // As in shape.comp.
    LengthRow rows[kVerticesPerStrand];
    for (uint v = 0; v < kVerticesPerStrand; ++v)
        rows[v] = lengthRow(positions.at[root + v], vec4(0.0), 0.0);
    bool collided = false;
    for (uint passes = params.length_iterations;; passes = kContactPasses) {
        bool solves = kTridiagonal && passes > 0 && (lengths || collided);
        for (uint pass = 0; solves && pass <= passes; ++pass) {
            bool last = pass == passes;
            vec4 a = vec4(positions.at[root].xyz, inverse_masses[0]);
            LengthsAbove above = aboveAll(a.xyz);
            for (uint v = 1; v < kVerticesPerStrand; ++v) {
                vec4 b = vec4(positions.at[root + v].xyz, inverse_masses[v]);
                sweepDown(above, rows[v], a, b, rest_edges.at[root + v].w, collided);
                if (last) positions.at[root + v].xyz = above.place;
                a = b;
            }
            if (last) break;
            LengthsBelow below = LengthsBelow(vec3(0.0), 0.0, 0.0);
            for (uint v = kVerticesPerStrand - 1; v > 0; --v) {
                a = vec4(positions.at[root + v - 1].xyz, inverse_masses[v - 1]);
                vec4 b = vec4(positions.at[root + v].xyz, inverse_masses[v]);
                sweepUp(below, rows[v], a, b, rest_edges.at[root + v].w);
            }
        }
        if (!kCollides || collided) break;
        collided = true;
        float contact = 0.0;
        for (uint v = 0; v < kVerticesPerStrand; ++v) {
            VertexContact met = collide(guides, push.frame, push.frame_before, root + v, contact);
            rows[v] = lengthRow(positions.at[root + v], met.plane, heldAcross(met.held));
            inverse_masses[v] *= complianceAlong(met.held);
        }
        if (!kTridiagonal || passes == 0 || contact == 0.0) break;
    }
}

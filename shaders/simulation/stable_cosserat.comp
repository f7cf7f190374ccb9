#version 460
// One substep of the `stable_cosserat` solver, one invocation per strand: Hsu, Wang, Wu and Yuksel
// 2025, Stable Cosserat rods. It alternates positions and orientations, and minimises over one
// with the other fixed. hair/reference/compared_rods.h has the energies, both methods and their
// differences. See rod_structs.h for the units.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"
#include "shared/rod_structs.h"

// Rows of the scratch memory. kPredicted: a vertex's displacement without the strand's forces, and
// w its weight against all below it. kCentre: the displacement with the least energy of all that
// hangs on the vertex, and w its weight against the segment above; the descent does not use it or
// the weights. kMoved: the vertex's displacement. kDrag: the tangent and the strength of the drag
// across it.
const uint kScratchRows = kStableCosseratScratchRows;
const uint kPredicted = 0u;
const uint kCentre = 1u;
const uint kMoved = 2u;
const uint kDrag = 3u;

#include "simulation/rod/edges.glsl"
#include "simulation/rod/orientation.glsl"

layout(constant_id = kCosseratDescentConstant) const bool kDescends = false;

const float kLeastJoint = 1.0e-12;  // limp compared with any mass; its square is a float

RodSegment segmentAt(uint i) {
    RodSegment segment = loadSegment(rod.segments, i, guides.strand_count, strand);
    segment.bend_stiffness = max(segment.bend_stiffness, kLeastJoint);
    segment.twist_stiffness = max(segment.twist_stiffness, kLeastJoint);
    return segment;
}

// Computes displacements by everything except the forces of the strand.
void predict() {
    takeRoot();
    vec3 edges = vec3(0.0);  // from the root to here
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        vec4 drag;
        vec3 moved = predictedMove(i, motionAt(i), edges, drag);
        setScratch(i, kPredicted, vec4(moved, 0.0));
        setScratch(i, kMoved, vec4(moved, 0.0));
        setScratch(i, kDrag, drag);
    }
}

float springOf(RodSegment segment) {
    return min(stretching / max(segment.rest_length, kLeastLength), kMostSpring);
}

// Computes the weights of solveUp() and sweepDown(), as for springs and masses in series from the
// tip up. They are the same in every iteration.
void computeWeights() {
    float below = 0.0;  // stiffness of the spring between a vertex and all that hangs on it
    for (uint i = guides.vertices_per_strand - 1; i > 0; --i) {
        RodSegment segment = segmentAt(i);
        float spring = springOf(segment);
        vec2 weights = vec2(0.0, 1.0);
        if (!isPinned(i)) {
            float mass = segment.mass * (1.0 + scratchAt(i, kDrag).w) + below;
            weights = vec2(below, mass) / vec2(mass, spring + mass);
        }
        setScratch(i, kPredicted, vec4(scratchAt(i, kPredicted).xyz, weights.x));
        setScratch(i, kCentre, vec4(0.0, 0.0, 0.0, weights.y));
        below = spring * weights.y;
    }
}

// The displacement of a vertex on its own. Drag adds to the mass only across the hair, but the
// solver uses an equal mass in all directions. The last iteration's motion corrects the excess
// along the hair, so that the iteration still lowers the energy.
vec3 goalAt(uint i, vec3 predicted) {
    if (push.air == kNoAddress) return predicted;
    vec4 drag = scratchAt(i, kDrag);
    vec3 ahead = scratchAt(i, kMoved).xyz - predicted;
    return predicted + drag.w / (1.0 + drag.w) * dot(drag.xyz, ahead) * drag.xyz;
}

// First half of the positions for fixed orientations: from the tip up, finds for each vertex the
// position with the least energy of all that hangs on it.
void solveUp() {
    vec3 below = vec3(0.0);
    for (uint i = guides.vertices_per_strand - 1; i > 0; --i) {
        vec4 predicted = scratchAt(i, kPredicted);
        vec3 goal = goalAt(i, predicted.xyz);
        vec3 centre = goal + predicted.w * (below - goal);
        setScratch(i, kCentre, vec4(centre, scratchAt(i, kCentre).w));
        below = centre - (restLength(i) * axisOf(orientationAt(i)) - edgeAt(i));
    }
}

// Second half, from the root down: sets the positions, unless they are still the prediction. With
// every segment's edge it also sets the orientation, with fixed neighbours.
void sweepDown(bool predicted) {
    vec3 moved = root_moved;
    vec4 above = orientationAt(0);
    vec4 orientation = orientationAt(1);
    RodSegment segment = segmentAt(1);
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        vec3 edge = edgeAt(i);
        vec3 here = scratchAt(i, kMoved).xyz;
        if (!predicted) {
            vec4 centre = scratchAt(i, kCentre);
            vec3 carried = moved + (segment.rest_length * axisOf(orientation) - edge);
            here = carried + centre.w * (centre.xyz - carried);
            setScratch(i, kMoved, vec4(here, 0.0));
        }
        edge += here - moved;
        moved = here;

        vec4 pull = pullFromAbove(
            above, orientation, segment.half_rotation, segment.bend_stiffness,
            segment.twist_stiffness);
        vec4 below = orientation;
        RodSegment next = segment;
        if (i + 1 < guides.vertices_per_strand) {
            below = orientationAt(i + 1);
            next = segmentAt(i + 1);
            pull += pullFromBelow(
                orientation, below, next.half_rotation, next.bend_stiffness,
                next.twist_stiffness);
        }
        if (dot(pull, pull) > 0.0)
            orientation = balancedOrientation(pull, stretching * edge, kMultiplierSteps);
        storeVector(rod.motion, orientationIndex(i), orientation);
        above = orientation;
        orientation = below;
        segment = next;
    }
}

// ---- The paper's descent ------------------------------------------------------------------------

// Starts the descent where each vertex would be if the last substep's acceleration went on, between
// no outer acceleration and all of it. Keeps the velocity for the next substep in the place of
// the angular velocity, which these rods do not have. Holds the first segment in its follicle.
void guess() {
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        RodMotion motion = motionAt(i);
        vec3 drift = guides.velocity_kept * motion.velocity;
        vec3 outer = scratchAt(i, kPredicted).xyz - drift;
        float size2 = dot(outer, outer);
        if (size2 > 0.0 && !isPinned(i)) {
            float share = dot(drift - motion.angular_velocity, outer) / size2;
            setScratch(i, kMoved, vec4(drift + clamp(share, 0.0, 1.0) * outer, 0.0));
        }
        motion.angular_velocity = drift;
        if (i == 1) motion.orientation = orientationAt(0);
        setMotion(i, motion);
    }
}

// Moves each vertex, from the root down, to the least energy with everything else fixed.
void descend() {
    vec3 above = root_moved;
    RodSegment segment = segmentAt(1);
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        bool has_next = i + 1 < guides.vertices_per_strand;
        RodSegment next = segment;
        if (has_next) next = segmentAt(i + 1);
        vec3 here = scratchAt(i, kMoved).xyz;
        if (!isPinned(i)) {
            float mass = segment.mass * (1.0 + scratchAt(i, kDrag).w);
            float spring = springOf(segment);
            vec3 edge = segment.rest_length * axisOf(orientationAt(i)) - edgeAt(i);
            // Sums of differences from here, which rounding hurts less than sums of places.
            vec3 force = mass * (goalAt(i, scratchAt(i, kPredicted).xyz) - here) +
                         spring * (above + edge - here);
            float stiffness = mass + spring;
            if (has_next) {
                float spring_below = springOf(next);
                vec3 edge_below =
                    next.rest_length * axisOf(orientationAt(i + 1)) - edgeAt(i + 1);
                force += spring_below * (scratchAt(i + 1, kMoved).xyz - edge_below - here);
                stiffness += spring_below;
            }
            here += force / stiffness;
            setScratch(i, kMoved, vec4(here, 0.0));
        }
        above = here;
        segment = next;
    }
}

// Turns each segment except the first, from the root down, by the paper's multiplier, which is
// not refined.
void turnSegments() {
    for (uint i = 2; i < guides.vertices_per_strand; ++i) {
        RodSegment segment = segmentAt(i);
        vec4 orientation = orientationAt(i);
        vec4 pull = pullFromAbove(
            orientationAt(i - 1), orientation, segment.half_rotation, segment.bend_stiffness,
            segment.twist_stiffness);
        if (i + 1 < guides.vertices_per_strand) {
            RodSegment next = segmentAt(i + 1);
            pull += pullFromBelow(
                orientation, orientationAt(i + 1), next.half_rotation, next.bend_stiffness,
                next.twist_stiffness);
        }
        if (dot(pull, pull) == 0.0) continue;
        vec3 edge = edgeAt(i) + (scratchAt(i, kMoved).xyz - scratchAt(i - 1, kMoved).xyz);
        storeVector(
            rod.motion, orientationIndex(i), balancedOrientation(pull, stretching * edge, 0u));
    }
}

void main() {
    if (!takeStrand()) return;  // no barrier follows
    predict();
    if (kDescends) {
        guess();
        for (uint i = 0; i < rod.iterations; ++i) {
            descend();
            turnSegments();
        }
        finish();
        return;
    }
    computeWeights();
    sweepDown(true);
    for (uint i = 0; i < rod.iterations; ++i) {
        solveUp();
        sweepDown(false);
    }
    finish();
}

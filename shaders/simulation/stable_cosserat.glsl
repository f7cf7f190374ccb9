// One substep of the `stable_cosserat` solver, one invocation per strand: Hsu, Wang, Wu and Yuksel
// 2025, Stable Cosserat rods. Positions and orientations by turns, each the minimum with the other
// held; hair/reference/stable_cosserat.h has the energies and what of this is the paper's. See
// rod_structs.h for the units. Before it: common/vectors.glsl or common/packed_vectors.glsl.
#include "shared/rod_structs.h"

// Rows of the scratch memory: how a vertex moves in the substep without what holds the strand
// together, and its weight against that of all below it; where all that hangs on the vertex has its
// least energy, and its weight against that of the segment above; how the vertex moves; the tangent
// that air brakes it across, and by how much.
const uint kScratchRows = kStableCosseratScratchRows;
const uint kPredicted = 0u;
const uint kCentre = 1u;
const uint kMoved = 2u;
const uint kBrake = 3u;

#include "simulation/constraints/bodies.glsl"
#include "simulation/rod/orientation.glsl"
#include "simulation/rod/strand.glsl"

const float kMostSpring = 1.0e15;    // rigid beside any mass; its square is a float
const float kLeastJoint = 1.0e-12;   // limp beside any mass; its square is a float

vec3 root_moved;
float stretching;  // stiffness against stretch and shear

uint edgeIndex(uint i) { return motionIndex(i, kRodMisfit, guides.strand_count, strand); }

// A segment's edge at the start of the substep.
vec3 edgeAt(uint i) { return loadVector(rod.motion, edgeIndex(i)).xyz; }

RodSegment segmentAt(uint i) {
    RodSegment segment = loadSegment(rod.segments, i, guides.strand_count, strand);
    segment.bend_stiffness = max(segment.bend_stiffness, kLeastJoint);
    segment.twist_stiffness = max(segment.twist_stiffness, kLeastJoint);
    return segment;
}

// Velocities with the forces of the substep, which are displacements as well: time is counted in
// substeps. Until finish() misfits are whole edges.
void predict() {
    State positions = State(from.positions);
    root_now = toWorld(push.frame, Vectors(guides.rest_positions).at[root].xyz);
    vec4 follicle = positions.at[root];
    root_moved = (root_now - follicle.xyz) / unit;
    State(guides.previous).at[root] = vec4(follicle.xyz, 0.0);
    State(guides.positions).at[root] = vec4(root_now, follicle.w);
    float scale = guides.step.sub * guides.step.sub / unit;
    vec3 edges = vec3(0.0);  // from the root to here
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        RodMotion motion = motionAt(i);
        vec3 acceleration = guides.gravity;
        if (push.accelerations != kNoAddress) acceleration += Vectors(push.accelerations).at[root + i].xyz;
        vec3 moved = guides.velocity_kept * motion.velocity + scale * acceleration;
        vec4 brake = vec4(0.0);
        if (push.air != kNoAddress) {
            brake = brakeAt(i, motion);
            vec3 air = guides.step.sub / unit * Vectors(push.air).at[root + i].xyz;
            moved = braked(moved, air, brake.xyz, brake.w);
        }
        vec3 edge = restLength(i) * axisOf(motion.orientation) + motion.misfit;
        edges += edge;
        if (isPinned(i)) {
            moved = (positions.at[root + i].xyz - follicle.xyz) / unit - edges;
            brake = vec4(0.0);
        }
        storeVector(rod.motion, edgeIndex(i), vec4(edge, 0.0));
        setScratch(i, kPredicted, vec4(moved, 0.0));
        setScratch(i, kMoved, vec4(moved, 0.0));
        setScratch(i, kBrake, brake);
    }
}

// The weights of solve(), which are the same in every iteration: of springs and masses in series,
// from the tip up.
void weigh() {
    float below = 0.0;  // of the spring between a vertex and all that hangs on it
    for (uint i = guides.vertices_per_strand - 1; i > 0; --i) {
        RodSegment segment = segmentAt(i);
        float spring = min(stretching / max(segment.rest_length, kLeastLength), kMostSpring);
        vec2 weights = vec2(0.0, 1.0);
        if (!isPinned(i)) {
            float mass = segment.mass * (1.0 + scratchAt(i, kBrake).w) + below;
            weights = vec2(below, mass) / vec2(mass, spring + mass);
        }
        setScratch(i, kPredicted, vec4(scratchAt(i, kPredicted).xyz, weights.x));
        setScratch(i, kCentre, vec4(0.0, 0.0, 0.0, weights.y));
        below = spring * weights.y;
    }
}

// Where a vertex would go by itself. Air makes it heavier across the hair alone: what an equal mass
// along it would hold back is put right by the last iteration's motion, so that the iteration
// still lowers the energy.
vec3 goalAt(uint i, vec3 predicted) {
    if (push.air == kNoAddress) return predicted;
    vec4 brake = scratchAt(i, kBrake);
    vec3 ahead = scratchAt(i, kMoved).xyz - predicted;
    return predicted + brake.w / (1.0 + brake.w) * dot(brake.xyz, ahead) * brake.xyz;
}

// The positions for these orientations, first half: from the tip up, the place of a vertex at which
// all that hangs on it has its least energy.
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

// From the root down: the positions, unless they are still the prediction, and with every segment's
// edge its orientation, its neighbours held.
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
        if (dot(pull, pull) > 0.0) orientation = balancedOrientation(pull, stretching * edge);
        storeVector(rod.motion, orientationIndex(i), orientation);
        above = orientation;
        orientation = below;
        segment = next;
    }
}

// Velocities and positions, and collisions, which leave misfits.
void finish() {
    State positions = State(guides.positions);
    vec3 moved_above = root_moved;
    vec3 pushed_above = vec3(0.0);
    vec3 edges = vec3(0.0);  // from the root to here, without collisions
    float contact = 0.0;     // 1 from the first vertex that touches a body
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        RodMotion motion = motionAt(i);
        vec3 moved = scratchAt(i, kMoved).xyz;
        vec3 edge = motion.misfit + (moved - moved_above);
        edges += edge;
        vec4 point = State(from.positions).at[root + i];
        vec3 before = point.xyz;
        vec3 pushed = vec3(0.0);
        motion.velocity = vec3(0.0);
        if (!isPinned(i)) {
            vec3 free = root_now + unit * edges;
            Met met;
            vec3 held = pushOutOfBodies(
                free, before, guides.bodies, push.frame, push.frame_before, met);
            if (met.held != kTouchesNone) {
                contact = 1.0;
                pushed = (held - free) / unit;
            }
            motion.velocity = moved + pushed;
            point.xyz = held;
        }
        positions.at[root + i] = point;
        motion.angular_velocity = vec3(0.0);
        motion.misfit = edge + (pushed - pushed_above) -
                        restLength(i) * axisOf(motion.orientation);
        setMotion(i, motion);
        State(guides.previous).at[root + i] = vec4(before, contact);
        moved_above = moved;
        pushed_above = pushed;
    }
}

void main() {
    if (!takeStrand()) return;  // no barrier follows
    stretching = min(rod.stretching / (unit * unit), kMostSpring);
    predict();
    weigh();
    sweepDown(true);
    for (uint i = 0; i < rod.iterations; ++i) {
        solveUp();
        sweepDown(false);
    }
    finish();
}

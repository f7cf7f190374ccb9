#version 460
// One substep of the `augmented_mass_spring` solver, one invocation per strand: Amador Herrera et
// al. 2024, Augmented mass-spring model for real-time dense hair simulation (arXiv 2412.17144). It
// is implicit Euler with Newton steps. Each step solves the strand's block heptadiagonal system
// directly. hair/reference/compared_rods.h describes the springs and the differences from
// the paper. See rod_structs.h for the units.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"
#include "shared/rod_structs.h"

// Rows of the scratch memory. kPredicted: the vertex's displacement without springs. kMoved: its
// displacement. kDrag: the tangent and the strength of the drag across it. kGhostEdge: its
// segment's rest edge, turned with the head. From kFactors on: the elimination of a Newton step
// from the tip up, as columns of three matrices. They are the vertex's response to the
// displacements of the first, second and third vertex above it. The last row of the first matrix is
// the vertex's displacement when those do not move.
const uint kScratchRows = kMassSpringScratchRows;
const uint kPredicted = 0u;
const uint kMoved = 1u;
const uint kDrag = 2u;
const uint kGhostEdge = 3u;
const uint kFactors = 4u;

#include "simulation/rod/edges.glsl"
#include "simulation/rod/joint.glsl"
#include "simulation/rod/symmetric.glsl"

const float kShortestSpan = 1.0e-6;  // shorter spans have no direction
// Limit of a spring's stiffness over the mass of a segment, per substep squared. Beside stiffer
// springs, 32 bits lose the masses and the elimination fails. By default, 128 segments of 15 cm
// stay below half of it. The reference has no limit.
const float kStiffestSpring = 1.0e4;

// Computes displacements by everything except springs, and the ghost.
void predict() {
    takeRoot();
    vec3 edges = vec3(0.0);  // from the root to here
    vec4 ghost = orientationAt(0);
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        vec4 drag;
        vec3 moved = predictedMove(i, motionAt(i), edges, drag);
        // The first segment at rest has the follicle's orientation.
        vec4 half_rotation = segmentRow(rod.segments, i, kRodHalfRotation, guides.strand_count, strand);
        if (i > 1) ghost = normalize(multiply(ghost, multiply(half_rotation, half_rotation)));
        setScratch(i, kPredicted, vec4(moved, 0.0));
        setScratch(i, kMoved, vec4(moved, 0.0));
        setScratch(i, kDrag, drag);
        setScratch(i, kGhostEdge, vec4(restLength(i) * axisOf(ghost), 0.0));
    }
}

vec3 movedAt(uint i) { return i > 0 ? scratchAt(i, kMoved).xyz : root_moved; }

// The current edge of a segment.
vec3 edgeNow(uint i) { return edgeAt(i) + (movedAt(i) - movedAt(i - 1)); }

// A spring's force on its lower end, and the force's derivative by the distance to the upper end.
struct Spring {
    vec3 force;
    mat3 stiffness;
};

// A spring between two vertices with the current difference `span` and the rest difference `rest`.
Spring stretchOf(vec3 span, vec3 rest) {
    float rest_length = length(rest);
    float stiffness = min(stretching / max(rest_length, kLeastLength), kStiffestSpring);
    float now = max(length(span), kShortestSpan);
    vec3 along = span / now;
    float across = max(1.0 - rest_length / now, 0.0);
    mat3 projection = outerProduct(along, along);
    return Spring(
        stiffness * (rest_length - now) * along,
        stiffness * (projection + across * (mat3(1.0) - projection)));
}

// The angular spring of a segment. The angle is computed as twice the half angle, from the lengths
// of the sum and the difference of the directions.
Spring turnOf(vec3 edge, vec3 ghost_axis, float rest_length) {
    vec3 along = edge / max(length(edge), kShortestSpan);
    float len = max(length(edge), kLeastLength);
    float stiffness = min(rod.angular / (unit * unit) * rest_length / len, kStiffestSpring);
    float sine = 0.5 * length(ghost_axis - along);  // of half the angle
    float cosine = 0.5 * length(ghost_axis + along);
    float angle = twistAngle(sine, cosine, 1.0);
    vec3 away = ghost_axis - dot(ghost_axis, along) * along;
    float share = sine > 1.0e-4 ? angle / max(2.0 * sine * cosine, 1.0e-6) : 1.0;
    return Spring(
        stiffness * share * away,
        stiffness / len * (mat3(1.0) - outerProduct(along, along)));
}

void setFactor(uint i, uint which, mat3 with, vec3 constant_term) {
    for (uint k = 0; k < 3; ++k)
        setScratch(i, kFactors + 3 * which + k, vec4(with[k], constant_term[k]));
}

// Eliminates vertices from the tip up. Carries the action of all vertices below on the current
// vertex and the two above it. Adds the springs of the current vertex, which also reach the third.
void eliminate() {
    mat3 own = mat3(0.0);
    mat3 own_first = mat3(0.0);  // row: the vertex, column: the first above it
    mat3 own_second = mat3(0.0);
    mat3 first = mat3(0.0);
    mat3 first_second = mat3(0.0);
    mat3 second = mat3(0.0);
    vec3 force = vec3(0.0);
    vec3 force_first = vec3(0.0);
    vec3 force_second = vec3(0.0);

    // Displacement of the vertex from its ghost.
    vec3 ghost_offset = vec3(0.0);
    for (uint i = 1; i < guides.vertices_per_strand; ++i)
        ghost_offset += edgeNow(i) - scratchAt(i, kGhostEdge).xyz;

    for (uint i = guides.vertices_per_strand - 1; i > 0; --i) {
        RodSegment segment = loadSegment(rod.segments, i, guides.strand_count, strand);
        vec3 edge = edgeNow(i);
        vec3 ghost_edge = scratchAt(i, kGhostEdge).xyz;
        mat3 own_third = mat3(0.0);
        mat3 third = mat3(0.0);
        vec3 force_third = vec3(0.0);

        // Inertia, drag and the integrity spring act on the vertex alone.
        vec3 behind = scratchAt(i, kPredicted).xyz - scratchAt(i, kMoved).xyz;
        vec4 drag = scratchAt(i, kDrag);
        float added_mass = segment.mass * drag.w;
        float integrity = segment.mass * rod.integrity;
        own += mat3(segment.mass + integrity) +
               added_mass * (mat3(1.0) - outerProduct(drag.xyz, drag.xyz));
        force += segment.mass * behind +
                 added_mass * (behind - dot(drag.xyz, behind) * drag.xyz) -
                 integrity * ghost_offset;
        ghost_offset -= edge - ghost_edge;

        Spring spring = stretchOf(edge, ghost_edge);
        // The rest edge is not divided by its length, which may be 0.
        vec3 ghost_axis = segment.rest_length > kShortestSpan ? normalize(ghost_edge) : vec3(0.0);
        if (ghost_axis != vec3(0.0)) {
            Spring turn = turnOf(edge, ghost_axis, segment.rest_length);
            spring.force += turn.force;
            spring.stiffness += turn.stiffness;
        }
        own += spring.stiffness;
        own_first -= spring.stiffness;
        first += spring.stiffness;
        force += spring.force;
        force_first -= spring.force;
        if (i > 1) {
            edge += edgeNow(i - 1);
            ghost_edge += scratchAt(i - 1, kGhostEdge).xyz;
            spring = stretchOf(edge, ghost_edge);
            own += spring.stiffness;
            own_second -= spring.stiffness;
            second += spring.stiffness;
            force += spring.force;
            force_second -= spring.force;
        }
        if (i > 2) {
            edge += edgeNow(i - 2);
            ghost_edge += scratchAt(i - 2, kGhostEdge).xyz;
            spring = stretchOf(edge, ghost_edge);
            own += spring.stiffness;
            own_third = -spring.stiffness;
            third = spring.stiffness;
            force += spring.force;
            force_third = -spring.force;
        }

        mat3 factor_first = mat3(0.0);
        mat3 factor_second = mat3(0.0);
        mat3 factor_third = mat3(0.0);
        vec3 constant_term = vec3(0.0);
        if (!isPinned(i)) {
            mat3 compliance = inverseOfSymmetric(own);
            factor_first = -compliance * own_first;
            factor_second = -compliance * own_second;
            factor_third = -compliance * own_third;
            constant_term = compliance * force;
        }
        setFactor(i, 0, factor_first, constant_term);
        setFactor(i, 1, factor_second, vec3(0.0));
        setFactor(i, 2, factor_third, vec3(0.0));

        // Shift by one vertex: the vertex above is next.
        mat3 from_first = transpose(own_first);
        mat3 from_second = transpose(own_second);
        mat3 from_third = transpose(own_third);
        own = symmetric(first + from_first * factor_first);
        own_first = first_second + from_first * factor_second;
        own_second = from_first * factor_third;
        first = symmetric(second + from_second * factor_second);
        first_second = from_second * factor_third;
        second = symmetric(third + from_third * factor_third);
        force = force_first - from_first * constant_term;
        force_first = force_second - from_second * constant_term;
        force_second = force_third - from_third * constant_term;
    }
}

// Computes the displacements of the vertices from the root down.
void moveVertices() {
    vec3 above = vec3(0.0);
    vec3 second_above = vec3(0.0);
    vec3 third_above = vec3(0.0);
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        vec3 further = vec3(0.0);
        for (uint k = 0; k < 3; ++k) {
            vec4 column = scratchAt(i, kFactors + k);
            further[k] += column.w;
            further += above[k] * column.xyz + second_above[k] * scratchAt(i, kFactors + 3 + k).xyz +
                       third_above[k] * scratchAt(i, kFactors + 6 + k).xyz;
        }
        setScratch(i, kMoved, vec4(scratchAt(i, kMoved).xyz + further, 0.0));
        third_above = second_above;
        second_above = above;
        above = further;
    }
}

// Turns orientations with the edges.
void turnSegments() {
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        vec3 edge = edgeNow(i);
        if (length(edge) < kShortestSpan) continue;
        vec4 orientation = orientationAt(i);
        vec4 turn = rotationBetween(axisOf(orientation), normalize(edge));
        storeVector(rod.motion, orientationIndex(i), normalize(multiply(turn, orientation)));
    }
}

void main() {
    if (!takeStrand()) return;  // no barrier follows
    predict();
    for (uint i = 0; i < rod.iterations; ++i) {
        eliminate();
        moveVertices();
    }
    turnSegments();
    finish();
}

// One substep of the `augmented_mass_spring` solver, one invocation per strand: Amador Herrera et
// al. 2024, Augmented mass-spring model for real-time dense hair simulation (arXiv 2412.17144).
// Implicit Euler, by Newton steps that solve the strand's seven diagonals of blocks directly;
// hair/reference/augmented_mass_spring.h has the springs and what of this is the paper's. See
// rod_structs.h for the units. Before it: common/vectors.glsl or common/packed_vectors.glsl.
#include "shared/rod_structs.h"

// Rows of the scratch memory: how the vertex would move without springs; how it moves; the tangent
// that air brakes it across, and by how much; its segment's edge at rest, turned with the head, and
// from 4 on, of the Newton step that an elimination from the tip up leaves, by columns, how the
// vertex goes with the one above it, the second and the third; as the last row of the first three,
// how it moves by itself.
const uint kScratchRows = kMassSpringScratchRows;
const uint kPredicted = 0u;
const uint kMoved = 1u;
const uint kBrake = 2u;
const uint kGhostEdge = 3u;
const uint kGoesWith = 4u;

#include "simulation/rod/edges.glsl"
#include "simulation/rod/joint.glsl"
#include "simulation/rod/symmetric.glsl"

const float kShortestSpan = 1.0e-6;  // what is shorter has no direction
// Over the mass of a segment and per substep squared: stiffer springs leave nothing of masses in 32
// bits, and the elimination loses its way. By default half of that is not reached by 128 segments of
// 15 cm; the reference has no such bound.
const float kStiffestSpring = 1.0e4;

// Displacements by all but springs, and the ghost.
void predict() {
    takeRoot();
    vec3 edges = vec3(0.0);  // from the root to here
    vec4 ghost = orientationAt(0);
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        vec4 brake;
        vec3 moved = predictedMove(i, motionAt(i), edges, brake);
        // The first segment at rest has the follicle's orientation.
        vec4 half_rotation = segmentRow(rod.segments, i, kRodHalfRotation, guides.strand_count, strand);
        if (i > 1) ghost = normalize(multiply(ghost, multiply(half_rotation, half_rotation)));
        setScratch(i, kPredicted, vec4(moved, 0.0));
        setScratch(i, kMoved, vec4(moved, 0.0));
        setScratch(i, kBrake, brake);
        setScratch(i, kGhostEdge, vec4(restLength(i) * axisOf(ghost), 0.0));
    }
}

vec3 movedAt(uint i) { return i > 0 ? scratchAt(i, kMoved).xyz : root_moved; }

// A segment's edge now.
vec3 edgeNow(uint i) { return edgeAt(i) + (movedAt(i) - movedAt(i - 1)); }

// A spring's force on its lower end, and how that grows with the distance to its upper one.
struct Spring {
    vec3 force;
    mat3 stiffness;
};

// From one vertex to another, which is `span` away and was `rest` at rest.
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

// The angular spring of a segment. The angle is twice that of half the directions' sum and
// difference.
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

void setGoesWith(uint i, uint which, mat3 with, vec3 by_itself) {
    for (uint k = 0; k < 3; ++k)
        setScratch(i, kGoesWith + 3 * which + k, vec4(with[k], by_itself[k]));
}

// From the tip up: what of all below a vertex acts on it and on the next two above, and what its
// own springs add to these and to the third.
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

    // How far the vertex is from its ghost.
    vec3 astray = vec3(0.0);
    for (uint i = 1; i < guides.vertices_per_strand; ++i)
        astray += edgeNow(i) - scratchAt(i, kGhostEdge).xyz;

    for (uint i = guides.vertices_per_strand - 1; i > 0; --i) {
        RodSegment segment = loadSegment(rod.segments, i, guides.strand_count, strand);
        vec3 edge = edgeNow(i);
        vec3 ghost_edge = scratchAt(i, kGhostEdge).xyz;
        mat3 own_third = mat3(0.0);
        mat3 third = mat3(0.0);
        vec3 force_third = vec3(0.0);

        // What holds the vertex alone.
        vec3 behind = scratchAt(i, kPredicted).xyz - scratchAt(i, kMoved).xyz;
        vec4 brake = scratchAt(i, kBrake);
        float heavier = segment.mass * brake.w;
        float integrity = segment.mass * rod.integrity;
        own += mat3(segment.mass + integrity) +
               heavier * (mat3(1.0) - outerProduct(brake.xyz, brake.xyz));
        force += segment.mass * behind +
                 heavier * (behind - dot(brake.xyz, behind) * brake.xyz) - integrity * astray;
        astray -= edge - ghost_edge;

        Spring spring = stretchOf(edge, ghost_edge);
        // Not the edge at rest over its length, which may be 0.
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

        mat3 with_first = mat3(0.0);
        mat3 with_second = mat3(0.0);
        mat3 with_third = mat3(0.0);
        vec3 by_itself = vec3(0.0);
        if (!isPinned(i)) {
            mat3 yields = inverseOfSymmetric(own);
            with_first = -yields * own_first;
            with_second = -yields * own_second;
            with_third = -yields * own_third;
            by_itself = yields * force;
        }
        setGoesWith(i, 0, with_first, by_itself);
        setGoesWith(i, 1, with_second, vec3(0.0));
        setGoesWith(i, 2, with_third, vec3(0.0));

        // The vertex above is the next.
        mat3 from_first = transpose(own_first);
        mat3 from_second = transpose(own_second);
        mat3 from_third = transpose(own_third);
        own = symmetric(first + from_first * with_first);
        own_first = first_second + from_first * with_second;
        own_second = from_first * with_third;
        first = symmetric(second + from_second * with_second);
        first_second = from_second * with_third;
        second = symmetric(third + from_third * with_third);
        force = force_first - from_first * by_itself;
        force_first = force_second - from_second * by_itself;
        force_second = force_third - from_third * by_itself;
    }
}

// From the root down: how every vertex moves.
void moveVertices() {
    vec3 above = vec3(0.0);
    vec3 second_above = vec3(0.0);
    vec3 third_above = vec3(0.0);
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        vec3 further = vec3(0.0);
        for (uint k = 0; k < 3; ++k) {
            vec4 column = scratchAt(i, kGoesWith + k);
            further[k] += column.w;
            further += above[k] * column.xyz + second_above[k] * scratchAt(i, kGoesWith + 3 + k).xyz +
                       third_above[k] * scratchAt(i, kGoesWith + 6 + k).xyz;
        }
        setScratch(i, kMoved, vec4(scratchAt(i, kMoved).xyz + further, 0.0));
        third_above = second_above;
        second_above = above;
        above = further;
    }
}

// Orientations go with the edges.
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

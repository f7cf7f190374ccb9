#version 460
// One substep of the `shape` solver: integration, then the constraints in the thesis's order (3.2),
// then collisions. A strand is cut into chunks of kVerticesPerChunk vertices, and an invocation
// keeps one chunk in registers. Every loop over its vertices must unroll, so that all indices are
// constants. Neighbouring invocations have the same chunk of neighbouring strands, so branches that
// differ between chunks are uniform in most subgroups. A work group holds whole strands.
// Invocations past the last strand work on zeros and store nothing, so that all of them reach every
// barrier; with one chunk per strand there is no barrier.
// With HAIRBENCH_ENERGY the local constraint has an energy, which is solved together with the
// lengths.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "common/rigid_frame.glsl"
#include "common/vectors.glsl"
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

// The work group size is a multiple of kChunks.
layout(local_size_x_id = kShapeGroupSizeConstant) in;
layout(constant_id = kShapeVerticesPerStrandConstant) const uint kVerticesPerStrand = 8;
// True if there are bodies.
layout(constant_id = kShapeCollidesConstant) const bool kCollides = true;
layout(constant_id = kShapeTridiagonalConstant) const bool kTridiagonal = true;
// Even if a strand has more than one chunk, so that all segments between chunks are black.
layout(constant_id = kShapeVerticesPerChunkConstant) const uint kVerticesPerChunk = 8;

layout(push_constant, scalar) uniform Push { SubstepPush push; };

layout(buffer_reference, scalar) readonly buffer ShapeReference { ShapeParameters parameters; };

const uint kChunks = (kVerticesPerStrand + kVerticesPerChunk - 1) / kVerticesPerChunk;
const uint kLastChunk = kChunks - 1;
const uint kStrandsPerGroup = gl_WorkGroupSize.x / kChunks;
// Vertices of the last chunk. The rest of that chunk is padding.
const uint kVerticesInLast = kVerticesPerStrand - kLastChunk * kVerticesPerChunk;

uint lane;
uint chunk;
RigidFrame root_frame;  // at the end of the substep
RigidFrame root_frame_before;
vec4 head_rotation;  // of the frame of the rest shape
// Vertex j of the chunk is points[j + 1]. Before and after these are the last vertex of the
// previous chunk and the first vertex of the next. Segment j joins points[j] and points[j + 1].
vec4 points[kVerticesPerChunk + 2];  // w: inverse mass, reduced by drag
vec4 rest_edges[kVerticesPerChunk + 1];
vec3 goal_edges[kVerticesPerChunk + 1];
#ifdef HAIRBENCH_ENERGY
// Loads of vertices, joints at the segments' starts, and axes of these joints.
BendLoad loads[kVerticesPerChunk];
BendJoint joints[kVerticesPerChunk];
vec3 axes[kVerticesPerChunk];
#endif

// Data that chunks exchange. The halves alternate, so that one barrier is enough.
shared vec4 firsts[2][gl_WorkGroupSize.x];
shared vec4 lasts[2][gl_WorkGroupSize.x];
shared vec4 rotations[2][gl_WorkGroupSize.x];
shared float contacts[gl_WorkGroupSize.x];
shared vec4 tangents[gl_WorkGroupSize.x];  // w: 0 if the chunk has no direction
#ifdef HAIRBENCH_ENERGY
shared float forces[gl_WorkGroupSize.x];
#endif
uint turn = 0;

bool vertexExists(uint j) { return j < kVerticesInLast || chunk < kLastChunk; }
bool segmentExists(uint j) { return j == 0 ? chunk > 0 : vertexExists(j); }
vec3 edge(uint j) { return points[j + 1].xyz - points[j].xyz; }

// Fetches the neighbouring vertices of the previous and the next chunk.
void syncChunks() {
    if (kChunks == 1) return;
    firsts[turn][lane] = points[1];
    lasts[turn][lane] = points[kVerticesPerChunk];
    barrier();
    if (chunk > 0) points[0] = lasts[turn][lane - kStrandsPerGroup];
    if (chunk < kLastChunk) points[kVerticesPerChunk + 1] = firsts[turn][lane + kStrandsPerGroup];
    turn = 1 - turn;
}

// Returns the tangent of the last segment before segment 0 that has a direction.
vec3 tangentBefore(vec3 first_rest_tangent) {
    if (kChunks == 1) return first_rest_tangent;
    vec4 last = vec4(0.0);
    [[unroll]] for (uint j = 0; j < kVerticesPerChunk; ++j) {
        if (segmentExists(j) && hasDirection(edge(j), rest_edges[j].w)) last = vec4(edge(j), 1.0);
    }
    tangents[lane] = last;
    barrier();
    for (uint back = 1; back <= chunk; ++back) {
        vec4 tangent = tangents[lane - back * kStrandsPerGroup];
        if (tangent.w != 0.0) return normalize(tangent.xyz);
    }
    return first_rest_tangent;
}

// Returns the rotation at the start of the chunk, from the head and all previous chunks: an
// exclusive prefix scan by recursive doubling.
vec4 rotationBefore(vec4 own) {
    rotations[0][lane] = own;
    barrier();
    vec4 before = kNoRotation;
    if (chunk > 0) before = rotations[0][lane - kStrandsPerGroup];
    uint latest = 0;
    for (uint reach = 1; reach < kLastChunk; reach *= 2) {
        latest = 1 - latest;
        rotations[latest][lane] = before;
        barrier();
        if (chunk >= reach)
            before = multiply(before, rotations[latest][lane - reach * kStrandsPerGroup]);
    }
    return renormalize(multiply(before, head_rotation));
}

// Computes the rest edges in the frames of the segments before them.
void findGoalEdges(vec3 first_rest_tangent) {
    vec4 rotations_in_chunk[kVerticesPerChunk + 1];
    Transport frame =
        Transport(tangentBefore(first_rest_tangent), kChunks == 1 ? head_rotation : kNoRotation);
    [[unroll]] for (uint j = 0; j < kVerticesPerChunk; ++j) {
        rotations_in_chunk[j] = frame.rotation;
#ifdef HAIRBENCH_ENERGY
        vec3 tangent = frame.tangent;
        if (segmentExists(j)) frame = transport(frame, edge(j), rest_edges[j].w);
        axes[j] = jointAxis(tangent, frame.tangent);
#else
        if (segmentExists(j)) frame = transport(frame, edge(j), rest_edges[j].w);
#endif
    }
    rotations_in_chunk[kVerticesPerChunk] = frame.rotation;
    vec4 before = kNoRotation;
    if (kChunks > 1) before = rotationBefore(frame.rotation);
    [[unroll]] for (uint j = 0; j <= kVerticesPerChunk; ++j) {
        vec4 rotation = rotations_in_chunk[j];
        if (kChunks > 1) rotation = multiply(rotation, before);
        goal_edges[j] = rotate(rotation, rest_edges[j].xyz);
    }
}

void pull(uint j, float stiffness) {
    if (segmentExists(j)) pullToShape(points[j], points[j + 1], goal_edges[j], stiffness);
}

void project(uint j) {
    if (segmentExists(j)) projectLength(points[j], points[j + 1], rest_edges[j].w);
}

#ifdef HAIRBENCH_ENERGY
// Solves the energy's system. If a strand has several chunks, they walk one after the other. They
// pass on their state through all the shared arrays.
void bendUpChunk(vec2 stiffness, float free_mass, vec3 root_moved) {
    BendBelow below = noBody();
    if (kChunks > 1 && chunk < kLastChunk) {
        uint next = lane + kStrandsPerGroup;
        vec4 a = rotations[0][next];
        vec4 b = rotations[1][next];
        vec4 c = firsts[0][next];
        vec4 d = firsts[1][next];
        vec4 e = lasts[0][next];
        vec4 f = lasts[1][next];
        vec4 g = tangents[next];
        below = BendBelow(
            Symmetric(a.xyz, b.xyz), mat3(c.xyz, d.xyz, e.xyz), Symmetric(f.xyz, g.xyz),
            vec3(a.w, b.w, c.w), vec3(d.w, e.w, f.w), vec3(g.w, contacts[next], forces[next]));
    }
    [[unroll]] for (uint up = 0; up < kVerticesPerChunk; ++up) {
        uint j = kVerticesPerChunk - 1 - up;
        if (!segmentExists(j)) continue;
        float mass = points[j + 1].w > 0.0 ? free_mass : kHeldMass * kVerticesPerStrand;
        addVertex(below, loads[j], mass, root_moved);
        if (hasDirection(edge(j), rest_edges[j].w))
            joints[j] = addJoint(below, edge(j), goal_edges[j], axes[j], stiffness);
    }
    if (kChunks == 1) return;
    rotations[0][lane] = vec4(below.hessian_move.diagonal, below.push.x);
    rotations[1][lane] = vec4(below.hessian_move.off_diagonal, below.push.y);
    firsts[0][lane] = vec4(below.hessian_mixed[0], below.push.z);
    firsts[1][lane] = vec4(below.hessian_mixed[1], below.couple.x);
    lasts[0][lane] = vec4(below.hessian_mixed[2], below.couple.y);
    lasts[1][lane] = vec4(below.hessian_turn.diagonal, below.couple.z);
    tangents[lane] = vec4(below.hessian_turn.off_diagonal, below.force.x);
    contacts[lane] = below.force.y;
    forces[lane] = below.force.z;
}

void bendDownChunk(vec3 root_moved) {
    vec4 head_turn = multiply(root_frame.rotation, conjugate(root_frame_before.rotation));
    BendAbove above = BendAbove(
        points[1].xyz + root_moved, root_moved, (head_turn.w < 0.0 ? -2.0 : 2.0) * head_turn.xyz);
    if (kChunks > 1 && chunk > 0)
        above = BendAbove(
            rotations[0][lane - kStrandsPerGroup].xyz, rotations[1][lane - kStrandsPerGroup].xyz,
            firsts[0][lane - kStrandsPerGroup].xyz);
    vec3 before = points[0].xyz;
    [[unroll]] for (uint j = 0; j < kVerticesPerChunk; ++j) {
        vec3 point = points[j + 1].xyz;
        vec3 edge_before = point - before;
        before = point;
        float rest_length = rest_edges[j].w;
        if (segmentExists(j) && hasDirection(edge_before, rest_length))
            turnSegment(above, joints[j], edge_before, axes[j], rest_length);
        else if (segmentExists(j) && rest_length >= kShortestSegment)
            above.place.y += rest_length;
        points[j + 1].xyz = above.place;
    }
    if (kChunks == 1) return;
    rotations[0][lane] = vec4(above.place, 0.0);
    rotations[1][lane] = vec4(above.moved, 0.0);
    firsts[0][lane] = vec4(above.turned, 0.0);
}

void bend(vec2 stiffness, float free_mass, vec3 root_moved) {
    if (kChunks > 1) barrier();  // the shared arrays are reused
    for (uint waiting = kChunks; waiting > 0; --waiting) {
        if (kChunks == 1 || chunk == waiting - 1) bendUpChunk(stiffness, free_mass, root_moved);
        if (kChunks > 1) barrier();
    }
    for (uint sweeping = 0; sweeping < kChunks; ++sweeping) {
        if (kChunks == 1 || chunk == sweeping) bendDownChunk(root_moved);
        if (kChunks > 1) barrier();
    }
}
#endif

// Solves the lengths' systems. If a strand has several chunks, they walk one after the other: down
// through rotations[] and firsts[0], up through tangents[] and contacts[].
LengthRow rows[kVerticesPerChunk];

void sweepDownChunk(bool last, bool planes) {
    LengthsAbove above = aboveAll(points[1].xyz);
    if (kChunks > 1 && chunk > 0) {
        vec4 place = rotations[0][lane - kStrandsPerGroup];
        vec4 direction = rotations[1][lane - kStrandsPerGroup];
        vec4 surface = firsts[0][lane - kStrandsPerGroup];
        above =
            LengthsAbove(place.xyz, direction.xyz, surface.xyz, surface.w, place.w, direction.w);
    }
    [[unroll]] for (uint j = 0; j < kVerticesPerChunk; ++j) {
        if (!segmentExists(j)) continue;
        float rest_length = rest_edges[j].w;
        if (last) {
            sweepPlace(above.place, above.direction, rows[j], points[j + 1], rest_length, planes);
            points[j + 1].xyz = above.place;
        } else {
            sweepDown(above, rows[j], points[j], points[j + 1], rest_length, planes);
        }
    }
    if (kChunks == 1) return;
    rotations[0][lane] = vec4(above.place, above.yield);
    rotations[1][lane] = vec4(above.direction, above.tension);
    firsts[0][lane] = vec4(above.normal, above.held);
}

void sweepUpChunk() {
    LengthsBelow below = LengthsBelow(vec3(0.0), 0.0, 0.0);
    if (kChunks > 1 && chunk < kLastChunk) {
        vec4 pull = tangents[lane + kStrandsPerGroup];
        below = LengthsBelow(pull.xyz, pull.w, contacts[lane + kStrandsPerGroup]);
    }
    [[unroll]] for (uint up = 0; up < kVerticesPerChunk; ++up) {
        uint j = kVerticesPerChunk - 1 - up;
        if (segmentExists(j))
            sweepUp(below, rows[j], points[j], points[j + 1], rest_edges[j].w);
    }
    if (kChunks == 1) return;
    tangents[lane] = vec4(below.pull, below.hold);
    contacts[lane] = below.tension;
}

void sweepDownChunks(bool last, bool planes) {
    for (uint sweeping = 0; sweeping < kChunks; ++sweeping) {
        if (kChunks == 1 || chunk == sweeping) sweepDownChunk(last, planes);
        if (kChunks > 1) barrier();
    }
}

void sweepUpChunks() {
    for (uint waiting = kChunks; waiting > 0; --waiting) {
        if (kChunks == 1 || chunk == waiting - 1) sweepUpChunk();
        if (kChunks > 1) barrier();
    }
}

// `met`: contacts with bodies; read if `planes`.
void solveLengths(uint passes, bool planes, VertexContact met[kVerticesPerChunk]) {
    if (passes == 0) return;
    syncChunks();
    if (kChunks > 1) barrier();  // firsts[] is reused
    [[unroll]] for (uint j = 0; j < kVerticesPerChunk; ++j)
        rows[j] = lengthRow(
            points[j + 1], planes ? met[j].plane : vec4(0.0),
            planes ? heldAcross(met[j].held) : 0.0);
    for (uint pass = 0; pass < passes; ++pass) {
        sweepDownChunks(false, planes);
        sweepUpChunks();
    }
    sweepDownChunks(true, planes);
}

void storePositions(Address positions, uint first) {
    [[unroll]] for (uint j = 0; j < kVerticesPerChunk; ++j)
        if (vertexExists(j))
            storeVector(positions, first + j, vec4(points[j + 1].xyz, sign(points[j + 1].w)));
}

// The tangent at vertex i of the chunk that starts at `first`, at the start of the substep.
vec3 tangentAt(GuideParameters from, uint first, uint i) {
    vec3 point = loadVector(from.positions, first + i).xyz;
    vec3 above = vec3(0.0);
    vec3 below = vec3(0.0);
    if (i > 0 || chunk > 0)
        above = directionOf(point - loadVector(from.positions, first + i - 1).xyz);
    if (chunk < kLastChunk || i + 1 < kVerticesInLast)
        below = directionOf(loadVector(from.positions, first + i + 1).xyz - point);
    return tangentBetween(above, below);
}

// Loads this invocation's vertices at the start of the substep.
void load(GuideParameters guides, GuideParameters from, ShapeParameters params, uint first) {
    [[unroll]] for (uint j = 0; j < kVerticesPerChunk; ++j) {
        if (!vertexExists(j)) continue;
        vec4 point = loadVector(from.positions, first + j);
        vec3 previous = loadVector(from.previous, first + j).xyz;
        storeVector(guides.previous, first + j, vec4(point.xyz, 0.0));
        vec3 rest = toWorld(root_frame, loadVector(params.rest_positions, first + j).xyz);
        vec3 acceleration = guides.gravity;
        if (push.accelerations != kNoAddress)
            acceleration += loadVector(push.accelerations, first + j).xyz;
        vec3 moved = integrate(
            point.xyz, previous, acceleration, guides.velocity_kept,
            guides.step.sub * guides.step.sub);
#ifdef HAIRBENCH_ENERGY
        loads[j] = kNoLoad;
        if (point.w > 0.0) {
            loads[j] = freeLoad(
                moved - point.xyz, pullPerMass(params.global_stiffness) * (rest - point.xyz));
            if (push.air != kNoAddress) {
                vec3 air = loadVector(push.air, first + j).xyz;
                vec3 tangent = tangentAt(from, first, j);
                vec3 velocity = (point.xyz - previous) / guides.step.sub;
                float drag = dragFactor(push.drag, tangent, air - velocity, guides.step.sub);
                addAir(loads[j], tangent, drag, air, velocity, guides.step.sub);
                point.w /= 1.0 + drag;
            }
        }
#else
        float stiffness = params.global_stiffness;
        if (push.air != kNoAddress) {
            vec3 air = loadVector(push.air, first + j).xyz;
            vec3 tangent = tangentAt(from, first, j);
            vec3 u = air - (point.xyz - previous) / guides.step.sub;
            float drag = dragFactor(push.drag, tangent, u, guides.step.sub);
            moved = point.xyz +
                    withDrag(moved - point.xyz, guides.step.sub * air, tangent, drag);
            point.w /= 1.0 + drag;
            stiffness = pullOn(stiffness, drag);
        }
        if (point.w > 0.0) point.xyz = pullToRest(moved, rest, stiffness);
        if (j == 0 && chunk == 0) point.xyz = rest;
#endif
        points[j + 1] = point;
        rest_edges[j] = loadVector(params.rest_edges, first + j);
    }
    if (chunk < kLastChunk)
        rest_edges[kVerticesPerChunk] = loadVector(params.rest_edges, first + kVerticesPerChunk);
}

#ifdef HAIRBENCH_ENERGY
bool isHeld(uint j) { return vertexExists(j) && points[j + 1].w == 0.0 && (j > 0 || chunk > 0); }

// True if any vertex except roots is held, in all strands that share barriers. The result depends
// only on shared memory. Mesa 22.3.6's lavapipe also runs loops for lanes past the work group's
// end. If those lanes iterated more often, their subgroup would meet the others at the wrong
// barrier.
bool anyHeld(bool present) {
    float held = 0.0;
    [[unroll]] for (uint j = 0; j < kVerticesPerChunk; ++j)
        if (present && isHeld(j)) held = 1.0;
    if (kChunks == 1) return held > 0.0;
    contacts[lane] = held;
    barrier();
    bool any = false;
    for (uint i = 0; i < gl_WorkGroupSize.x; ++i) any = any || contacts[i] > 0.0;
    barrier();
    return any;
}

void holdInPlace(GuideParameters from, uint first) {
    [[unroll]] for (uint j = 0; j < kVerticesPerChunk; ++j)
        if (isHeld(j)) points[j + 1].xyz = loadVector(from.positions, first + j).xyz;
}
#endif

// Marks contact at vertices below one in contact, even if that one is in a previous chunk.
void markBelow(GuideParameters guides, float contact, uint first, uint end) {
    contacts[lane] = contact;
    barrier();
    float above = 0.0;
    for (uint back = 1; back <= chunk; ++back)
        above = max(above, contacts[lane - back * kStrandsPerGroup]);
    if (above > 0.0)
        for (uint i = first; i < end; ++i) State(guides.previous).at[i].w = above;
}

void main() {
    GuideParameters guides = GuideReference(push.guides).parameters;
    ShapeParameters params = ShapeReference(push.solver).parameters;
    lane = gl_LocalInvocationID.x;
    chunk = lane / kStrandsPerGroup;
    uint strand = workgroupIndex() * kStrandsPerGroup + lane % kStrandsPerGroup;
    bool present = strand < guides.strand_count;
    uint root = strand * kVerticesPerStrand;
    uint first = root + chunk * kVerticesPerChunk;
    uint end = first + (chunk < kLastChunk ? kVerticesPerChunk : kVerticesInLast);
    uint existing = min(strand, guides.strand_count - 1);
    root_frame = rootFrame(push.frame, push.roots, existing);
    root_frame_before = rootFrame(push.frame_before, push.roots_before, existing);

    [[unroll]] for (uint j = 0; j < kVerticesPerChunk + 2; ++j) points[j] = vec4(0.0);
    [[unroll]] for (uint j = 0; j <= kVerticesPerChunk; ++j) rest_edges[j] = vec4(0.0);
    float stiffness = 0.0;
    vec3 first_rest_tangent = vec3(0.0);
#ifdef HAIRBENCH_ENERGY
    RigidFrame head = root_frame_before;  // frame of the rest shape
    [[unroll]] for (uint j = 0; j < kVerticesPerChunk; ++j) loads[j] = kNoLoad;
    vec3 root_moved = vec3(0.0);
    if (present)
        root_moved = toWorld(root_frame, loadVector(params.rest_positions, root).xyz) -
                     loadVector(GuideReference(push.from).parameters.positions, root).xyz;
#else
    RigidFrame head = root_frame;
#endif
    head_rotation = head.rotation;
    if (present) {
        load(guides, GuideReference(push.from).parameters, params, first);
        stiffness = Factors(params.local_stiffness).at[strand];
        first_rest_tangent = firstTangent(head, Vectors(params.rest_edges).at[root + 1]);
    }

    syncChunks();
    bool lengths = true;  // true if lengths still need solving
#ifdef HAIRBENCH_ENERGY
    findGoalEdges(first_rest_tangent);
    bend(
        stiffness * vec2(1.0, params.local_damping), 1.0 + pullPerMass(params.global_stiffness),
        root_moved);
    lengths = anyHeld(present);
    if (lengths && present) holdInPlace(GuideReference(push.from).parameters, first);
#else
    // Red-black order: segments that share no vertex move at the same time. Segments that end in
    // odd vertices (the root's own among them) are first. Both chunks move the segment between
    // them.
    for (uint iteration = 0; iteration < params.local_iterations; ++iteration) {
        findGoalEdges(first_rest_tangent);
        [[unroll]] for (uint j = 1; j < kVerticesPerChunk; j += 2) pull(j, stiffness);
        syncChunks();
        [[unroll]] for (uint j = 0; j <= kVerticesPerChunk; j += 2) pull(j, stiffness);
    }
#endif
    if (!kTridiagonal && lengths) {
        for (uint iteration = 0; iteration < params.length_iterations; ++iteration) {
            [[unroll]] for (uint j = 1; j < kVerticesPerChunk; j += 2) project(j);
            syncChunks();
            [[unroll]] for (uint j = 0; j <= kVerticesPerChunk; j += 2) project(j);
        }
    }

    VertexContact met[kVerticesPerChunk];
    if (kTridiagonal && lengths) solveLengths(params.length_iterations, false, met);
    if (present) storePositions(guides.positions, first);
    if (!kCollides) return;

    if (!present) end = first;
    float contact = 0.0;
    [[unroll]] for (uint j = 0; j < kVerticesPerChunk; ++j)
        met[j] = VertexContact(vec4(0.0), kTouchesNone);
    for (uint i = first; i < end; ++i)  // collisions are too long to unroll
        met[i - first] = collide(guides, push.frame, push.frame_before, i, contact);
    if (kChunks > 1) markBelow(guides, contact, first, end);

    // Solves lengths once more, so that bodies do not stretch strands. Chunks meet at barriers and
    // therefore continue together.
    if (!kTridiagonal || params.length_iterations == 0) return;
    if (kChunks == 1 && contact == 0.0) return;
    [[unroll]] for (uint j = 0; j < kVerticesPerChunk; ++j)
        if (present && vertexExists(j)) {
            points[j + 1].xyz = loadVector(guides.positions, first + j).xyz;
            points[j + 1].w *= complianceAlong(met[j].held);
        }
    solveLengths(kContactPasses, true, met);
    if (present) storePositions(guides.positions, first);
}

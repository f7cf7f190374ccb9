// Contact of a strand's segments with bodies.
#ifndef HAIRBENCH_CONSTRAINT_SEGMENT_GLSL
#define HAIRBENCH_CONSTRAINT_SEGMENT_GLSL

#include "simulation/constraints/bodies.glsl"

// A place on a segment from p to q: p + at (q - p).
struct SegmentPlace {
    float at;
    float gap;  // to the body, without margin; negative inside, m
    vec3 normal;  // away from the body
};

// For a field, the segment is sampled at distances of at most a cell. The nearest sample is then
// refined by bisection.
const uint kMostSamples = 32u;
const uint kHalvings = 8u;
const float kLeastAcross = 0.3;  // shortest part of a unit normal across the segment that has a
                                 // direction

// The position from `first` on that is nearest to the capsule's axis: Ericson 2005, Real-time
// collision detection, section 5.1.9. For parallel axes it is the middle of the segment, or the
// valid position nearest to it.
float nearestTo(Capsule capsule, vec3 p, vec3 q, float first) {
    vec3 edge = q - p;
    vec3 axis = capsule.b - capsule.a;
    vec3 offset = p - capsule.a;
    float edge_size = max(dot(edge, edge), kShortestSegment * kShortestSegment);
    float axis_size = dot(axis, axis);
    float edge_offset = dot(edge, offset);
    if (axis_size < kShortestSegment * kShortestSegment)
        return clamp(-edge_offset / edge_size, first, 1.0);
    float both = dot(edge, axis);
    float axis_offset = dot(axis, offset);
    float across = edge_size * axis_size - both * both;
    float at = across > 1.0e-6 * edge_size * axis_size
                   ? (both * axis_offset - edge_offset * axis_size) / across
                   : 0.5;
    float along = clamp((both * clamp(at, first, 1.0) + axis_offset) / axis_size, 0.0, 1.0);
    return clamp((along * both - edge_offset) / edge_size, first, 1.0);
}

float nearestTo(DistanceField field, vec3 p, vec3 q, float first) {
    vec3 edge = q - p;
    float cells = length(edge) * field.cells_per_metre * (1.0 - first);
    uint samples = clamp(uint(ceil(cells)), 2u, kMostSamples);
    float step = (1.0 - first) / float(samples);
    float at = first;
    float least = uintBitsToFloat(0x7f800000u);
    vec3 gradient;
    for (uint i = 0; i <= samples; ++i) {
        float here = first + step * float(i);
        float gap = sampleDistance(field, p + here * edge, gradient);
        if (gap < least) {
            least = gap;
            at = here;
        }
    }
    float low = max(at - step, first);
    float high = min(at + step, 1.0);
    for (uint i = 0; i < kHalvings; ++i) {
        float middle = 0.5 * (low + high);
        sampleDistance(field, p + middle * edge, gradient);
        if (dot(gradient, edge) > 0.0)
            high = middle;
        else
            low = middle;
    }
    float halved = 0.5 * (low + high);
    return sampleDistance(field, p + halved * edge, gradient) < least ? halved : at;
}

// The place on the segment, from `first` on, that is nearest to the body or deepest in it. All in
// the body's own frame.
SegmentPlace nearestPlace(Bodies bodies, uint body, vec3 p, vec3 q, float first) {
    SegmentPlace place;
    place.at = body < bodies.capsule_count
                   ? nearestTo(Capsules(bodies.capsules).at[body], p, q, first)
                   : nearestTo(
                         BodyFields(bodies.fields).at[body - bodies.capsule_count].field, p, q,
                         first);
    place.gap = gapToBody(bodies, body, 0.0, mix(p, q, place.at), place.normal);
    // At a nearest point between its ends, the segment is parallel to the surface. A field has
    // creases there, and the gradient on either side of a crease also has a component along the
    // segment.
    vec3 edge = q - p;
    vec3 across = place.normal - dot(place.normal, edge) / dot(edge, edge) * edge;
    float size = length(across);
    if (place.at > first && place.at < 1.0 && size > kLeastAcross) place.normal = across / size;
    return place;
}

// A segment from a to b in the world, now and at the start of the substep.
struct MovingSegment {
    vec3 a;
    vec3 b;
    vec3 a_before;
    vec3 b_before;
    vec4 rest_a;  // on the head at rest; w: margin between bodies and the vertex
    vec4 rest_b;
    float first;  // collisions count from this place on
};

// A segment's contact with a body, in the world frame.
struct SegmentContact {
    vec3 normal;  // 0: no body is near
    float gap;  // negative inside, m
    float at;
    bool on_head;
    uint body;
};

const SegmentContact kNoContact = SegmentContact(vec3(0.0), kFar, 0.0, false, 0u);

// The plane where a segment entered a body on its path: dot(plane.xyz, x) >= plane.w outside. 0:
// none.
struct EnteredPlane {
    vec4 plane;
    float at;
    bool on_head;
};

// Shorter paths cannot lead past the middle of a body. The limit is a capsule's radius, and a cell
// for a field, which has nothing thinner than two cells.
float halfThickness(Bodies bodies, uint body) {
    if (body < bodies.capsule_count) return Capsules(bodies.capsules).at[body].radius;
    return BodyFields(bodies.fields).at[body - bodies.capsule_count].field.cell;
}

// The first quarter of a segment that starts at a root, or at another held vertex, is ignored: it
// lies in the skin.
const float kSkinShare = 0.25;
const uint kMostAdvances = 16u;
const float kSameSideCosine = 0.7;  // cosine between normals of the same side of a body

// The segment that ends in vertex `index` of [strand][vertex].
MovingSegment movingSegment(
    GuideParameters guides, uint vertex, float inverse_mass_above, vec3 a, vec3 b, vec3 a_before,
    vec3 b_before) {
    Vectors rest = Vectors(guides.rest_positions);
    return MovingSegment(
        a, b, a_before, b_before, rest.at[vertex - 1], rest.at[vertex],
        inverse_mass_above > 0.0 ? 0.0 : kSkinShare);
}

// Follows a segment's path from p_before, q_before to p, q in the body's frame, in steps within
// which no point of it can reach the body (Mirtich 1996, Impulse-based dynamic simulation of rigid
// body systems). Returns the plane where it enters; the gap is the distance from the path's end to
// that plane. Returns kNoContact if it enters nowhere.
SegmentContact enteredOn(
    Bodies bodies, uint body, vec3 p_before, vec3 q_before, vec3 p, vec3 q, float margin,
    float first) {
    float reach = max(distance(p, p_before), distance(q, q_before));
    float time = 0.0;
    for (uint i = 0; i < kMostAdvances; ++i) {
        vec3 p_now = mix(p_before, p, time);
        vec3 q_now = mix(q_before, q, time);
        SegmentPlace place = nearestPlace(bodies, body, p_now, q_now, first);
        float gap = place.gap - margin;
        if (gap < kTouch) {
            vec3 way = mix(p, q, place.at) - mix(p_now, q_now, place.at);
            return SegmentContact(
                place.normal, dot(place.normal, way) + gap, place.at, false, body);
        }
        time += gap / max(reach, kShortestSegment);
        if (time >= 1.0) break;
    }
    return kNoContact;
}

// The contact of the segment that is deepest in one of the bodies from `first_body` up to
// `end_body`, or nearest to one. With `by_way`, it finds planes where the segment enters bodies;
// they also hold it later. `keeps_rest`: a body that follows the head pushes it no farther out than
// it is at rest. `clearance`: no body is nearer to the segment than this.
SegmentContact contactOf(
    MovingSegment segment, Bodies bodies, uint first_body, uint end_body, RigidFrame frame,
    RigidFrame frame_before, bool by_way, bool keeps_rest, inout EnteredPlane entered,
    out float clearance) {
    clearance = kFar;
    float half_length = 0.5 * distance(segment.a, segment.b);
    float widest = max(segment.rest_a.w, segment.rest_b.w);
    SegmentContact nearest = kNoContact;
    float deepest = 0.0;
    if (by_way) entered = EnteredPlane(vec4(0.0), 0.0, false);
    for (uint body = first_body; body < end_body; ++body) {
        bool on_head = isOnHead(bodies, body);
        vec3 p = on_head ? fromWorld(frame, segment.a) : segment.a;
        vec3 q = on_head ? fromWorld(frame, segment.b) : segment.b;
        vec3 p_before = p;
        vec3 q_before = q;
        if (by_way) {
            p_before = on_head ? fromWorld(frame_before, segment.a_before) : segment.a_before;
            q_before = on_head ? fromWorld(frame_before, segment.b_before) : segment.b_before;
        }
        float reach = max(distance(p, p_before), distance(q, q_before));
        if (reach <= halfThickness(bodies, body)) reach = 0.0;
        vec3 normal;
        float gap = gapToBody(bodies, body, widest, 0.5 * (p + q), normal);
        clearance = min(clearance, gap - half_length);
        // A loop instead of a branch, because llvmpipe evaluates both sides of a branch but leaves
        // loops.
        for (bool near = gap < half_length + reach; near; near = false) {
            SegmentPlace place = nearestPlace(bodies, body, p, q, segment.first);
            float margin = mix(segment.rest_a.w, segment.rest_b.w, place.at);
            if (keeps_rest && on_head)
                margin = min(
                    margin, gapToBody(
                                bodies, body, 0.0,
                                mix(segment.rest_a.xyz, segment.rest_b.xyz, place.at), normal));
            gap = place.gap - margin;
            if (gap < nearest.gap)
                nearest = SegmentContact(
                    on_head ? rotate(frame.rotation, place.normal) : place.normal, gap, place.at,
                    on_head, body);
            for (bool moves = reach > 0.0; moves; moves = false) {
                SegmentContact found = enteredOn(
                    bodies, body, p_before, q_before, p, q, margin, segment.first);
                if (found.gap >= deepest) continue;
                deepest = found.gap;
                vec3 facing = on_head ? rotate(frame.rotation, found.normal) : found.normal;
                vec3 end = mix(segment.a, segment.b, found.at);
                entered = EnteredPlane(
                    vec4(facing, dot(facing, end) - found.gap), found.at, on_head);
            }
        }
    }
    // A segment that has passed the middle of a body, or all of it, is moved back the way it came.
    if (entered.plane.xyz == vec3(0.0) || dot(nearest.normal, entered.plane.xyz) > kSameSideCosine)
        return nearest;
    vec3 place = mix(segment.a, segment.b, entered.at);
    return SegmentContact(
        entered.plane.xyz, dot(entered.plane.xyz, place) - entered.plane.w, entered.at,
        entered.on_head, nearest.body);
}

// Displacement of the place of a contact in the substep, relative to its body.
vec3 movedPast(
    MovingSegment segment, SegmentContact contact, RigidFrame frame, RigidFrame frame_before) {
    vec3 before = mix(segment.a_before, segment.b_before, contact.at);
    if (contact.on_head) before = toWorld(frame, fromWorld(frame_before, before));
    return mix(segment.a, segment.b, contact.at) - before;
}

#endif

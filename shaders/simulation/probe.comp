#version 460
// Quantities of a guide: docs/physics.md, Probes. One invocation per guide.
#extension GL_GOOGLE_include_directive : require

#include "simulation/constraints/bodies.glsl"
#include "simulation/rod/joint.glsl"
#include "simulation/rod/state.glsl"
#include "simulation/root_frame.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { ProbePush push; };

layout(buffer_reference, scalar) writeonly buffer Rows { float at[]; };

// A vertex this close to a body's margin touches the body.
const float kTouching = 1.0e-5;  // m

// Planes of segments that bend less than this have no direction.
const float kStraight = 0.01;  // sine

bool wants(uint quantity) { return (push.quantities & quantity) != 0u; }

vec3 direction(vec3 v) {
    float len = length(v);
    return len < kShortestSegment ? vec3(0.0) : v / len;
}

// The angle between unit vectors, rad: Kahan 2006, How futile are mindless assessments of roundoff
// in floating-point computation?, section 12. 0 if one of them is zero.
float angleBetween(vec3 a, vec3 b) {
    if (a == vec3(0.0) || b == vec3(0.0)) return 0.0;
    float z = length(a - b), w = length(a + b);
    return twistAngle(z, w, sqrt(z * z + w * w));
}

// The unit normal of the plane of two unit vectors, or zero if they are almost parallel.
vec3 planeOf(vec3 a, vec3 b) {
    vec3 normal = cross(a, b);
    float sine = length(normal);
    return sine < kStraight ? vec3(0.0) : normal / sine;
}

float elasticEnergy(GuideParameters guides, uint strand, RigidFrame carried) {
    if (push.rods == Address(0)) return 0.0;
    RodParameters rod = RodReference(push.rods).parameters;
    uint strands = guides.strand_count;
    float sum = 0.0;
    // The yielding share has the strain that is left at the end of the substep.
    float yielding = rod.set_share * rod.set_mean * rod.set_mean;
    vec4 above = multiply(
        carried.rotation, segmentRow(rod.segments, 0, kRodHalfRotation, strands, strand));
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        RodSegment segment = loadSegment(rod.segments, i, strands, strand);
        vec4 orientation = loadMotion(rod.motion, i, strands, strand).orientation;
        vec4 first = multiply(above, segment.half_rotation);
        vec4 second = multiply(orientation, conjugate(segment.half_rotation));
        float energy = jointEnergy(
            first, second, segment.bend_stiffness, segment.twist_stiffness, rod.ellipticity,
            i == 1);
        if (kSets) {
            vec4 set = loadVector(rod.set, setIndex(i, strands, strand));
            energy = (1.0 - rod.set_share) * energy +
                     yielding * jointEnergy(
                                    multiply(first, set), multiply(second, conjugate(set)),
                                    segment.bend_stiffness, segment.twist_stiffness,
                                    rod.ellipticity, i == 1);
        }
        sum += energy;
        above = orientation;
    }
    float unit = Factors(rod.units).at[strand];
    float speed = unit / guides.step.sub;  // of one unit of length in one of time
    return sum * push.line_density * unit * speed * speed;
}

void main() {
    uint guide = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (guide >= push.guide_count) return;  // no barrier follows
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint strand = push.first_guide + guide;
    uint vertices = guides.vertices_per_strand;
    uint root = strand * vertices;
    State positions = State(guides.positions);
    State previous = State(guides.previous);
    Vectors groom = Vectors(push.rest), reference = Vectors(push.reference);

    float kinetic = 0.0, gravitational = 0.0, fastest = 0.0;
    float distances = 0.0, most_distance = 0.0;
    float strains = 0.0, most_strain = 0.0;
    float contacts = 0.0, depth = 0.0;
    float bends = 0.0, most_bend = 0.0, torsions = 0.0, most_torsion = 0.0;
    vec3 momentum = vec3(0.0);
    vec3 above = vec3(0.0), groom_above = vec3(0.0);  // the vertex above
    vec3 last = vec3(0.0), last_plane = vec3(0.0);  // the segment and the plane above
    RigidFrame carried = rootFrame(push.frame, push.roots, strand);
    for (uint i = 0; i < vertices; ++i) {
        uint vertex = root + i;
        vec3 position = positions.at[vertex].xyz;
        vec4 rest = groom.at[vertex];
        if (wants(kProbesMotion)) {
            vec3 velocity = (position - previous.at[vertex].xyz) / guides.step.sub;
            float speed2 = dot(velocity, velocity);
            kinetic += 0.5 * rest.w * speed2;
            gravitational -= rest.w * dot(guides.gravity, position - rest.xyz);
            momentum += rest.w * velocity;
            fastest = max(fastest, speed2);
        }
        if (i > 0) {
            if (wants(kProbesGroom)) {
                float apart = distance(position, toWorld(carried, reference.at[vertex].xyz));
                distances += apart;
                most_distance = max(most_distance, apart);
            }
            vec3 edge = position - above;
            float rest_length = distance(rest.xyz, groom_above);
            if (wants(kProbesLength) && rest_length >= kShortestSegment) {
                float strain = abs(length(edge) / rest_length - 1.0);
                strains += strain;
                most_strain = max(most_strain, strain);
            }
            if (wants(kProbesContact)) {
                float gap = gapToBodies(position, guides.bodies, push.frame);
                contacts += gap <= bodiesAt(guides, vertex).margin + kTouching ? 1.0 : 0.0;
                depth = max(depth, -gap);
            }
            if (wants(kProbesBending | kProbesTorsion)) {
                vec3 along = direction(edge);
                float bend = angleBetween(last, along);
                bends += bend;
                most_bend = max(most_bend, bend);
                vec3 plane = planeOf(last, along);
                float torsion = angleBetween(last_plane, plane);
                torsions += torsion;
                most_torsion = max(most_torsion, torsion);
                last = along;
                last_plane = plane;
            }
        }
        above = position;
        groom_above = rest.xyz;
    }

    float rows[kProbeRows];
    rows[kProbeTip] =
        wants(kProbesTip)
            ? distance(above, toWorld(carried, groom.at[root + vertices - 1].xyz))
            : 0.0;
    rows[kProbeStrain] = strains / float(vertices - 1);
    rows[kProbeMostStrain] = most_strain;
    rows[kProbeKinetic] = kinetic;
    rows[kProbeGravitational] = gravitational;
    rows[kProbeElastic] = wants(kProbesElastic) ? elasticEnergy(guides, strand, carried) : 0.0;
    rows[kProbeContacts] = contacts;
    rows[kProbeDepth] = depth;
    rows[kProbeSpeed] = sqrt(fastest);
    rows[kProbeBending] = bends / float(max(vertices, 3u) - 2);
    rows[kProbeMostBending] = most_bend;
    rows[kProbeTorsion] = torsions / float(max(vertices, 4u) - 3);
    rows[kProbeMostTorsion] = most_torsion;
    rows[kProbeMomentum] = momentum.x;
    rows[kProbeMomentum + 1] = momentum.y;
    rows[kProbeMomentum + 2] = momentum.z;
    rows[kProbeDistance] = distances / float(vertices - 1);
    rows[kProbeMostDistance] = most_distance;
    for (uint row = 0; row < kProbeRows; ++row)
        Rows(push.rows).at[row * push.guide_count + guide] = rows[row];
}

#version 460
// Computes twist-free frames of the guides: a normal at every vertex, by double reflection. Wang,
// Juettler, Zheng and Liu 2008, Computation of rotation minimizing frames, table I. One invocation
// per guide.
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"
#include "common/quaternion.glsl"

layout(local_size_x = kFramesGroupSize) in;
layout(push_constant, scalar) uniform Push { FramesPush push; };

layout(buffer_reference, scalar) readonly buffer RootFrames { RootFrame frames[]; };
layout(buffer_reference, scalar) writeonly buffer Normals { vec3 at[]; };

const float kShortest = 1e-3;  // of a normal's part across the tangent; a shorter part has no
                               // direction

// The unit vector along the chord between a vertex's neighbours, like the tangent of the strands'
// curve; `before` if the neighbours coincide.
vec3 vertexTangent(uint first, uint vertex, vec3 before) {
    GuidePoints guides = GuidePoints(push.guides);
    uint last = push.vertices_per_guide - 1u;
    vec3 from = guides.points[first + max(vertex, 1u) - 1u].xyz;
    vec3 to = guides.points[first + min(vertex + 1u, last)].xyz;
    vec3 chord = to - from;
    float squared = dot(chord, chord);
    return squared > 0.0 ? chord * inversesqrt(squared) : before;
}

// Removes a normal's component along the tangent, which rounding adds.
vec3 unitAcross(vec3 normal, vec3 tangent) {
    vec3 part = normal - dot(normal, tangent) * tangent;
    float size = length(part);
    return size > kShortest ? part / size : perpendicular(tangent);
}

// Applies the smallest rotation from `from` to `to` to a vector across `from`.
vec3 turned(vec3 across, vec3 from, vec3 to) {
    return across - dot(across, to) / max(1.0 + dot(from, to), 1e-6) * (from + to);
}

vec3 mirrored(vec3 vector, vec3 mirror_normal) {
    float squared = dot(mirror_normal, mirror_normal);
    if (squared < 1e-20) return vector;
    return vector - 2.0 * dot(mirror_normal, vector) / squared * mirror_normal;
}

void main() {
    uint guide = gl_GlobalInvocationID.x;
    if (guide >= push.guide_count) return;  // no barrier follows
    GuidePoints guides = GuidePoints(push.guides);
    Normals normals = Normals(push.normals);
    uint first = guide * push.vertices_per_guide;

    RootFrame rest = RootFrames(push.root_frames).frames[guide];
    mat3 head = mat3(push.head);
    vec3 carried = head * rest.tangent;
    vec3 tangent = vertexTangent(first, 0u, carried);
    vec3 normal = unitAcross(turned(head * rest.normal, carried, tangent), tangent);
    normals.at[first] = normal;
    for (uint vertex = 1u; vertex < push.vertices_per_guide; ++vertex) {
        vec3 chord =
            guides.points[first + vertex].xyz - guides.points[first + vertex - 1u].xyz;
        vec3 next = vertexTangent(first, vertex, tangent);
        normal = mirrored(normal, chord);
        normal = mirrored(normal, next - mirrored(tangent, chord));
        normal = unitAcross(normal, next);
        tangent = next;
        normals.at[first + vertex] = normal;
    }
}

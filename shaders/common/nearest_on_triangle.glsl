#ifndef HAIRBENCH_COMMON_NEAREST_ON_TRIANGLE_GLSL
#define HAIRBENCH_COMMON_NEAREST_ON_TRIANGLE_GLSL

// The feature on which a nearest point lies. 0 is the face, 1 to 3 the edge from corner i - 1 to
// the next corner, 4 to 6 corner i - 4.
const uint kFaceFeature = 0u;
const uint kEdgeFeatures = 1u;
const uint kCornerFeatures = 4u;

struct Nearest {
    vec3 outward;  // from the nearest point to the query point
    float size;  // squared length of `outward`
    uint feature;
};

void compareSegment(vec3 from_a, vec3 edge, uint index, inout Nearest nearest) {
    float size = dot(edge, edge);
    float along = size > 0.0 ? clamp(dot(from_a, edge) / size, 0.0, 1.0) : 0.0;
    vec3 outward = from_a - along * edge;
    float found = dot(outward, outward);
    if (found >= nearest.size) return;
    uint feature = along <= 0.0   ? kCornerFeatures + index
                   : along >= 1.0 ? kCornerFeatures + (index + 1u) % 3u
                                  : kEdgeFeatures + index;
    nearest = Nearest(outward, found, feature);
}

// Replaces `nearest` by the point of the triangle nearest to p if that is nearer. The planes
// through the three edges tell whether p is over the face; otherwise the edges are compared. Unlike
// barycentric coordinates, this never divides by the area, so slivers are as exact as other
// triangles. The normal has unit length.
void compareTriangle(vec3 p, vec3 corners[3], vec3 normal, inout Nearest nearest) {
    vec3 from_a = p - corners[0];
    vec3 from_b = p - corners[1];
    vec3 from_c = p - corners[2];
    float height = dot(normal, from_a);
    if (height * height >= nearest.size) return;
    vec3 ab = corners[1] - corners[0];
    vec3 bc = corners[2] - corners[1];
    vec3 ca = corners[0] - corners[2];
    if (dot(cross(normal, ab), from_a) >= 0.0 && dot(cross(normal, bc), from_b) >= 0.0 &&
        dot(cross(normal, ca), from_c) >= 0.0) {
        nearest = Nearest(height * normal, height * height, kFaceFeature);
        return;
    }
    compareSegment(from_a, ab, 0u, nearest);
    compareSegment(from_b, bc, 1u, nearest);
    compareSegment(from_c, ca, 2u, nearest);
}

#endif
